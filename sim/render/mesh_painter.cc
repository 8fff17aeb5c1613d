#include "sim/render/mesh_painter.h"

#include "sim/render/gl.h"

namespace dodgesim {
namespace {

// Samples along a pixel's side. Odd, so that one of them is at its centre.
constexpr int kSamples = 5;
// OpenGL draws one tile of the image after the other, each always alike, whatever the region.
constexpr int kTilePx = 128;
constexpr int kTileSamples = kTilePx * kSamples;

}  // namespace

MeshPainter::MeshPainter(TrianglePainter& triangles)
    : triangles_(triangles),
      target_(make_target(kTileSamples, kTileSamples)),
      luminance_(static_cast<std::size_t>(kTileSamples) * kTileSamples),
      depth_(luminance_.size()),
      id_(luminance_.size()) {}

void MeshPainter::paint(const Shot& shot, const Snapshot& snapshot, const PaintedPicture& picture) {
  const Rect& region = shot.region;
  for (int y0 = region.y0 - region.y0 % kTilePx; y0 < region.y1; y0 += kTilePx) {
    for (int x0 = region.x0 - region.x0 % kTilePx; x0 < region.x1; x0 += kTilePx) {
      const Rect tile = {x0, y0, x0 + kTilePx, y0 + kTilePx};
      const Rect pixels = intersection(tile, region);
      draw(shot, snapshot, tile, pixels);
      blend(shot, pixels, picture);
    }
  }
}

// The samples of `pixels`, which are of a tile.
void MeshPainter::draw(const Shot& shot, const Snapshot& snapshot, const Rect& tile,
                       const Rect& pixels) {
  // llvmpipe rounds otherwise where it writes depth and no ids; who asks for ids must not matter.
  gl::BindFramebuffer(GL_FRAMEBUFFER, target_.with_ids.name());
  gl::Viewport(-tile.x0 * kSamples, -tile.y0 * kSamples, shot.intrinsics.width * kSamples,
               shot.intrinsics.height * kSamples);
  const int left = (pixels.x0 - tile.x0) * kSamples, top = (pixels.y0 - tile.y0) * kSamples;
  const int width = (pixels.x1 - pixels.x0) * kSamples;
  const int height = (pixels.y1 - pixels.y0) * kSamples;
  gl::Scissor(left, top, width, height);
  gl::Clear(GL_DEPTH_BUFFER_BIT);
  constexpr GLint kNothing[4] = {0, 0, 0, 0};
  gl::ClearBufferiv(GL_COLOR, 1, kNothing);
  triangles_.draw_objects(shot, snapshot);
  gl::PixelStorei(GL_PACK_ROW_LENGTH, width);
  gl::ReadBuffer(GL_COLOR_ATTACHMENT0);
  gl::ReadPixels(left, top, width, height, GL_RED, GL_FLOAT, luminance_.data());
  gl::ReadPixels(left, top, width, height, GL_DEPTH_COMPONENT, GL_FLOAT, depth_.data());
  gl::ReadBuffer(GL_COLOR_ATTACHMENT1);
  gl::ReadPixels(left, top, width, height, GL_RED_INTEGER, GL_INT, id_.data());
}

void MeshPainter::blend(const Shot& shot, const Rect& pixels, const PaintedPicture& picture) const {
  const std::ptrdiff_t width = pixels.x1 - pixels.x0;
  for (int y = pixels.y0; y < pixels.y1; ++y) {
    std::ptrdiff_t sample = (y - pixels.y0) * kSamples * width * kSamples;
    std::ptrdiff_t pixel = std::ptrdiff_t{y} * shot.intrinsics.width + pixels.x0;
    for (int x = pixels.x0; x < pixels.x1; ++x, ++pixel, sample += kSamples)
      blend_pixel(sample, width * kSamples, pixel, picture);
  }
}

// Its samples begin at `sample`, and in each row below `pitch` further on.
void MeshPainter::blend_pixel(std::ptrdiff_t sample, std::ptrdiff_t pitch, std::ptrdiff_t pixel,
                              const PaintedPicture& picture) const {
  const float hidden_from = picture.depth[pixel];
  const auto shows = [&](std::ptrdiff_t i) {
    const auto index = static_cast<std::size_t>(i);
    return id_[index] != 0 && depth_[index] <= hidden_from;
  };
  int covered = 0;
  float sum = 0;
  for (int row = 0; row < kSamples; ++row) {
    for (int column = 0; column < kSamples; ++column) {
      const std::ptrdiff_t i = sample + row * pitch + column;
      if (!shows(i)) continue;
      ++covered;
      sum += luminance_[static_cast<std::size_t>(i)];
    }
  }
  if (covered == 0) return;
  constexpr int kAll = kSamples * kSamples;
  float& luminance = picture.luminance[pixel];
  luminance = (luminance * static_cast<float>(kAll - covered) + sum) / kAll;
  const std::ptrdiff_t centre = sample + kSamples / 2 * (pitch + 1);
  if (!shows(centre)) return;
  picture.depth[pixel] = depth_[static_cast<std::size_t>(centre)];
  if (picture.id) picture.id[pixel] = id_[static_cast<std::size_t>(centre)];
}

}  // namespace dodgesim

#include "sim/render/mesh_painter.h"

#include <algorithm>
#include <array>
#include <cstdlib>

#include "sim/render/gl.h"

namespace dodgesim {
namespace {

// OpenGL draws a picture of samples that is turned against the image: a pixel to the right is the
// sample (4, -1) further on, a pixel down (1, 4). So a pixel has 17 samples, no two of them in the
// same row or column of the image, and an edge along one of its axes, too, does not jump: each
// sample shows another 1/17 px. 25 that were not turned took as long (results/sensor/README.md).
constexpr int kAlong = 4, kAcross = 1;
constexpr int kSamples = kAlong * kAlong + kAcross * kAcross;
// How far a sample can be from that at its pixel's centre, along either axis.
constexpr int kReach = 2;

// OpenGL draws one tile of the image after the other, each always alike, whatever the region.
constexpr int kTilePx = 128;
constexpr int kTileSamples = (kAlong + kAcross) * (kTilePx - 1) + 2 * kReach + 1;

struct Sample {
  int column, row;
};

// That at the centre of a pixel, counted from its tile's first one.
Sample sample_at(int x, int y) {
  return {kAlong * x + kAcross * y + kReach, kAlong * y + kAcross * (kTilePx - 1 - x) + kReach};
}

// All that pixels of a tile need.
Rect samples_of(const Rect& pixels, const Rect& tile) {
  const int x0 = pixels.x0 - tile.x0, x1 = pixels.x1 - 1 - tile.x0;
  const int y0 = pixels.y0 - tile.y0, y1 = pixels.y1 - 1 - tile.y0;
  return {sample_at(x0, y0).column - kReach, sample_at(x1, y0).row - kReach,
          sample_at(x1, y1).column + kReach + 1, sample_at(x0, y1).row + kReach + 1};
}

// Of a pixel, counted from that at its centre.
std::array<Sample, kSamples> samples_of_a_pixel() {
  std::array<Sample, kSamples> samples;
  std::size_t size = 0;
  for (int row = -kReach; row <= kReach; ++row) {
    for (int column = -kReach; column <= kReach; ++column) {
      // Where it is in the image, in 1/17 px.
      const int x = kAlong * column - kAcross * row, y = kAcross * column + kAlong * row;
      if (std::max(std::abs(x), std::abs(y)) <= kSamples / 2) samples.at(size++) = {column, row};
    }
  }
  return samples;
}

// Of clip coordinates: from those of the whole image to those of a tile's samples.
Eigen::Matrix4d samples_from_image(const Intrinsics& image, const Rect& tile) {
  const Eigen::Affine2d image_from_clip =
      Eigen::Scaling(0.5 * image.width, 0.5 * image.height) * Eigen::Translation2d(1, 1);
  const Sample first = sample_at(0, 0);
  Eigen::Affine2d from_image;
  from_image.linear() << kAlong, kAcross, -kAcross, kAlong;
  from_image.translation() = Eigen::Vector2d(first.column + 0.5, first.row + 0.5) -
                             from_image.linear() * Eigen::Vector2d(tile.x0 + 0.5, tile.y0 + 0.5);
  const Eigen::Affine2d clip_from_samples =
      Eigen::Translation2d(-1, -1) * Eigen::Scaling(2.0 / kTileSamples);
  const Eigen::Affine2d turned = clip_from_samples * from_image * image_from_clip;
  Eigen::Matrix4d result = Eigen::Matrix4d::Identity();
  result.topLeftCorner<2, 2>() = turned.linear();
  result.topRightCorner<2, 1>() = turned.translation();
  return result;
}

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
      const Rect samples = samples_of(pixels, tile);
      draw(shot, snapshot, tile, samples);
      const std::ptrdiff_t pitch = samples.x1 - samples.x0;
      for (int y = pixels.y0; y < pixels.y1; ++y) {
        for (int x = pixels.x0; x < pixels.x1; ++x) {
          const Sample center = sample_at(x - x0, y - y0);
          blend_pixel((center.row - samples.y0) * pitch + center.column - samples.x0, pitch,
                      std::ptrdiff_t{y} * shot.intrinsics.width + x, picture);
        }
      }
    }
  }
}

void MeshPainter::draw(const Shot& shot, const Snapshot& snapshot, const Rect& tile,
                       const Rect& samples) {
  // llvmpipe rounds otherwise where it writes depth and no ids; who asks for ids must not matter.
  gl::BindFramebuffer(GL_FRAMEBUFFER, target_.with_ids.name());
  gl::Viewport(0, 0, kTileSamples, kTileSamples);
  const int width = samples.x1 - samples.x0, height = samples.y1 - samples.y0;
  gl::Scissor(samples.x0, samples.y0, width, height);
  gl::Clear(GL_DEPTH_BUFFER_BIT);
  constexpr GLint kNothing[4] = {0, 0, 0, 0};
  gl::ClearBufferiv(GL_COLOR, 1, kNothing);
  triangles_.draw_objects(shot, snapshot, samples_from_image(shot.intrinsics, tile));
  gl::PixelStorei(GL_PACK_ROW_LENGTH, width);
  gl::ReadBuffer(GL_COLOR_ATTACHMENT0);
  gl::ReadPixels(samples.x0, samples.y0, width, height, GL_RED, GL_FLOAT, luminance_.data());
  gl::ReadPixels(samples.x0, samples.y0, width, height, GL_DEPTH_COMPONENT, GL_FLOAT,
                 depth_.data());
  gl::ReadBuffer(GL_COLOR_ATTACHMENT1);
  gl::ReadPixels(samples.x0, samples.y0, width, height, GL_RED_INTEGER, GL_INT, id_.data());
}

// `center`: the sample at the pixel's centre; in each row below the samples are `pitch` further on.
void MeshPainter::blend_pixel(std::ptrdiff_t center, std::ptrdiff_t pitch, std::ptrdiff_t pixel,
                              const PaintedPicture& picture) const {
  static const std::array<Sample, kSamples> samples = samples_of_a_pixel();
  const float hidden_from = picture.depth[pixel];
  const auto shows = [&](std::ptrdiff_t i) {
    const auto index = static_cast<std::size_t>(i);
    return id_[index] != 0 && depth_[index] <= hidden_from;
  };
  int covered = 0;
  float sum = 0;
  for (const Sample& sample : samples) {
    const std::ptrdiff_t i = center + sample.row * pitch + sample.column;
    if (!shows(i)) continue;
    ++covered;
    sum += luminance_[static_cast<std::size_t>(i)];
  }
  if (covered == 0) return;
  float& luminance = picture.luminance[pixel];
  luminance = (luminance * static_cast<float>(kSamples - covered) + sum) / kSamples;
  if (!shows(center)) return;
  picture.depth[pixel] = depth_[static_cast<std::size_t>(center)];
  if (picture.id) picture.id[pixel] = id_[static_cast<std::size_t>(center)];
}

}  // namespace dodgesim

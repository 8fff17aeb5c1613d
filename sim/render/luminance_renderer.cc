#include "sim/render/luminance_renderer.h"

#include <algorithm>
#include <optional>

#include "sim/render/context_lease.h"
#include "sim/render/edge_smoother.h"
#include "sim/render/gl.h"
#include "sim/render/gl_scene.h"
#include "sim/render/mesh_painter.h"
#include "sim/render/primitive_painter.h"
#include "sim/render/scene_geometry.h"
#include "sim/render/triangle_painter.h"

namespace dodgesim {

namespace {

// Smoothed edges need the pixels around them.
constexpr int kSmoothingPx = 2;

Rect clipped(const Rect& region, const Intrinsics& image) {
  return intersection(region, {0, 0, image.width, image.height});
}

Rect widened(const Rect& region, int by_px, const Intrinsics& image) {
  return clipped({region.x0 - by_px, region.y0 - by_px, region.x1 + by_px, region.y1 + by_px},
                 image);
}

std::ptrdiff_t offset_of(const Rect& region, const Intrinsics& image) {
  return std::ptrdiff_t{region.y0} * image.width + region.x0;
}

// Of the framebuffer that is bound.
void read_depth(const Rect& region, const Intrinsics& image, float* depth) {
  gl::ReadPixels(region.x0, region.y0, region.x1 - region.x0, region.y1 - region.y0,
                 GL_DEPTH_COMPONENT, GL_FLOAT, depth + offset_of(region, image));
}

void set_scissor(const Rect& region) {
  gl::Scissor(region.x0, region.y0, region.x1 - region.x0, region.y1 - region.y0);
}

// All that is not set before each use, whatever another renderer has left.
void set_state() {
  gl::Enable(GL_DEPTH_TEST);
  gl::DepthFunc(GL_LEQUAL);
  gl::DepthMask(GL_TRUE);
  gl::Enable(GL_SCISSOR_TEST);
  gl::Enable(GL_TEXTURE_CUBE_MAP_SEAMLESS);
  gl::Disable(GL_BLEND);
  gl::BlendFunc(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA);
  gl::ColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
  gl::ActiveTexture(GL_TEXTURE0);
  gl::PixelStorei(GL_PACK_ALIGNMENT, 1);
}

template <class Part>
bool flies(const Part& part, const Snapshot& snapshot) {
  return part.object >= 0 && snapshot.launched[static_cast<std::size_t>(part.object)];
}

}  // namespace

class LuminanceRenderer::Impl {
 public:
  Impl(const mjModel& model, const std::vector<int>& object_bodies, const Intrinsics& intrinsics,
       const RenderSpec& spec);
  ~Impl() { lease_.context().make_current(); }  // the OpenGL objects in it are deleted now
  Impl(const Impl&) = delete;
  Impl& operator=(const Impl&) = delete;
  void render(const Snapshot& snapshot, const Eigen::Isometry3d& X_WC, const Rect& region,
              float* luminance, std::int32_t* object_id);
  void render_static(const Intrinsics& intrinsics, const Eigen::Isometry3d& X_WC, double lod_bias,
                     float* luminance, float* inverse_depth);
  void draw_objects(const Snapshot& snapshot, const Eigen::Isometry3d& X_WC, const Rect& region,
                    bool behind_static, float* luminance, std::int32_t* object_id);

 private:
  // Images of one size, with what depends on the camera's intrinsics.
  struct Canvas {
    Intrinsics intrinsics;
    GlTarget target;
    std::optional<EdgeSmoother> edges;
  };
  Canvas& canvas(const Intrinsics& intrinsics);
  void bind(const Canvas& canvas, bool with_ids);
  void draw_static_triangles(Canvas& canvas, const Shot& shot, bool with_ids);
  void read(const Canvas& canvas, const Rect& region, const PaintedPicture& picture);
  bool mesh_flies(const Snapshot& snapshot) const;
  bool single_solid_flies(const Snapshot& snapshot) const;
  void clear(const Rect& region, const PaintedPicture& picture) const;
  void draw_static_depth(const Shot& shot, const PaintedPicture& picture);

  Intrinsics intrinsics_;
  DepthRange depth_;
  SceneGeometry scene_;
  ContextLease lease_;
  SceneTextures textures_;
  TrianglePainter triangles_;
  std::optional<MeshPainter> meshes_;  // if any can fly
  PrimitivePainter primitives_;
  std::vector<std::unique_ptr<Canvas>> canvases_;
  std::vector<float> depth_image_;  // as large as the camera's
};

LuminanceRenderer::Impl::Impl(const mjModel& model, const std::vector<int>& object_bodies,
                              const Intrinsics& intrinsics, const RenderSpec& spec)
    : intrinsics_(intrinsics),
      depth_{spec.near_m, 2.0 * spec.far_m},  // the corners of unbounded planes stay visible
      scene_(collect_scene(model, object_bodies, spec.texel_encoding == "srgb")),
      textures_(scene_, spec.texture_filter == "trilinear"),
      triangles_(scene_, textures_, lease_.programs(), depth_, spec.far_m, spec.sky_luminance),
      primitives_(scene_, spec.texture_filter == "trilinear", depth_),
      depth_image_(static_cast<std::size_t>(intrinsics.width) *
                   static_cast<std::size_t>(intrinsics.height)) {
  set_state();
  if (!scene_.moving_triangles.empty()) meshes_.emplace(triangles_);
}

LuminanceRenderer::Impl::Canvas& LuminanceRenderer::Impl::canvas(const Intrinsics& intrinsics) {
  for (const auto& canvas : canvases_) {
    if (canvas->intrinsics == intrinsics) return *canvas;
  }
  canvases_.push_back(std::make_unique<Canvas>(
      Canvas{intrinsics, make_target(intrinsics.width, intrinsics.height), std::nullopt}));
  return *canvases_.back();
}

void LuminanceRenderer::Impl::bind(const Canvas& canvas, bool with_ids) {
  gl::BindFramebuffer(GL_FRAMEBUFFER,
                      (with_ids ? canvas.target.with_ids : canvas.target.without_ids).name());
  gl::Viewport(0, 0, canvas.intrinsics.width, canvas.intrinsics.height);
  gl::PixelStorei(GL_PACK_ROW_LENGTH, canvas.intrinsics.width);
}

// With smoothed edges.
void LuminanceRenderer::Impl::draw_static_triangles(Canvas& canvas, const Shot& shot,
                                                    bool with_ids) {
  if (!canvas.edges) {
    canvas.edges.emplace(scene_.static_edges, lease_.programs(), canvas.intrinsics, depth_);
  }
  Shot wide = shot;
  wide.region = widened(shot.region, kSmoothingPx, shot.intrinsics);
  bind(canvas, with_ids);
  set_scissor(wide.region);
  gl::Clear(GL_DEPTH_BUFFER_BIT);
  triangles_.draw_static(wide);
  canvas.edges->draw(wide.X_WC, wide.region, canvas.target);
  bind(canvas, with_ids);
  set_scissor(shot.region);
}

void LuminanceRenderer::Impl::render(const Snapshot& snapshot, const Eigen::Isometry3d& X_WC,
                                     const Rect& region, float* luminance,
                                     std::int32_t* object_id) {
  const Shot shot{intrinsics_, X_WC, clipped(region, intrinsics_)};
  if (shot.region.empty()) return;
  lease_.context().make_current();
  Canvas& view = canvas(intrinsics_);
  draw_static_triangles(view, shot, object_id != nullptr);
  const PaintedPicture picture = {luminance, depth_image_.data(), object_id};
  read(view, shot.region, picture);
  if (mesh_flies(snapshot)) meshes_->paint(shot, snapshot, picture);
  primitives_.paint_all(shot, snapshot, picture);
}

void LuminanceRenderer::Impl::render_static(const Intrinsics& intrinsics,
                                            const Eigen::Isometry3d& X_WC, double lod_bias,
                                            float* luminance, float* inverse_depth) {
  const Shot shot{intrinsics, X_WC, {0, 0, intrinsics.width, intrinsics.height}, lod_bias};
  lease_.context().make_current();
  Canvas& whole = canvas(intrinsics);
  draw_static_triangles(whole, shot, false);
  const PaintedPicture picture = {luminance, inverse_depth, nullptr};
  read(whole, shot.region, picture);
  primitives_.paint_static(shot, picture);
  const auto pixels =
      static_cast<std::size_t>(intrinsics.width) * static_cast<std::size_t>(intrinsics.height);
  const auto offset = static_cast<float>(depth_.offset());
  const auto per_slope = static_cast<float>(1 / depth_.slope());
  for (std::size_t i = 0; i < pixels; ++i) {
    const float value = inverse_depth[i];
    inverse_depth[i] = value < 1.0f ? (value - offset) * per_slope : 0.0f;
  }
}

// Whether OpenGL must draw something of the objects in flight.
bool LuminanceRenderer::Impl::mesh_flies(const Snapshot& snapshot) const {
  return std::ranges::any_of(scene_.moving_triangles,
                             [&](const auto& moving) { return flies(moving, snapshot); });
}

// Whether they have no more than one solid that is ray-cast, which nothing can hide.
bool LuminanceRenderer::Impl::single_solid_flies(const Snapshot& snapshot) const {
  return std::ranges::count_if(scene_.primitives, [&](const Primitive& primitive) {
           return flies(primitive, snapshot);
         }) <= 1;
}

void LuminanceRenderer::Impl::draw_objects(const Snapshot& snapshot, const Eigen::Isometry3d& X_WC,
                                           const Rect& region, bool behind_static, float* luminance,
                                           std::int32_t* object_id) {
  const Shot shot{intrinsics_, X_WC, clipped(region, intrinsics_)};
  if (shot.region.empty()) return;
  const bool meshes = mesh_flies(snapshot);
  const bool with_depth = behind_static || meshes || !single_solid_flies(snapshot);
  const PaintedPicture picture = {luminance, with_depth ? depth_image_.data() : nullptr, object_id};
  clear(shot.region, picture);
  if (behind_static) draw_static_depth(shot, picture);
  if (meshes) {
    lease_.context().make_current();
    meshes_->paint(shot, snapshot, picture);
  }
  primitives_.paint_objects(shot, snapshot, picture);
}

// Nothing is there yet, near or far.
void LuminanceRenderer::Impl::clear(const Rect& region, const PaintedPicture& picture) const {
  for (int y = region.y0; y < region.y1; ++y) {
    const std::ptrdiff_t first = std::ptrdiff_t{y} * intrinsics_.width + region.x0;
    if (picture.depth) std::fill_n(picture.depth + first, region.x1 - region.x0, 1.0f);
    if (picture.id) std::fill_n(picture.id + first, region.x1 - region.x0, 0);
  }
}

void LuminanceRenderer::Impl::draw_static_depth(const Shot& shot, const PaintedPicture& picture) {
  lease_.context().make_current();
  bind(canvas(intrinsics_), true);
  set_scissor(shot.region);
  gl::Clear(GL_DEPTH_BUFFER_BIT);
  triangles_.draw_static(shot);
  read_depth(shot.region, intrinsics_, picture.depth);
  primitives_.paint_static(shot, {nullptr, picture.depth, nullptr});
}

void LuminanceRenderer::Impl::read(const Canvas& canvas, const Rect& region,
                                   const PaintedPicture& picture) {
  const int width = region.x1 - region.x0, height = region.y1 - region.y0;
  const std::ptrdiff_t first = offset_of(region, canvas.intrinsics);
  gl::ReadBuffer(GL_COLOR_ATTACHMENT0);
  gl::ReadPixels(region.x0, region.y0, width, height, GL_RED, GL_FLOAT, picture.luminance + first);
  read_depth(region, canvas.intrinsics, picture.depth);
  if (!picture.id) return;
  gl::ReadBuffer(GL_COLOR_ATTACHMENT1);
  gl::ReadPixels(region.x0, region.y0, width, height, GL_RED_INTEGER, GL_INT, picture.id + first);
}

LuminanceRenderer::LuminanceRenderer(const mjModel& model, const std::vector<int>& object_bodies,
                                     const Intrinsics& intrinsics, const RenderSpec& spec)
    : impl_(std::make_unique<Impl>(model, object_bodies, intrinsics, spec)) {}

LuminanceRenderer::LuminanceRenderer(const World& world, const Intrinsics& intrinsics,
                                     const RenderSpec& spec)
    : LuminanceRenderer(world.model(), world.object_bodies(), intrinsics, spec) {}

LuminanceRenderer::~LuminanceRenderer() = default;

void LuminanceRenderer::render(const Snapshot& snapshot, const Eigen::Isometry3d& X_WC,
                               const Rect& region, float* luminance, std::int32_t* object_id) {
  impl_->render(snapshot, X_WC, region, luminance, object_id);
}

void LuminanceRenderer::render_static(const Intrinsics& intrinsics, const Eigen::Isometry3d& X_WC,
                                      double lod_bias, float* luminance, float* inverse_depth) {
  impl_->render_static(intrinsics, X_WC, lod_bias, luminance, inverse_depth);
}

void LuminanceRenderer::draw_objects(const Snapshot& snapshot, const Eigen::Isometry3d& X_WC,
                                     const Rect& region, bool behind_static, float* luminance,
                                     std::int32_t* object_id) {
  impl_->draw_objects(snapshot, X_WC, region, behind_static, luminance, object_id);
}

}  // namespace dodgesim

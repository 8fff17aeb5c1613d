#include "sim/render/luminance_renderer.h"

#include <GL/gl.h>
#include <GL/glext.h>

#include <algorithm>
#include <array>
#include <optional>

#include "sim/render/edge_smoother.h"
#include "sim/render/gl_scene.h"
#include "sim/render/osmesa_context.h"
#include "sim/render/primitive_view.h"
#include "sim/render/scene_geometry.h"

namespace dodgesim {

namespace {

constexpr std::size_t kTextureKinds = 3;
constexpr mjtGeom kPrimitiveTypes[] = {mjGEOM_ELLIPSOID, mjGEOM_CAPSULE, mjGEOM_CYLINDER,
                                       mjGEOM_BOX};

std::size_t type_index(mjtGeom type) {
  return static_cast<std::size_t>(
      std::find(std::begin(kPrimitiveTypes), std::end(kPrimitiveTypes), type) -
      std::begin(kPrimitiveTypes));
}

template <class Matrix>
void set_matrix(int location, const Matrix& matrix) {
  const Eigen::Matrix<float, Matrix::RowsAtCompileTime, Matrix::ColsAtCompileTime> m =
      matrix.template cast<float>();
  if constexpr (Matrix::RowsAtCompileTime == 4) {
    glUniformMatrix4fv(location, 1, GL_FALSE, m.data());
  } else {
    glUniformMatrix3fv(location, 1, GL_FALSE, m.data());
  }
}

void set_vector(int location, const Eigen::Vector3d& v) {
  glUniform3f(location, static_cast<float>(v.x()), static_cast<float>(v.y()),
              static_cast<float>(v.z()));
}

// Quads that stand for an unbounded plane around the camera's foot: small ones nearby, where float
// positions must be exact, and large ones out to the horizon.
std::vector<Vertex> tessellate_unbounded(const Surface& surface, double far_m) {
  constexpr double kInnerM = 30.0;
  const std::array<double, 4> grid = {-far_m, -kInnerM, kInnerM, far_m};
  std::vector<Vertex> vertices;
  const auto corner = [&](std::size_t i, std::size_t j) {
    const Eigen::Vector3d p(grid[i], grid[j], 0.0);
    vertices.push_back({p.cast<float>(), Eigen::Vector3f::UnitZ(),
                        p.cwiseProduct(surface.texture_scale).cast<float>(),
                        static_cast<float>(surface.albedo),
                        static_cast<float>(surface.albedo * surface.emission)});
  };
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = 0; j < 3; ++j) {
      corner(i, j), corner(i + 1, j), corner(i + 1, j + 1);
      corner(i, j), corner(i + 1, j + 1), corner(i, j + 1);
    }
  }
  return vertices;
}

std::vector<int> object_bodies(const World& world) {
  std::vector<int> bodies;
  bodies.reserve(static_cast<std::size_t>(world.object_count()));
  for (int i = 0; i < world.object_count(); ++i) bodies.push_back(world.object_body(i));
  return bodies;
}

}  // namespace

class LuminanceRenderer::Impl {
 public:
  Impl(const mjModel& model, const std::vector<int>& object_bodies, const Intrinsics& intrinsics,
       const RenderSpec& spec);
  void render(const Snapshot& snapshot, const Eigen::Isometry3d& X_WC, const Rect& region,
              float* luminance, std::int32_t* object_id);
  const OsmesaContext& context() const { return context_; }

 private:
  void make_programs();
  Rect clipped(const Rect& region) const;
  void draw_static(const Eigen::Isometry3d& X_WC, const Rect& region);
  void read(const Rect& region, float* luminance, std::int32_t* object_id);
  TextureKind kind_of(int texture) const;
  void bind_texture(int texture) const;
  Eigen::Matrix4d clip_from_camera() const;
  void draw_triangles(const VertexBuffer& buffer, int texture, const Eigen::Isometry3d& X_WG,
                      const Eigen::Vector3d& texture_shift, int id);
  void draw_unbounded(const Eigen::Vector3d& eye_W);
  void draw_sky(const Eigen::Isometry3d& X_WC);
  void draw_primitives(const Snapshot& snapshot, const Eigen::Isometry3d& X_WC, const Rect& region);
  void set_outline(const GlProgram& program, const Primitive& primitive,
                   const PrimitiveView& view) const;
  void draw_primitive(std::size_t index);

  Intrinsics intrinsics_;
  DepthRange depth_;
  double sky_luminance_;
  OsmesaContext context_;
  SceneGeometry scene_;
  GlTarget target_;
  std::vector<unsigned> textures_;
  std::vector<VertexBuffer> static_buffers_, moving_buffers_, unbounded_buffers_;
  unsigned no_vertices_ = 0;
  std::array<GlProgram, kTextureKinds> triangle_programs_;
  std::array<std::array<GlProgram, kTextureKinds>, std::size(kPrimitiveTypes)> primitive_programs_;
  std::array<GlProgram, std::size(kPrimitiveTypes)> hard_programs_;
  GlProgram sky_program_;
  std::optional<EdgeSmoother> edge_smoother_;

  // Of the frame being drawn.
  Eigen::Matrix4d clip_from_W_;
  std::vector<PrimitiveView> views_;
  std::vector<Eigen::Isometry3d> primitive_poses_;  // X_WG
  std::vector<std::size_t> order_;                  // primitives to draw, back to front
};

LuminanceRenderer::Impl::Impl(const mjModel& model, const std::vector<int>& object_bodies,
                              const Intrinsics& intrinsics, const RenderSpec& spec)
    : intrinsics_(intrinsics),
      depth_{spec.near_m, 2.0 * spec.far_m},  // the corners of unbounded planes stay visible
      sky_luminance_(spec.sky_luminance),
      context_(GlProfile::kCore33, 1, 1),
      scene_(collect_scene(model, object_bodies, spec.texel_encoding == "srgb")) {
  target_ = make_target(intrinsics.width, intrinsics.height);
  for (const LuminanceTexture& texture : scene_.textures) {
    textures_.push_back(upload_texture(texture, spec.texture_filter == "trilinear"));
  }
  for (const TriangleBatch& batch : scene_.static_triangles) {
    static_buffers_.push_back(upload_vertices(batch.vertices));
  }
  for (const MovingTriangles& moving : scene_.moving_triangles) {
    moving_buffers_.push_back(upload_vertices(moving.batch.vertices));
  }
  for (const InfinitePlane& plane : scene_.infinite_planes) {
    unbounded_buffers_.push_back(upload_vertices(tessellate_unbounded(plane.surface, spec.far_m)));
  }
  edge_smoother_.emplace(scene_.static_edges, intrinsics, depth_);
  glGenVertexArrays(1, &no_vertices_);
  make_programs();
  views_.resize(scene_.primitives.size());
  primitive_poses_.resize(scene_.primitives.size());
  order_.reserve(scene_.primitives.size());
  glViewport(0, 0, intrinsics.width, intrinsics.height);
  glEnable(GL_DEPTH_TEST);
  glDepthFunc(GL_LEQUAL);
  glEnable(GL_SCISSOR_TEST);
  glEnable(GL_TEXTURE_CUBE_MAP_SEAMLESS);
  glBlendFunc(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA);
  glPixelStorei(GL_PACK_ALIGNMENT, 1);
  glPixelStorei(GL_PACK_ROW_LENGTH, intrinsics.width);
}

void LuminanceRenderer::Impl::make_programs() {
  const auto need_triangles = [this](int texture) {
    GlProgram& program = triangle_programs_[static_cast<std::size_t>(kind_of(texture))];
    if (!program.name) program = make_triangle_program(kind_of(texture), scene_);
  };
  for (const TriangleBatch& batch : scene_.static_triangles) need_triangles(batch.texture);
  for (const MovingTriangles& moving : scene_.moving_triangles)
    need_triangles(moving.batch.texture);
  for (const InfinitePlane& plane : scene_.infinite_planes) need_triangles(plane.surface.texture);
  for (const Primitive& primitive : scene_.primitives) {
    const TextureKind kind = kind_of(primitive.surface.texture);
    GlProgram& program =
        primitive_programs_[type_index(primitive.type)][static_cast<std::size_t>(kind)];
    if (!program.name) {
      program = make_primitive_program(primitive.type, kind, false, scene_, intrinsics_, depth_);
    }
    GlProgram& hard = hard_programs_[type_index(primitive.type)];
    if (!hard.name) {
      hard = make_primitive_program(primitive.type, TextureKind::kNone, true, scene_, intrinsics_,
                                    depth_);
    }
  }
  const bool has_sky = scene_.sky_texture >= 0;
  sky_program_ =
      make_sky_program(kind_of(scene_.sky_texture), intrinsics_, has_sky ? 1.0 : sky_luminance_);
}

TextureKind LuminanceRenderer::Impl::kind_of(int texture) const {
  if (texture < 0) return TextureKind::kNone;
  return scene_.textures[static_cast<std::size_t>(texture)].cube ? TextureKind::kCube
                                                                 : TextureKind::k2d;
}

void LuminanceRenderer::Impl::bind_texture(int texture) const {
  if (texture < 0) return;
  const bool cube = scene_.textures[static_cast<std::size_t>(texture)].cube;
  glBindTexture(cube ? GL_TEXTURE_CUBE_MAP : GL_TEXTURE_2D,
                textures_[static_cast<std::size_t>(texture)]);
}

// Clip y grows downwards like the image's rows: window row 0 is the top of the image.
Eigen::Matrix4d LuminanceRenderer::Impl::clip_from_camera() const {
  Eigen::Matrix4d clip = Eigen::Matrix4d::Zero();
  clip(0, 0) = 2.0 * intrinsics_.f / intrinsics_.width;
  clip(1, 1) = 2.0 * intrinsics_.f / intrinsics_.height;
  clip(2, 2) = 2.0 * depth_.offset() - 1.0;
  clip(2, 3) = 2.0 * depth_.slope();
  clip(3, 2) = 1.0;
  return clip;
}

void LuminanceRenderer::Impl::draw_triangles(const VertexBuffer& buffer, int texture,
                                             const Eigen::Isometry3d& X_WG,
                                             const Eigen::Vector3d& texture_shift, int id) {
  const GlProgram& program = triangle_programs_[static_cast<std::size_t>(kind_of(texture))];
  glUseProgram(program.name);
  const Eigen::Matrix4d clip_from_G = clip_from_W_ * X_WG.matrix();
  set_matrix(program.clip_from_G, clip_from_G);
  set_matrix(program.X_WG, X_WG.matrix());
  set_vector(program.texture_shift, texture_shift);
  glUniform1i(program.id, id);
  bind_texture(texture);
  glBindVertexArray(buffer.array);
  glDrawArrays(GL_TRIANGLES, 0, buffer.count);
}

void LuminanceRenderer::Impl::draw_unbounded(const Eigen::Vector3d& eye_W) {
  for (std::size_t i = 0; i < scene_.infinite_planes.size(); ++i) {
    const InfinitePlane& plane = scene_.infinite_planes[i];
    Eigen::Vector3d foot = plane.pose.inverse() * eye_W;
    foot.z() = 0.0;
    // Textures repeat: whole periods are left out, so that floats suffice anywhere.
    Eigen::Vector3d shift =
        foot.cwiseProduct(plane.surface.texture_scale) + plane.surface.texture_offset;
    shift -= shift.array().floor().matrix();
    draw_triangles(unbounded_buffers_[i], plane.surface.texture,
                   plane.pose * Eigen::Translation3d(foot), shift, 0);
  }
}

void LuminanceRenderer::Impl::draw_sky(const Eigen::Isometry3d& X_WC) {
  glUseProgram(sky_program_.name);
  set_matrix(sky_program_.R_WC, Eigen::Matrix3d(X_WC.linear()));
  bind_texture(scene_.sky_texture);
  glBindVertexArray(no_vertices_);
  glDrawArrays(GL_TRIANGLE_STRIP, 0, 4);
}

// Where a program sends what it shares with its hard twin.
void LuminanceRenderer::Impl::set_outline(const GlProgram& program, const Primitive& primitive,
                                          const PrimitiveView& view) const {
  glUseProgram(program.name);
  const auto clip = [](int pixel, int size) {
    return 2.0f * static_cast<float>(pixel) / static_cast<float>(size) - 1.0f;
  };
  glUniform4f(program.rectangle, clip(view.bounds.x0, intrinsics_.width),
              clip(view.bounds.y0, intrinsics_.height), clip(view.bounds.x1, intrinsics_.width),
              clip(view.bounds.y1, intrinsics_.height));
  set_matrix(program.R_GC, view.R_GC);
  set_vector(program.eye_G, view.eye_G);
  set_vector(program.size, primitive.size);
  glUniform1i(program.id, primitive.object + 1);
}

void LuminanceRenderer::Impl::draw_primitive(std::size_t index) {
  const Primitive& primitive = scene_.primitives[index];
  const PrimitiveView& view = views_[index];
  const Surface& surface = primitive.surface;
  const std::size_t type = type_index(primitive.type);
  const GlProgram& program =
      primitive_programs_[type][static_cast<std::size_t>(kind_of(surface.texture))];
  set_outline(program, primitive, view);
  glUniform1f(program.margin, static_cast<float>(view.margin));
  set_matrix(program.X_WG, primitive_poses_[index].matrix());
  set_vector(program.texture_scale, surface.texture_scale);
  set_vector(program.texture_offset, surface.texture_offset);
  glUniform2f(program.albedo_emission, static_cast<float>(surface.albedo),
              static_cast<float>(surface.albedo * surface.emission));
  if (primitive.type != mjGEOM_BOX) {
    set_matrix(program.conic, view.conic);
    glUniform2f(program.conic_origin, static_cast<float>(view.conic_origin.x()),
                static_cast<float>(view.conic_origin.y()));
  }
  bind_texture(surface.texture);
  glDepthMask(GL_FALSE);
  glEnable(GL_BLEND);
  glColorMaski(1, GL_FALSE, GL_FALSE, GL_FALSE, GL_FALSE);
  glDrawArrays(GL_TRIANGLE_STRIP, 0, 4);

  // Depth and id where the pixel's centre is hit, for what is drawn later.
  set_outline(hard_programs_[type], primitive, view);
  glDepthMask(GL_TRUE);
  glDisable(GL_BLEND);
  glColorMaski(0, GL_FALSE, GL_FALSE, GL_FALSE, GL_FALSE);
  glColorMaski(1, GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
  glDrawArrays(GL_TRIANGLE_STRIP, 0, 4);
  glColorMaski(0, GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
}

void LuminanceRenderer::Impl::draw_primitives(const Snapshot& snapshot,
                                              const Eigen::Isometry3d& X_WC, const Rect& region) {
  order_.clear();
  for (std::size_t i = 0; i < scene_.primitives.size(); ++i) {
    const Primitive& primitive = scene_.primitives[i];
    primitive_poses_[i] = primitive.pose;
    if (primitive.object >= 0) {
      const auto object = static_cast<std::size_t>(primitive.object);
      if (!snapshot.launched[object]) continue;
      primitive_poses_[i] = snapshot.objects[object].pose() * primitive.pose;
    }
    views_[i] = view_primitive(primitive, primitive_poses_[i], X_WC, intrinsics_, depth_.near_m);
    const Rect& bounds = views_[i].bounds;
    if (!views_[i].visible || std::max(bounds.x0, region.x0) >= std::min(bounds.x1, region.x1) ||
        std::max(bounds.y0, region.y0) >= std::min(bounds.y1, region.y1)) {
      continue;
    }
    order_.push_back(i);
  }
  std::sort(order_.begin(), order_.end(), [this](std::size_t a, std::size_t b) {
    return views_[a].distance != views_[b].distance ? views_[a].distance > views_[b].distance
                                                    : a < b;
  });
  glBindVertexArray(no_vertices_);
  for (const std::size_t index : order_) draw_primitive(index);
}

void LuminanceRenderer::Impl::render(const Snapshot& snapshot, const Eigen::Isometry3d& X_WC,
                                     const Rect& region, float* luminance,
                                     std::int32_t* object_id) {
  const Rect part = clipped(region);
  if (part.empty()) return;
  context_.make_current();
  clip_from_W_ = clip_from_camera() * X_WC.inverse().matrix();
  glBindFramebuffer(GL_FRAMEBUFFER, object_id ? target_.with_ids : target_.without_ids);
  // Smoothed edges need the pixels around them.
  constexpr int kBorderPx = 2;
  const Rect wide =
      clipped({part.x0 - kBorderPx, part.y0 - kBorderPx, part.x1 + kBorderPx, part.y1 + kBorderPx});
  draw_static(X_WC, wide);
  edge_smoother_->draw(X_WC, wide, target_);
  glBindFramebuffer(GL_FRAMEBUFFER, object_id ? target_.with_ids : target_.without_ids);
  glScissor(part.x0, part.y0, part.x1 - part.x0, part.y1 - part.y0);
  for (std::size_t i = 0; i < moving_buffers_.size(); ++i) {
    const MovingTriangles& moving = scene_.moving_triangles[i];
    const auto object = static_cast<std::size_t>(moving.object);
    if (!snapshot.launched[object]) continue;
    draw_triangles(moving_buffers_[i], moving.batch.texture, snapshot.objects[object].pose(),
                   Eigen::Vector3d::Zero(), moving.object + 1);
  }
  draw_primitives(snapshot, X_WC, part);
  read(part, luminance, object_id);
}

Rect LuminanceRenderer::Impl::clipped(const Rect& region) const {
  return {std::max(region.x0, 0), std::max(region.y0, 0), std::min(region.x1, intrinsics_.width),
          std::min(region.y1, intrinsics_.height)};
}

void LuminanceRenderer::Impl::draw_static(const Eigen::Isometry3d& X_WC, const Rect& region) {
  glScissor(region.x0, region.y0, region.x1 - region.x0, region.y1 - region.y0);
  glClear(GL_DEPTH_BUFFER_BIT);
  for (std::size_t i = 0; i < static_buffers_.size(); ++i) {
    draw_triangles(static_buffers_[i], scene_.static_triangles[i].texture,
                   Eigen::Isometry3d::Identity(), Eigen::Vector3d::Zero(), 0);
  }
  draw_unbounded(X_WC.translation());
  draw_sky(X_WC);
}

void LuminanceRenderer::Impl::read(const Rect& region, float* luminance, std::int32_t* object_id) {
  const int width = region.x1 - region.x0, height = region.y1 - region.y0;
  const std::ptrdiff_t first = std::ptrdiff_t{region.y0} * intrinsics_.width + region.x0;
  glReadBuffer(GL_COLOR_ATTACHMENT0);
  glReadPixels(region.x0, region.y0, width, height, GL_RED, GL_FLOAT, luminance + first);
  if (!object_id) return;
  glReadBuffer(GL_COLOR_ATTACHMENT1);
  glReadPixels(region.x0, region.y0, width, height, GL_RED_INTEGER, GL_INT, object_id + first);
}

LuminanceRenderer::LuminanceRenderer(const mjModel& model, const std::vector<int>& object_bodies,
                                     const Intrinsics& intrinsics, const RenderSpec& spec)
    : impl_(std::make_unique<Impl>(model, object_bodies, intrinsics, spec)) {}

LuminanceRenderer::LuminanceRenderer(const World& world, const Intrinsics& intrinsics,
                                     const RenderSpec& spec)
    : LuminanceRenderer(world.model(), object_bodies(world), intrinsics, spec) {}

LuminanceRenderer::~LuminanceRenderer() = default;

void LuminanceRenderer::render(const Snapshot& snapshot, const Eigen::Isometry3d& X_WC,
                               const Rect& region, float* luminance, std::int32_t* object_id) {
  impl_->render(snapshot, X_WC, region, luminance, object_id);
}

const std::string& LuminanceRenderer::gl_renderer() const { return impl_->context().renderer(); }
const std::string& LuminanceRenderer::gl_version() const { return impl_->context().version(); }

}  // namespace dodgesim

#include "sim/render/triangle_painter.h"

#include "sim/render/gl.h"

#include <algorithm>

namespace dodgesim {

namespace {

// Hand Eigen's values to the uniforms of the program in use.
template <class Matrix>
void set_matrix(int location, const Matrix& matrix) {
  const Eigen::Matrix<float, Matrix::RowsAtCompileTime, Matrix::ColsAtCompileTime> m =
      matrix.template cast<float>();
  if constexpr (Matrix::RowsAtCompileTime == 4) {
    gl::UniformMatrix4fv(location, 1, GL_FALSE, m.data());
  } else {
    gl::UniformMatrix3fv(location, 1, GL_FALSE, m.data());
  }
}

void set_vector(int location, const Eigen::Vector3d& v) {
  gl::Uniform3f(location, static_cast<float>(v.x()), static_cast<float>(v.y()),
                static_cast<float>(v.z()));
}

// Quads that stand for an unbounded plane around the camera's foot: small ones nearby, where float
// positions must be exact, and large ones out to the horizon.
std::vector<Vertex> tessellate_unbounded(const InfinitePlane& plane, double far_m) {
  const Surface& surface = plane.surface;
  const auto place = [&](int axis, std::size_t i) {
    constexpr double kInnerM = 30.0;
    const double half_m = plane.half_m[axis];
    const double outer_m = half_m > 0 ? half_m : far_m;
    return std::array{-outer_m, -std::min(kInnerM, outer_m), std::min(kInnerM, outer_m),
                      outer_m}[i];
  };
  std::vector<Vertex> vertices;
  const auto corner = [&](std::size_t i, std::size_t j) {
    const Eigen::Vector3d p(place(0, i), place(1, j), 0.0);
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

// Clip y grows downwards like the image's rows: window row 0 is the top of the image.
// X_WG: where the vertices' frame is.
Eigen::Matrix4d clip_from(const Shot& shot, const Eigen::Isometry3d& X_WG,
                          const DepthRange& depth) {
  const Intrinsics& intrinsics = shot.intrinsics;
  Eigen::Matrix4d clip = Eigen::Matrix4d::Zero();
  clip(0, 0) = 2.0 * intrinsics.f / intrinsics.width;
  clip(1, 1) = 2.0 * intrinsics.f / intrinsics.height;
  clip(2, 2) = 2.0 * depth.offset() - 1.0;
  clip(2, 3) = 2.0 * depth.slope();
  clip(3, 2) = 1.0;
  return clip * (shot.X_WC.inverse() * X_WG).matrix();
}

}  // namespace

TrianglePainter::TrianglePainter(const SceneGeometry& scene, const SceneTextures& textures,
                                 ProgramCache& programs, const DepthRange& depth, double far_m,
                                 double sky_luminance)
    : scene_(scene), textures_(textures), depth_(depth) {
  for (const TriangleBatch& batch : scene.static_triangles) {
    static_buffers_.push_back(upload_vertices(batch.vertices));
    const bool plain = batch.texture < 0;
    choosers_.emplace_back(
        batch, plain ? nullptr : &scene.textures[static_cast<std::size_t>(batch.texture)],
        textures.trilinear());
    make_program_for(programs, batch.texture);
  }
  for (const MovingTriangles& moving : scene.moving_triangles) {
    moving_buffers_.push_back(upload_vertices(moving.batch.vertices));
    make_program_for(programs, moving.batch.texture);
  }
  for (const InfinitePlane& plane : scene.infinite_planes) {
    unbounded_buffers_.push_back(upload_vertices(tessellate_unbounded(plane, far_m)));
    make_program_for(programs, plane.surface.texture);
  }
  sky_program_ = make_sky_program(programs, textures.kind_of(scene.sky_texture),
                                  scene.sky_texture >= 0 ? 1.0 : sky_luminance);
}

const GlProgram& TrianglePainter::program_for(int texture) const {
  return programs_[static_cast<std::size_t>(textures_.kind_of(texture))];
}

void TrianglePainter::make_program_for(ProgramCache& programs, int texture) {
  const TextureKind kind = textures_.kind_of(texture);
  GlProgram& program = programs_[static_cast<std::size_t>(kind)];
  if (!program.name) program = make_triangle_program(programs, kind, scene_);
}

// What draw() needs besides vertices and texture. G: the frame of the vertices.
void TrianglePainter::use(const Shot& shot, int texture, const Eigen::Matrix4d& clip_from_G,
                          const Eigen::Isometry3d& X_WG, const Eigen::Vector3d& texture_shift,
                          int id) const {
  const GlProgram& program = program_for(texture);
  gl::UseProgram(program.name);
  set_matrix(program.clip_from_G, clip_from_G);
  set_matrix(program.X_WG, X_WG.matrix());
  set_vector(program.texture_shift, texture_shift);
  gl::Uniform1i(program.id, id);
  gl::Uniform1f(program.lod_bias, static_cast<float>(shot.lod_bias));
}

void TrianglePainter::draw(const VertexBuffer& buffer, int texture) const {
  textures_.bind(texture);
  gl::BindVertexArray(buffer.array.name());
  gl::DrawArrays(GL_TRIANGLES, 0, buffer.count);
}

void TrianglePainter::draw(const VertexBuffer& buffer, const std::vector<std::uint32_t>& vertices,
                           int texture, bool finest_only) const {
  if (vertices.empty()) return;
  textures_.bind(texture, finest_only);
  gl::BindVertexArray(buffer.array.name());
  gl::BindBuffer(GL_ELEMENT_ARRAY_BUFFER, chosen_.name());
  gl::BufferData(GL_ELEMENT_ARRAY_BUFFER,
                 static_cast<GLsizeiptr>(vertices.size() * sizeof(vertices[0])), vertices.data(),
                 GL_STREAM_DRAW);
  gl::DrawElements(GL_TRIANGLES, static_cast<GLsizei>(vertices.size()), GL_UNSIGNED_INT, nullptr);
}

void TrianglePainter::draw_static(const Shot& shot) {
  for (std::size_t i = 0; i < static_buffers_.size(); ++i) {
    const int texture = scene_.static_triangles[i].texture;
    choosers_[i].choose(shot, choice_);
    const Eigen::Isometry3d X_WG = Eigen::Isometry3d::Identity();
    use(shot, texture, clip_from(shot, X_WG, depth_), X_WG, Eigen::Vector3d::Zero(), 0);
    draw(static_buffers_[i], choice_.finest, texture, true);
    draw(static_buffers_[i], choice_.mipmapped, texture, false);
  }
  draw_unbounded(shot);
  draw_sky(shot);
}

void TrianglePainter::draw_objects(const Shot& shot, const Snapshot& snapshot,
                                   const Eigen::Matrix4d& window_from_image) {
  for (std::size_t i = 0; i < moving_buffers_.size(); ++i) {
    const MovingTriangles& moving = scene_.moving_triangles[i];
    const auto object = static_cast<std::size_t>(moving.object);
    if (!snapshot.launched[object]) continue;
    const Eigen::Isometry3d X_WG = snapshot.objects[object].pose();
    use(shot, moving.batch.texture, window_from_image * clip_from(shot, X_WG, depth_), X_WG,
        Eigen::Vector3d::Zero(), moving.object + 1);
    draw(moving_buffers_[i], moving.batch.texture);
  }
}

void TrianglePainter::draw_unbounded(const Shot& shot) {
  for (std::size_t i = 0; i < scene_.infinite_planes.size(); ++i) {
    const InfinitePlane& plane = scene_.infinite_planes[i];
    Eigen::Vector3d foot = plane.pose.inverse() * shot.X_WC.translation();
    foot.z() = 0.0;
    foot = (plane.half_m.array() > 0).select(0.0, foot);  // borders stay where they are
    Eigen::Vector3d shift =
        foot.cwiseProduct(plane.surface.texture_scale) + plane.surface.texture_offset;
    // Flat textures repeat: whole periods are left out, so that floats suffice anywhere.
    const int texture = plane.surface.texture;
    const bool cube = texture >= 0 && scene_.textures[static_cast<std::size_t>(texture)].cube;
    if (!cube) shift -= shift.array().floor().matrix();
    const Eigen::Isometry3d X_WG = plane.pose * Eigen::Translation3d(foot);
    use(shot, texture, clip_from(shot, X_WG, depth_), X_WG, shift, 0);
    draw(unbounded_buffers_[i], plane.surface.texture);
  }
}

void TrianglePainter::draw_sky(const Shot& shot) {
  gl::UseProgram(sky_program_.name);
  set_camera(sky_program_, shot.intrinsics);
  set_matrix(sky_program_.R_WC, Eigen::Matrix3d(shot.X_WC.linear()));
  gl::Uniform1f(sky_program_.lod_bias, static_cast<float>(shot.lod_bias));
  textures_.bind(scene_.sky_texture);
  gl::BindVertexArray(no_vertices_.name());
  gl::DrawArrays(GL_TRIANGLE_STRIP, 0, 4);
}

}  // namespace dodgesim

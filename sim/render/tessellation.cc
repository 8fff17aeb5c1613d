#include "sim/render/tessellation.h"

#include <array>

namespace dodgesim {

namespace {

using Eigen::Vector3d;

Vertex make_vertex(const Vector3d& p, const Vector3d& normal, const Surface& surface,
                   const Eigen::Isometry3d& pose) {
  const Vector3d texture = p.cwiseProduct(surface.texture_scale) + surface.texture_offset;
  return {(pose * p).cast<float>(), (pose.linear() * normal).cast<float>(), texture.cast<float>(),
          static_cast<float>(surface.albedo),
          static_cast<float>(surface.albedo * surface.emission)};
}

void append_quad(const std::array<Vector3d, 4>& corners, const Vector3d& normal,
                 const Surface& surface, const Eigen::Isometry3d& pose, std::vector<Vertex>& out) {
  for (const std::size_t i : {0, 1, 2, 0, 2, 3}) {
    out.push_back(make_vertex(corners[i], normal, surface, pose));
  }
}

}  // namespace

void append_box(const Vector3d& size, const Surface& surface, const Eigen::Isometry3d& pose,
                std::vector<Vertex>& out) {
  for (int axis = 0; axis < 3; ++axis) {
    for (const double side : {-1.0, 1.0}) {
      const Vector3d normal = side * Vector3d::Unit(axis);
      const Vector3d u = size[(axis + 1) % 3] * Vector3d::Unit((axis + 1) % 3);
      const Vector3d v = size[(axis + 2) % 3] * Vector3d::Unit((axis + 2) % 3);
      const Vector3d center = size[axis] * normal;
      append_quad({center - u - v, center + u - v, center + u + v, center - u + v}, normal, surface,
                  pose, out);
    }
  }
}

void append_rectangle(const Vector3d& size, const Surface& surface, const Eigen::Isometry3d& pose,
                      std::vector<Vertex>& out) {
  const Vector3d u = size.x() * Vector3d::UnitX(), v = size.y() * Vector3d::UnitY();
  append_quad({-u - v, u - v, u + v, -u + v}, Vector3d::UnitZ(), surface, pose, out);
}

void append_mesh(const mjModel& model, int mesh, const Surface& surface,
                 const Eigen::Isometry3d& pose, std::vector<Vertex>& out) {
  // A vertex normal farther than this from the face's (cosine) belongs to a crease.
  constexpr float kCreaseCosine = 0.8f;
  using Map3f = Eigen::Map<const Eigen::Vector3f>;
  const float* vertices = model.mesh_vert + 3 * model.mesh_vertadr[mesh];
  const float* normals = model.mesh_normal + 3 * model.mesh_vertadr[mesh];
  const int texcoord_address = model.mesh_texcoordadr[mesh];
  const bool explicit_texture = texcoord_address >= 0 && surface.texture_scale.z() == 0;
  for (int face = 0; face < model.mesh_facenum[mesh]; ++face) {
    const int* index = model.mesh_face + 3 * (model.mesh_faceadr[mesh] + face);
    const Map3f p0(vertices + 3 * index[0]), p1(vertices + 3 * index[1]),
        p2(vertices + 3 * index[2]);
    const Eigen::Vector3f face_normal = (p1 - p0).cross(p2 - p0).normalized();
    for (int corner = 0; corner < 3; ++corner) {
      Eigen::Vector3f normal = Map3f(normals + 3 * index[corner]);
      if (normal.dot(face_normal) < kCreaseCosine) normal = face_normal;
      const Vector3d p = Map3f(vertices + 3 * index[corner]).cast<double>();
      Vertex vertex = make_vertex(p, normal.cast<double>(), surface, pose);
      if (explicit_texture) {
        const float* uv = model.mesh_texcoord + 2 * (texcoord_address + index[corner]);
        vertex.texture = {uv[0], uv[1], 0.0f};
      }
      out.push_back(vertex);
    }
  }
}

}  // namespace dodgesim

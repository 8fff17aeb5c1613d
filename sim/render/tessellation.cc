#include "sim/render/tessellation.h"

#include <array>
#include <map>
#include <tuple>
#include <utility>

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

void append_quad(const Quad& corners, const Vector3d& normal, const Surface& surface,
                 const Eigen::Isometry3d& pose, std::vector<Vertex>& out) {
  for (const std::size_t i : {0, 1, 2, 0, 2, 3}) {
    out.push_back(make_vertex(corners[i], normal, surface, pose));
  }
}

// Face of a box of the given half extents, across `axis` on the side -1 or 1.
Quad box_face(const Vector3d& size, int axis, double side) {
  const Vector3d u = size[(axis + 1) % 3] * Vector3d::Unit((axis + 1) % 3);
  const Vector3d v = size[(axis + 2) % 3] * Vector3d::Unit((axis + 2) % 3);
  const Vector3d center = side * size[axis] * Vector3d::Unit(axis);
  return {center - u - v, center + u - v, center + u + v, center - u + v};
}

Quad transformed(const Eigen::Isometry3d& pose, const Quad& quad) {
  return {pose * quad[0], pose * quad[1], pose * quad[2], pose * quad[3]};
}

// A vertex normal farther than this from the face's (cosine) belongs to a crease.
constexpr float kCreaseCosine = 0.8f;

using Map3f = Eigen::Map<const Eigen::Vector3f>;

}  // namespace

void append_box(const Vector3d& size, const Surface& surface, const Eigen::Isometry3d& pose,
                std::vector<Vertex>& out) {
  for (int axis = 0; axis < 3; ++axis) {
    for (const double side : {-1.0, 1.0}) {
      append_quad(box_face(size, axis, side), side * Vector3d::Unit(axis), surface, pose, out);
    }
  }
}

void append_box_faces(const Vector3d& size, const Eigen::Isometry3d& pose, std::vector<Quad>& out) {
  for (int axis = 0; axis < 3; ++axis) {
    for (const double side : {-1.0, 1.0}) {
      out.push_back(transformed(pose, box_face(size, axis, side)));
    }
  }
}

Quad rectangle(const Vector3d& size, const Eigen::Isometry3d& pose) {
  return transformed(pose, box_face({size.x(), size.y(), 0.0}, 2, 1.0));
}

void append_rectangle(const Vector3d& size, const Surface& surface, const Eigen::Isometry3d& pose,
                      std::vector<Vertex>& out) {
  append_quad(box_face({size.x(), size.y(), 0.0}, 2, 1.0), Vector3d::UnitZ(), surface, pose, out);
}

void append_mesh_creases(const mjModel& model, int mesh, const Eigen::Isometry3d& pose,
                         std::vector<Edge>& out) {
  const float* vertices = model.mesh_vert + 3 * model.mesh_vertadr[mesh];
  // Files repeat vertices where normals or texture coordinates differ: match them by position.
  using Point = std::tuple<float, float, float>;
  std::map<std::pair<Point, Point>, std::vector<Eigen::Vector3f>> normals_of;
  for (int face = 0; face < model.mesh_facenum[mesh]; ++face) {
    const int* index = model.mesh_face + 3 * (model.mesh_faceadr[mesh] + face);
    const Map3f p[3] = {Map3f(vertices + 3 * index[0]), Map3f(vertices + 3 * index[1]),
                        Map3f(vertices + 3 * index[2])};
    const Eigen::Vector3f normal = (p[1] - p[0]).cross(p[2] - p[0]).normalized();
    for (int i = 0; i < 3; ++i) {
      Point a(p[i].x(), p[i].y(), p[i].z());
      Point b(p[(i + 1) % 3].x(), p[(i + 1) % 3].y(), p[(i + 1) % 3].z());
      if (b < a) std::swap(a, b);
      normals_of[{a, b}].push_back(normal);
    }
  }
  const auto vector = [](const Point& p) {
    return Vector3d(std::get<0>(p), std::get<1>(p), std::get<2>(p));
  };
  for (const auto& [ends, normals] : normals_of) {
    if (normals.size() == 2 && normals[0].dot(normals[1]) > kCreaseCosine) continue;
    out.push_back({pose * vector(ends.first), pose * vector(ends.second)});
  }
}

void append_mesh(const mjModel& model, int mesh, const Surface& surface,
                 const Eigen::Isometry3d& pose, std::vector<Vertex>& out) {
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

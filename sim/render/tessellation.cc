#include "sim/render/tessellation.h"

#include <algorithm>
#include <cmath>
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

// Large faces come in parts, of which some may be near and others far (triangle_choice.h).
constexpr double kPartM = 1;
constexpr int kMostParts = 32;  // along a side

int parts_of(double side_m) {
  return std::clamp(static_cast<int>(std::ceil(side_m / kPartM)), 1, kMostParts);
}

// The end itself where `part` is 0 or `parts`, and the same from either end: parts of neighbouring
// faces meet.
Vector3d part_way(const Vector3d& from, const Vector3d& to, int part, int parts) {
  return from * (static_cast<double>(parts - part) / parts) +
         to * (static_cast<double>(part) / parts);
}

void append_quad(const Quad& corners, const Vector3d& normal, const Surface& surface,
                 const Eigen::Isometry3d& pose, std::vector<Vertex>& out) {
  const int across = parts_of((corners[1] - corners[0]).norm());
  const int down = parts_of((corners[3] - corners[0]).norm());
  const auto node = [&](int i, int j) {
    const Vector3d p = part_way(part_way(corners[0], corners[1], i, across),
                                part_way(corners[3], corners[2], i, across), j, down);
    out.push_back(make_vertex(p, normal, surface, pose));
  };
  for (int j = 0; j < down; ++j) {
    for (int i = 0; i < across; ++i) {
      node(i, j), node(i + 1, j), node(i + 1, j + 1);
      node(i, j), node(i + 1, j + 1), node(i, j + 1);
    }
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

void append_box_edges(const Vector3d& size, const Eigen::Isometry3d& pose, std::vector<Edge>& out) {
  for (int axis = 0; axis < 3; ++axis) {
    const int u = (axis + 1) % 3, v = (axis + 2) % 3;
    for (int corner = 0; corner < 4; ++corner) {
      const Vector3d normal_u = (corner & 1 ? 1.0 : -1.0) * Vector3d::Unit(u);
      const Vector3d normal_v = (corner & 2 ? 1.0 : -1.0) * Vector3d::Unit(v);
      const Vector3d middle = size[u] * normal_u + size[v] * normal_v;
      const Vector3d half = size[axis] * Vector3d::Unit(axis);
      out.push_back({pose * (middle - half),
                     pose * (middle + half),
                     Edge::Kind::kCrease,
                     {pose.linear() * normal_u, pose.linear() * normal_v}});
    }
  }
}

void append_cylinder(const Vector3d& size, const Surface& surface, const Eigen::Isometry3d& pose,
                     std::vector<Vertex>& out, std::vector<Edge>& edges) {
  constexpr double kOutlineErrorM = 5e-4;
  constexpr double kFewestSides = 12;
  const double cosine = std::max(1.0 - kOutlineErrorM / size.x(), 0.0);
  const int sides = static_cast<int>(std::ceil(std::max(kFewestSides, mjPI / std::acos(cosine))));
  const auto direction = [sides](double i) {
    const double angle = 2.0 * mjPI * i / sides;
    return Vector3d(std::cos(angle), std::sin(angle), 0.0);
  };
  const Vector3d half(0.0, 0.0, size.z());
  const auto add = [&](const Vector3d& p, const Vector3d& normal) {
    out.push_back(make_vertex(p, normal, surface, pose));
  };
  for (int i = 0; i < sides; ++i) {
    const Vector3d n0 = direction(i), n1 = direction(i + 1);
    const Vector3d p0 = size.x() * n0, p1 = size.x() * n1;
    add(p0 - half, n0), add(p1 - half, n1), add(p1 + half, n1);
    add(p0 - half, n0), add(p1 + half, n1), add(p0 + half, n0);
    const Vector3d facet = pose.linear() * direction(i + 0.5);
    for (const double side : {-1.0, 1.0}) {
      const Vector3d cap = side * Vector3d::UnitZ();
      add(side * half, cap), add(p0 + side * half, cap), add(p1 + side * half, cap);
      edges.push_back({pose * (p0 + side * half),
                       pose * (p1 + side * half),
                       Edge::Kind::kCrease,
                       {facet, pose.linear() * cap}});
    }
    edges.push_back({pose * (p0 - half),
                     pose * (p0 + half),
                     Edge::Kind::kSmooth,
                     {pose.linear() * direction(i - 0.5), facet},
                     size.x()});
  }
}

Quad rectangle(const Vector3d& size, const Eigen::Isometry3d& pose) {
  return transformed(pose, box_face({size.x(), size.y(), 0.0}, 2, 1.0));
}

void append_rectangle(const Vector3d& size, const Surface& surface, const Eigen::Isometry3d& pose,
                      std::vector<Vertex>& out) {
  append_quad(box_face({size.x(), size.y(), 0.0}, 2, 1.0), Vector3d::UnitZ(), surface, pose, out);
}

void append_mesh_edges(const mjModel& model, int mesh, const Eigen::Isometry3d& pose,
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
    Edge edge{pose * vector(ends.first), pose * vector(ends.second), Edge::Kind::kBorder, {}};
    if (normals.size() == 2) {
      const bool smooth = normals[0].dot(normals[1]) > kCreaseCosine;
      // The size of the faces stands for the radius of curvature.
      if (smooth) edge.bulge_m = (edge.b - edge.a).norm();
      edge.kind = smooth ? Edge::Kind::kSmooth : Edge::Kind::kCrease;
      for (std::size_t i = 0; i < 2; ++i) {
        edge.normals[i] = pose.linear() * normals[i].cast<double>();
      }
    }
    out.push_back(edge);
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

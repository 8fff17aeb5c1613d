#include "sim/render/static_edges.h"

#include <algorithm>
#include <optional>

namespace dodgesim {

namespace {

using Eigen::Vector3d;

constexpr double kToleranceM = 1e-4;

Vector3d normal_of(const Quad& quad) {
  return (quad[1] - quad[0]).cross(quad[3] - quad[0]).normalized();
}

// Keeps the part of the edge on the side of the plane through p to which `inward` points.
std::optional<Edge> clip(const Edge& edge, const Vector3d& p, const Vector3d& inward) {
  const double a = inward.dot(edge.a - p), b = inward.dot(edge.b - p);
  if (a < 0 && b < 0) return std::nullopt;
  Edge part = edge;
  if (a < 0) part.a = edge.a + a / (a - b) * (edge.b - edge.a);
  if (b < 0) part.b = edge.b + b / (b - a) * (edge.a - edge.b);
  return part;
}

// Segment in which the plane (p, n) cuts the quad.
std::optional<Edge> cut(const Quad& quad, const Vector3d& p, const Vector3d& n) {
  std::vector<Vector3d> points;
  for (std::size_t i = 0; i < 4; ++i) {
    const Vector3d &from = quad[i], &to = quad[(i + 1) % 4];
    const double a = n.dot(from - p), b = n.dot(to - p);
    if ((a < 0) == (b < 0)) continue;
    points.push_back(from + a / (a - b) * (to - from));
  }
  if (points.size() != 2) return std::nullopt;
  return Edge{points[0], points[1], Edge::Kind::kBorder, {}};
}

std::optional<Edge> intersect(const Quad& one, const Quad& other) {
  const Vector3d n = normal_of(other);
  std::optional<Edge> segment = cut(one, other[0], n);
  for (std::size_t i = 0; i < 4 && segment; ++i) {
    const Vector3d inward = n.cross(other[(i + 1) % 4] - other[i]).normalized();
    segment = clip(*segment, other[i], inward);
  }
  if (segment && (segment->b - segment->a).norm() < kToleranceM) return std::nullopt;
  return segment;
}

bool lies_on(const Vector3d& p, const Edge& edge) {
  const Vector3d along = edge.b - edge.a;
  const double t = std::clamp(along.dot(p - edge.a) / along.squaredNorm(), 0.0, 1.0);
  return (edge.a + t * along - p).norm() < kToleranceM;
}

}  // namespace

bool Edge::shows_from(const Vector3d& eye_W) const {
  if (kind == Kind::kBorder) return true;
  const bool first = normals[0].dot(eye_W - a) > 0, second = normals[1].dot(eye_W - a) > 0;
  return kind == Kind::kCrease ? first || second : first != second;
}

bool Edge::inside_outline(const Vector3d& eye_W) const {
  return kind == Kind::kCrease && normals[0].dot(eye_W - a) > 0 && normals[1].dot(eye_W - a) > 0;
}

std::vector<Edge> find_edges(const std::vector<Quad>& faces, const std::vector<Quad>& rectangles,
                             const std::vector<Edge>& creases) {
  std::vector<Edge> all = creases;
  for (const Quad& quad : rectangles) {
    for (std::size_t i = 0; i < 4; ++i) {
      all.push_back({quad[i], quad[(i + 1) % 4], Edge::Kind::kBorder, {}});
    }
  }
  for (std::size_t i = 0; i < faces.size(); ++i) {
    for (std::size_t j = i + 1; j < faces.size(); ++j) {
      if (const auto segment = intersect(faces[i], faces[j])) all.push_back(*segment);
    }
  }
  // Longest first: what lies on a kept edge adds nothing, except that the kept one may show more.
  std::stable_sort(all.begin(), all.end(), [](const Edge& p, const Edge& q) {
    return (p.b - p.a).squaredNorm() > (q.b - q.a).squaredNorm();
  });
  std::vector<Edge> kept;
  for (const Edge& edge : all) {
    const auto known = std::find_if(kept.begin(), kept.end(), [&edge](const Edge& k) {
      return lies_on(edge.a, k) && lies_on(edge.b, k);
    });
    if (known == kept.end()) {
      kept.push_back(edge);
    } else {
      known->kind = Edge::Kind::kBorder;
    }
  }
  return kept;
}

}  // namespace dodgesim

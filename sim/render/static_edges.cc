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
  return Edge{points[0], points[1]};
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

std::vector<Edge> find_edges(const std::vector<Quad>& quads, const std::vector<Edge>& extra) {
  std::vector<Edge> all = extra;
  for (const Quad& quad : quads) {
    for (std::size_t i = 0; i < 4; ++i) all.push_back({quad[i], quad[(i + 1) % 4]});
  }
  for (std::size_t i = 0; i < quads.size(); ++i) {
    for (std::size_t j = i + 1; j < quads.size(); ++j) {
      if (const auto segment = intersect(quads[i], quads[j])) all.push_back(*segment);
    }
  }
  // Longest first: what lies on a kept edge adds nothing.
  std::stable_sort(all.begin(), all.end(), [](const Edge& p, const Edge& q) {
    return (p.b - p.a).squaredNorm() > (q.b - q.a).squaredNorm();
  });
  std::vector<Edge> kept;
  for (const Edge& edge : all) {
    const bool known = std::any_of(kept.begin(), kept.end(), [&edge](const Edge& k) {
      return lies_on(edge.a, k) && lies_on(edge.b, k);
    });
    if (!known) kept.push_back(edge);
  }
  return kept;
}

}  // namespace dodgesim

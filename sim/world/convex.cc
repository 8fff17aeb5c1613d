#include "sim/world/convex.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <utility>

#include "sim/base/error.h"
#include "sim/world/mujoco_eigen.h"

namespace dodgesim {

namespace {

constexpr double kDistanceToleranceM = 1e-7;  // between upper and lower bound of the distance
constexpr double kTouchingM = 1e-9;
constexpr int kMaxGjkIterations = 100;

// Corners of the Minkowski difference a - b.
struct Simplex {
  std::array<Eigen::Vector3d, 4> w;
  int size = 0;
};

// Weights of the point nearest to the origin in the affine hull of the corners `index[0..n)`. False
// if it lies outside their convex hull or the corners are degenerate.
bool nearest_inside(const Simplex& s, const std::array<int, 4>& index, int n,
                    std::array<double, 4>& weight) {
  const auto w = [&](int k) -> const Eigen::Vector3d& {
    return s.w[static_cast<std::size_t>(index[static_cast<std::size_t>(k)])];
  };
  Eigen::Matrix3d gram = Eigen::Matrix3d::Identity();
  Eigen::Vector3d rhs = Eigen::Vector3d::Zero();
  double scale = 1;
  for (int i = 1; i < n; ++i) {
    const Eigen::Vector3d e = w(i) - w(0);
    for (int j = 1; j < n; ++j) gram(i - 1, j - 1) = e.dot(w(j) - w(0));
    rhs[i - 1] = -e.dot(w(0));
    scale *= gram(i - 1, i - 1);
  }
  const double determinant = gram.determinant();
  weight = {1, 0, 0, 0};
  if (!(determinant > 1e-12 * scale)) return n == 1;
  const Eigen::Vector3d x = gram.inverse() * rhs;
  for (int i = 1; i < n; ++i) {
    if (!(x[i - 1] > 0)) return false;
    weight[static_cast<std::size_t>(i)] = x[i - 1];
    weight[0] -= x[i - 1];
  }
  return weight[0] > 0;
}

// Reduces the simplex to the face that holds the point nearest to the origin, and returns that
// point. The newest corner (the last) belongs to that face.
Eigen::Vector3d reduce(Simplex& s) {
  Eigen::Vector3d best = Eigen::Vector3d::Zero();
  double best_norm = -1;
  Simplex face;
  const int newest = s.size - 1;
  for (int others = 0; others < (1 << newest); ++others) {
    std::array<int, 4> index = {newest, 0, 0, 0};
    int n = 1;
    for (int k = 0; k < newest; ++k) {
      if (others & (1 << k)) index[static_cast<std::size_t>(n++)] = k;
    }
    std::array<double, 4> weight{};
    if (!nearest_inside(s, index, n, weight)) continue;
    Eigen::Vector3d p = Eigen::Vector3d::Zero();
    for (std::size_t k = 0; k < static_cast<std::size_t>(n); ++k) {
      p += weight[k] * s.w[static_cast<std::size_t>(index[k])];
    }
    if (best_norm >= 0 && p.squaredNorm() >= best_norm) continue;
    best = p;
    best_norm = p.squaredNorm();
    face.size = n;
    for (std::size_t k = 0; k < static_cast<std::size_t>(n); ++k) {
      face.w[k] = s.w[static_cast<std::size_t>(index[k])];
    }
  }
  s = face;
  return best;
}

}  // namespace

Convex Convex::box(const Eigen::Isometry3d& pose, const Eigen::Vector3d& half_size_m) {
  Convex out;
  out.core_ = Core::kBox;
  out.R_ = pose.linear();
  out.centre_ = pose.translation();
  out.size_m_ = half_size_m;
  out.extent_m_ = half_size_m.norm();
  return out;
}

Convex Convex::sphere(const Eigen::Vector3d& centre, double radius_m) {
  Convex out;
  out.core_ = Core::kPoint;
  out.centre_ = centre;
  out.radius_m_ = radius_m;
  out.extent_m_ = radius_m;
  return out;
}

Convex Convex::capsule(const Eigen::Isometry3d& pose, double radius_m, double half_length_m) {
  Convex out;
  out.core_ = Core::kSegment;
  out.R_ = pose.linear();
  out.centre_ = pose.translation();
  out.size_m_ = Eigen::Vector3d(0, 0, half_length_m);
  out.radius_m_ = radius_m;
  out.extent_m_ = radius_m + half_length_m;
  return out;
}

Convex Convex::cylinder(const Eigen::Isometry3d& pose, double radius_m, double half_length_m) {
  Convex out;
  out.core_ = Core::kCylinder;
  out.R_ = pose.linear();
  out.centre_ = pose.translation();
  out.size_m_ = Eigen::Vector3d(radius_m, radius_m, half_length_m);
  out.extent_m_ = std::hypot(radius_m, half_length_m);
  return out;
}

Convex Convex::ellipsoid(const Eigen::Isometry3d& pose, const Eigen::Vector3d& half_size_m) {
  Convex out;
  out.core_ = Core::kEllipsoid;
  out.R_ = pose.linear();
  out.centre_ = pose.translation();
  out.size_m_ = half_size_m;
  out.extent_m_ = half_size_m.maxCoeff();
  return out;
}

Convex Convex::hull(const Eigen::Isometry3d& pose, std::vector<Eigen::Vector3d> vertices) {
  Convex out;
  out.core_ = Core::kVertices;
  out.R_ = pose.linear();
  out.centre_ = pose.translation();
  for (const Eigen::Vector3d& v : vertices) out.extent_m_ = std::max(out.extent_m_, v.norm());
  out.vertices_ = std::move(vertices);
  return out;
}

Convex Convex::from_geom(const mjModel& model, int geom, const std::string& label) {
  const Eigen::Isometry3d X = pose(model.geom_pos + 3 * geom, model.geom_quat + 4 * geom);
  const ConstMap3 size(model.geom_size + 3 * geom);
  switch (model.geom_type[geom]) {
    case mjGEOM_SPHERE:
      return sphere(X.translation(), size[0]);
    case mjGEOM_CAPSULE:
      return capsule(X, size[0], size[1]);
    case mjGEOM_CYLINDER:
      return cylinder(X, size[0], size[1]);
    case mjGEOM_ELLIPSOID:
      return ellipsoid(X, size);
    case mjGEOM_BOX:
      return box(X, size);
    case mjGEOM_MESH: {
      const int mesh = model.geom_dataid[geom];
      std::vector<Eigen::Vector3d> vertices;
      for (int k = 0; k < model.mesh_vertnum[mesh]; ++k) {
        const float* v = model.mesh_vert + 3 * (model.mesh_vertadr[mesh] + k);
        vertices.emplace_back(v[0], v[1], v[2]);
      }
      return hull(X, std::move(vertices));
    }
    default:
      throw ScenarioError(label + ": a geom of a body must be a sphere, capsule, cylinder, " +
                          "ellipsoid, box or mesh.");
  }
}

Eigen::Vector3d Convex::support(const Eigen::Vector3d& direction) const {
  if (core_ == Core::kPoint) return centre_;
  const Eigen::Vector3d d = R_.transpose() * direction;
  Eigen::Vector3d p = Eigen::Vector3d::Zero();
  switch (core_) {
    case Core::kPoint:
      break;
    case Core::kSegment:
    case Core::kBox:
      for (int k = 0; k < 3; ++k) p[k] = std::copysign(size_m_[k], d[k]);
      break;
    case Core::kCylinder: {
      const double radial = d.head<2>().norm();
      if (radial > 0) p.head<2>() = size_m_.x() / radial * d.head<2>();
      p.z() = std::copysign(size_m_.z(), d.z());
      break;
    }
    case Core::kEllipsoid: {
      const Eigen::Vector3d scaled = size_m_.cwiseProduct(d);
      p = size_m_.cwiseProduct(scaled) / scaled.norm();
      break;
    }
    case Core::kVertices:
      p = *std::ranges::max_element(
          vertices_,
          [&](const Eigen::Vector3d& a, const Eigen::Vector3d& b) { return a.dot(d) < b.dot(d); });
      break;
  }
  return centre_ + R_ * p;
}

double reach_m(const std::vector<Convex>& parts, const Eigen::Vector3d& direction) {
  double farthest_m = 0;
  for (const Convex& part : parts) farthest_m = std::max(farthest_m, part.reach_m(direction));
  return farthest_m;
}

std::vector<Convex> convex_parts(const mjModel& model, int body, const std::string& label,
                                 const std::function<bool(int geom)>& wanted) {
  std::vector<Convex> parts;
  const int first = model.body_geomadr[body];
  for (int geom = first; geom < first + model.body_geomnum[body]; ++geom) {
    if (wanted(geom)) parts.push_back(Convex::from_geom(model, geom, label));
  }
  return parts;
}

double radius_m(const std::vector<Convex>& parts) {
  double radius_m = 0;
  for (const Convex& part : parts) {
    radius_m = std::max(radius_m, part.centre().norm() + part.extent_m());
  }
  return radius_m;
}

double convex_gap_m(const Convex& a, const Convex& b, const Eigen::Isometry3d& X_AB) {
  const Eigen::Matrix3d R_BA = X_AB.linear().transpose();
  // v is the point of the core difference a - b that is nearest to the origin so far.
  Simplex simplex;
  Eigen::Vector3d v = a.centre() - X_AB * b.centre();
  if (v.norm() < kTouchingM) v = Eigen::Vector3d::UnitX();
  double core_distance = 0;
  for (int i = 0; i < kMaxGjkIterations; ++i) {
    const Eigen::Vector3d w = a.support(-v) - X_AB * b.support(R_BA * v);
    core_distance = v.norm();
    // v.w/|v| bounds the distance from below, |v| from above (from the first simplex on).
    if (simplex.size > 0 && core_distance - v.dot(w) / core_distance < kDistanceToleranceM) break;
    simplex.w[static_cast<std::size_t>(simplex.size++)] = w;
    v = reduce(simplex);
    core_distance = v.norm();
    if (simplex.size == 4 || core_distance < kTouchingM) {
      core_distance = 0;
      break;
    }
  }
  return std::max(0.0, core_distance - a.radius_m() - b.radius_m());
}

double convex_gap_m(const std::vector<Convex>& a, const std::vector<Convex>& b,
                    const Eigen::Isometry3d& X_AB, double most_m) {
  double least_m = most_m;
  for (const Convex& part : a) {
    for (const Convex& other : b) {
      const double at_least =
          (part.centre() - X_AB * other.centre()).norm() - part.extent_m() - other.extent_m();
      if (at_least >= least_m) continue;
      least_m = std::min(least_m, convex_gap_m(part, other, X_AB));
    }
  }
  return least_m;
}

}  // namespace dodgesim

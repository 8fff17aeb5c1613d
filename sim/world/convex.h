// Distance between convex bodies, whatever their kind: Gilbert, Johnson and Keerthi, "A fast
// procedure for computing the distance between complex objects in three-dimensional space", IEEE
// Journal of Robotics and Automation 4(2), 1988.
#pragma once

#include <Eigen/Dense>
#include <functional>
#include <limits>
#include <string>
#include <vector>

#include "sim/base/mujoco.h"

namespace dodgesim {

// A convex core, grown by a radius: a sphere is a grown point, a capsule a grown segment. Curved
// bodies so become bodies with corners, for which the method ends after finitely many steps.
class Convex {
 public:
  // Geom `geom` of the model in the frame of its body: sphere, capsule, ellipsoid, cylinder, box,
  // or (the convex hull of) a mesh. Throws ScenarioError, naming `label`, for any other kind.
  static Convex from_geom(const mjModel& model, int geom, const std::string& label);

  static Convex box(const Eigen::Isometry3d& pose, const Eigen::Vector3d& half_size_m);
  static Convex sphere(const Eigen::Vector3d& centre, double radius_m);
  static Convex capsule(const Eigen::Isometry3d& pose, double radius_m, double half_length_m);
  static Convex cylinder(const Eigen::Isometry3d& pose, double radius_m, double half_length_m);
  static Convex ellipsoid(const Eigen::Isometry3d& pose, const Eigen::Vector3d& half_size_m);
  static Convex hull(const Eigen::Isometry3d& pose, std::vector<Eigen::Vector3d> vertices);

  // The farthest point of the core in direction `d` (any length but zero), in the body's frame.
  Eigen::Vector3d support(const Eigen::Vector3d& d) const;
  double radius_m() const { return radius_m_; }
  const Eigen::Vector3d& centre() const { return centre_; }
  // How far the body reaches from the frame's origin in the direction of a unit vector.
  double reach_m(const Eigen::Vector3d& direction) const {
    return support(direction).dot(direction) + radius_m_;
  }
  // Of the sphere about centre() that encloses the body, radius included.
  double extent_m() const { return extent_m_; }

 private:
  enum class Core { kPoint, kSegment, kBox, kCylinder, kEllipsoid, kVertices };

  Core core_ = Core::kPoint;
  Eigen::Matrix3d R_ = Eigen::Matrix3d::Identity();
  Eigen::Vector3d centre_ = Eigen::Vector3d::Zero();
  Eigen::Vector3d size_m_ = Eigen::Vector3d::Zero();
  double radius_m_ = 0;
  double extent_m_ = 0;
  std::vector<Eigen::Vector3d> vertices_;
};

// How far the farthest of the parts reaches from the frame's origin in the direction of a unit
// vector; 0 if none does.
double reach_m(const std::vector<Convex>& parts, const Eigen::Vector3d& direction);

// Of the wanted geoms of a body, in the body's frame. Throws as from_geom() does.
std::vector<Convex> convex_parts(const mjModel& model, int body, const std::string& label,
                                 const std::function<bool(int geom)>& wanted);

// Radius [m] of a sphere about the frame's origin that encloses the parts, each by its own sphere;
// 0 without parts.
double radius_m(const std::vector<Convex>& parts);

// Distance [m] between the surfaces, 0 if they touch. X_AB: pose of b's frame in a's frame. Exact
// to about 1e-7 m for bodies with corners, 1e-6 m for cylinders and ellipsoids.
double convex_gap_m(const Convex& a, const Convex& b, const Eigen::Isometry3d& X_AB);

// The least between the parts of two bodies; `most_m` if they are at least that far apart.
double convex_gap_m(const std::vector<Convex>& a, const std::vector<Convex>& b,
                    const Eigen::Isometry3d& X_AB,
                    double most_m = std::numeric_limits<double>::infinity());

}  // namespace dodgesim

// Obstacles as ellipsoids: the minimum-volume fit around the six points of a detection and the
// distance from a point to the surface.
#pragma once

#include <Eigen/Dense>
#include <span>

namespace dodge {

struct Ellipsoid {
  Eigen::Vector3d centre_W = Eigen::Vector3d::Zero();            // [m]
  Eigen::Matrix3d axes_W = Eigen::Matrix3d::Identity();          // columns: principal directions
  Eigen::Vector3d semi_axes_m = Eigen::Vector3d::Constant(0.1);  // along these columns
};

Ellipsoid sphere(const Eigen::Vector3d& centre_W, double radius_m);

// Most points a fit takes; a detection has six.
inline constexpr int kMaxFitPoints = 16;

// Smallest ellipsoid around `points_W` (Falanga et al. 2020, reference (49): Moshtagh's
// formulation, Khachiyan's dual, solved with the away steps of Todd and Yildirim, which make it
// converge linearly). All points are on or inside; the volume is within 0.5 % of the smallest.
//
// A thin rectangle or coinciding points have no ellipsoid of non-zero volume around them. So the
// fit also encloses the points at +-min_half_width_m from the centre of the points along each axis
// of W, which changes nothing for a set that is wider than that. At most kMaxFitPoints points are
// considered. An empty set gives the regularising ball around the origin.
Ellipsoid minimum_volume_ellipsoid(std::span<const Eigen::Vector3d> points_W,
                                   double min_half_width_m);

struct SurfaceDistance {
  double distance_m = 0;                                  // to the surface; negative inside
  Eigen::Vector3d gradient_W = Eigen::Vector3d::UnitX();  // of distance_m at the point, unit length
};

// Distance of p_W from the surface and its gradient, the outward normal at the closest surface
// point (Falanga et al. 2020, reference (51): Eberly's formulation). Where several surface points
// are equally close (inside, on a plane of symmetry) one of them is taken, always the same.
SurfaceDistance distance_to_surface(const Ellipsoid& ellipsoid, const Eigen::Vector3d& p_W);

}  // namespace dodge

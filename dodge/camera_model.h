// Pinhole camera with optional radial-tangential distortion, and where it sits on the body.
#pragma once

#include <Eigen/Dense>
#include <optional>
#include <vector>

namespace dodge {

// u = fx X/Z + cx, v = fy Y/Z + cy for a point (X,Y,Z) in C (x right, y down, z forward).
struct CameraModel {
  // Of a camera that is rectified: the lens L behind which its pixels lie is turned against C, and
  // has focal lengths and a principal point of its own [px].
  struct Lens {
    double fx = 0, fy = 0, cx = 0, cy = 0;
    Eigen::Matrix3d R_CL = Eigen::Matrix3d::Identity();
  };

  int width = 320;                                // [px]
  int height = 240;                               // [px]
  double fx = 190.7, fy = 190.7;                  // focal lengths [px]
  double cx = 159.5, cy = 119.5;                  // principal point [px]
  double k1 = 0, k2 = 0, p1 = 0, p2 = 0, k3 = 0;  // radtan distortion (OpenCV's model); 0: none
  Eigen::Isometry3d X_BC = Eigen::Isometry3d::Identity();  // pose of C in B
  std::optional<Lens> lens = std::nullopt;                 // absent: that of C

  double mean_focal_px() const { return 0.5 * (fx + fy); }

  // Undistorted bearing (X/Z, Y/Z) of a pixel position; NaN where the distortion has no inverse, or
  // a lens looks at right angles to C's axis.
  Eigen::Vector2d bearing(const Eigen::Vector2d& pixel) const;

  // Ideal (undistorted) pixel position of a point in C. Requires p_C.z() > 0.
  Eigen::Vector2d project(const Eigen::Vector3d& p_C) const;

  // bearing() of every pixel, row-major (y * width + x).
  std::vector<Eigen::Vector2f> bearing_table() const;
};

}  // namespace dodge

// Pinhole camera geometry shared by renderer, sampler and sensors.
#pragma once

#include <Eigen/Dense>

namespace dodgesim {

// Pixel (0,0) is the centre of the top-left pixel. C: x right, y down, z forward.
struct Intrinsics {
  int width = 320;    // [px]
  int height = 240;   // [px]
  double f = 190.68;  // focal length [px]; square pixels, principal point at the image centre

  bool operator==(const Intrinsics&) const = default;

  double cx() const { return 0.5 * (width - 1); }
  double cy() const { return 0.5 * (height - 1); }

  Eigen::Vector2d project(const Eigen::Vector3d& p_C) const {
    return {f * p_C.x() / p_C.z() + cx(), f * p_C.y() / p_C.z() + cy()};
  }

  // Whether a point of the image plane [px] is on a pixel.
  bool contains(const Eigen::Vector2d& p) const {
    return p.x() >= -0.5 && p.x() < width - 0.5 && p.y() >= -0.5 && p.y() < height - 0.5;
  }
};

// Focal length for a horizontal field of view [deg] over `width` pixels.
double focal_length_px(int width, double horizontal_fov_deg);

// Half-open pixel rectangle [x0, x1) x [y0, y1).
struct Rect {
  int x0 = 0, y0 = 0, x1 = 0, y1 = 0;
  bool empty() const { return x0 >= x1 || y0 >= y1; }
  bool operator==(const Rect&) const = default;
};

// The pixels of both; may be empty.
Rect intersection(const Rect& a, const Rect& b);

// The smallest rectangle that holds both; an empty one counts for nothing.
Rect merged(const Rect& a, const Rect& b);

}  // namespace dodgesim

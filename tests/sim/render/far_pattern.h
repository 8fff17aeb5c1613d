// Far patterns, which a turning camera sees by the homography alone.
#pragma once

#include <Eigen/Dense>
#include <cmath>
#include <functional>
#include <vector>

#include "sim/render/turned_picture.h"

namespace dodgesim::testing {

inline constexpr int kMaxTurnPx = 16;

// Luminance as a function of the direction in W.
using Pattern = std::function<double(const Eigen::Vector3d&)>;

inline Intrinsics view() { return {160, 120, 190.68}; }

inline std::vector<float> picture(const Intrinsics& intrinsics, const Eigen::Matrix3d& R_WC,
                                  const Pattern& pattern) {
  std::vector<float> out;
  for (int y = 0; y < intrinsics.height; ++y) {
    for (int x = 0; x < intrinsics.width; ++x) {
      const Eigen::Vector3d d_C((x - intrinsics.cx()) / intrinsics.f,
                                (y - intrinsics.cy()) / intrinsics.f, 1);
      out.push_back(static_cast<float>(pattern((R_WC * d_C).normalized())));
    }
  }
  return out;
}

// Waves of about `wavelength_px` in both directions, oblique to the pixels.
inline Pattern waves(double wavelength_px) {
  const double k = 2 * M_PI * 190.68 / wavelength_px;
  return [k](const Eigen::Vector3d& d) {
    return 0.5 + 0.2 * std::sin(k * (0.8 * d.x() + 0.6 * d.y())) * std::cos(0.7 * k * d.x());
  };
}

inline TurnedPicture taken(const Eigen::Matrix3d& R_WC, const Pattern& pattern) {
  TurnedPicture out(view(), kMaxTurnPx);
  out.set(R_WC, picture(out.intrinsics(), R_WC, pattern));
  return out;
}

inline Eigen::Matrix3d turn(double rad, const Eigen::Vector3d& axis) {
  return Eigen::AngleAxisd(rad, axis.normalized()).toRotationMatrix();
}

inline std::vector<float> blended(TurnedPicture& a, TurnedPicture& b, const Eigen::Matrix3d& R_WC,
                                  double share) {
  std::vector<float> out(static_cast<std::size_t>(view().width * view().height));
  std::vector<float> scratch = out;
  blend_turned(view(), a, b, R_WC, share, scratch, out);
  return out;
}

}  // namespace dodgesim::testing

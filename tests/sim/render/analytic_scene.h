// Static scenes in closed form: what a ray sees and how far away. Keys drawn from them, and the
// pictures that a camera would take of them.
#pragma once

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <functional>
#include <utility>
#include <vector>

#include "sim/render/key_picture.h"

namespace dodgesim::testing {

struct Seen {
  double luminance = 0;
  double inverse_length = 0;  // of the ray, in units of the direction's length; 0: the sky
};

// Of the ray from a place in a direction of any length, both in W.
using AnalyticScene = std::function<Seen(const Eigen::Vector3d&, const Eigen::Vector3d&)>;

inline constexpr double kFocalPx = 190.68;
inline Intrinsics small_view() { return {160, 120, kFocalPx}; }
inline Rect whole(const Intrinsics& view) { return {0, 0, view.width, view.height}; }
inline std::size_t index_of(const Intrinsics& view, int x, int y) {
  return static_cast<std::size_t>(y) * static_cast<std::size_t>(view.width) +
         static_cast<std::size_t>(x);
}
inline std::size_t pixels_of(const Intrinsics& view) { return index_of(view, 0, view.height); }
inline std::vector<float> blank(const Intrinsics& view) {
  return std::vector<float>(pixels_of(view), -1.0f);
}

// With z_C = 1.
inline Eigen::Vector3d ray_W(const Intrinsics& camera, const Eigen::Isometry3d& X_WC, double x,
                             double y) {
  return X_WC.linear() *
         Eigen::Vector3d((x - camera.cx()) / camera.f, (y - camera.cy()) / camera.f, 1);
}

inline Seen seen(const AnalyticScene& scene, const Intrinsics& camera,
                 const Eigen::Isometry3d& X_WC, double x, double y) {
  return scene(X_WC.translation(), ray_W(camera, X_WC, x, y));
}

// A picture with one ray a pixel, as the renderer draws it.
struct Drawn {
  std::vector<float> luminance, inverse_depth;
};

inline Drawn draw(const AnalyticScene& scene, const Intrinsics& camera,
                  const Eigen::Isometry3d& X_WC) {
  Drawn drawn;
  for (int y = 0; y < camera.height; ++y) {
    for (int x = 0; x < camera.width; ++x) {
      const Seen s = seen(scene, camera, X_WC, x, y);
      drawn.luminance.push_back(static_cast<float>(s.luminance));
      drawn.inverse_depth.push_back(static_cast<float>(s.inverse_length));
    }
  }
  return drawn;
}

inline KeyPicture key_of(const AnalyticScene& scene, const Eigen::Isometry3d& X_WC,
                         const KeySpec& spec = {}, const Intrinsics& view = small_view()) {
  KeyPicture key(view, spec);
  const Drawn drawn = draw(scene, key.intrinsics(), X_WC);
  key.set(X_WC, drawn.luminance, drawn.inverse_depth);
  return key;
}

// The mean over each pixel's aperture, by 4 x 4 rays.
inline std::vector<float> photograph(const AnalyticScene& scene, const Intrinsics& camera,
                                     const Eigen::Isometry3d& X_WC) {
  constexpr int kRays = 4;
  std::vector<float> out;
  for (int y = 0; y < camera.height; ++y) {
    for (int x = 0; x < camera.width; ++x) {
      double sum = 0;
      for (int row = 0; row < kRays; ++row) {
        for (int column = 0; column < kRays; ++column) {
          const double right = (column + 0.5) / kRays - 0.5, down = (row + 0.5) / kRays - 0.5;
          sum += seen(scene, camera, X_WC, x + right, y + down).luminance;
        }
      }
      out.push_back(static_cast<float>(sum / (kRays * kRays)));
    }
  }
  return out;
}

inline double largest_difference(const std::vector<float>& a, const std::vector<float>& b) {
  double largest = a.size() == b.size() ? 0 : INFINITY;
  for (std::size_t i = 0; i < std::min(a.size(), b.size()); ++i) {
    largest = std::max(largest, std::abs(static_cast<double>(a[i]) - static_cast<double>(b[i])));
  }
  return largest;
}

inline Eigen::Isometry3d pose(const Eigen::Matrix3d& R, const Eigen::Vector3d& p = {0, 0, 0}) {
  Eigen::Isometry3d X = Eigen::Isometry3d::Identity();
  X.linear() = R;
  X.translation() = p;
  return X;
}

inline Eigen::Matrix3d turn(double rad, const Eigen::Vector3d& axis) {
  return Eigen::AngleAxisd(rad, axis.normalized()).toRotationMatrix();
}

// Waves of amplitude 0.2, no shorter than `wavelength` in any direction of the plane of x and y.
inline double waves(double x, double y, double wavelength) {
  const double k = 2 * M_PI / wavelength;
  return 0.5 + 0.1 * std::sin(k * (0.8 * x + 0.6 * y)) +
         0.1 * std::sin(0.9 * k * (0.6 * x - 0.8 * y) + 1);
}

// A pattern at infinity, about the axis z of W; wavelength in pixels at the centre.
inline AnalyticScene sky_waves(double wavelength_px) {
  return [wavelength_px](const Eigen::Vector3d&, const Eigen::Vector3d& d) {
    const Eigen::Vector3d u = d.normalized() * kFocalPx;
    return Seen{waves(u.x(), u.y(), wavelength_px), 0};
  };
}

// The plane n . p = c with a pattern in its x and y.
inline AnalyticScene plane(const Eigen::Vector3d& n, double c, double wavelength_m) {
  return [=](const Eigen::Vector3d& p, const Eigen::Vector3d& d) {
    const double inverse = n.dot(d) / (c - n.dot(p));
    if (inverse <= 0) return Seen{0.3, 0};
    const Eigen::Vector3d hit = p + d / inverse;
    return Seen{waves(hit.x(), hit.y(), wavelength_m), inverse};
  };
}

// Two scenes; the nearer one is seen.
inline AnalyticScene nearer_of(AnalyticScene a, AnalyticScene b) {
  return [a = std::move(a), b = std::move(b)](const Eigen::Vector3d& p, const Eigen::Vector3d& d) {
    const Seen first = a(p, d), second = b(p, d);
    return first.inverse_length >= second.inverse_length ? first : second;
  };
}

// A plain half-plane z = depth, x < edge, in front of nothing that is nearer.
inline AnalyticScene half_wall(double depth_m, double edge_m, double luminance) {
  return [=](const Eigen::Vector3d& p, const Eigen::Vector3d& d) {
    const double inverse = d.z() / (depth_m - p.z());
    const bool hit = inverse > 0 && p.x() + d.x() / inverse < edge_m;
    return hit ? Seen{luminance, inverse} : Seen{-1, -1};
  };
}

}  // namespace dodgesim::testing

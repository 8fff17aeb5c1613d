#include "sim/world/view_distance.h"

#include <algorithm>
#include <limits>

#include "sim/world/room_ray.h"

namespace dodgesim {

namespace {

constexpr int kColumns = 17;
constexpr int kRows = 13;
constexpr TimeUs kCastEveryUs = 10000;  // 10 rad/s turn the view by less than two rays in this time

}  // namespace

ViewDistance::ViewDistance(const Intrinsics& intrinsics) {
  for (int row = 0; row < kRows; ++row) {
    for (int column = 0; column < kColumns; ++column) {
      const double x = intrinsics.width * (static_cast<double>(column) / (kColumns - 1) - 0.5);
      const double y = intrinsics.height * (static_cast<double>(row) / (kRows - 1) - 0.5);
      rays_C_.push_back(Eigen::Vector3d(x, y, intrinsics.f).normalized());
    }
  }
}

double ViewDistance::nearest_m(const World& world, const Snapshot& now,
                               const Eigen::Isometry3d& X_BC) {
  const Eigen::Isometry3d X_WC = now.vehicle.pose() * X_BC;
  if (cast_us_ < 0 || now.t_us < cast_us_ || now.t_us >= cast_us_ + kCastEveryUs) {
    cast(world, X_WC);
    cast_us_ = now.t_us;
  }
  return cast_m_ - (X_WC.translation() - cast_p_W_).norm();
}

void ViewDistance::cast(const World& world, const Eigen::Isometry3d& X_WC) {
  cast_p_W_ = X_WC.translation();
  cast_m_ = std::numeric_limits<double>::infinity();
  for (const Eigen::Vector3d& ray_C : rays_C_) {
    const auto hit = room_along(world, cast_p_W_, X_WC.linear() * ray_C);
    if (hit) cast_m_ = std::min(cast_m_, hit->distance);
  }
}

}  // namespace dodgesim

#include "sim/paper/passage.h"

#include <algorithm>
#include <cmath>

#include "sim/base/vector3.h"
#include "sim/flight/setup.h"
#include "sim/world/world.h"

namespace dodgesim {

CameraRig camera_rig(const Scenario& scenario) {
  const World world(world_spec(scenario, {}));
  CameraRig rig{intrinsics(scenario.sensors.camera), world.vehicle().X_BC};
  rig.X_BC.resize(scenario.dodger.position.cameras());
  return rig;
}

bool centre_in_image(const Intrinsics& intrinsics, const Eigen::Vector3d& p_C) {
  return whole_in_image(intrinsics, p_C, 0);
}

bool whole_in_image(const Intrinsics& intrinsics, const Eigen::Vector3d& p_C, double radius_m) {
  if (p_C.z() <= 0) return false;
  const auto inside = [&](double lateral_m, int pixels) {
    const double tangent = 0.5 * pixels / intrinsics.f;
    return (tangent * p_C.z() - std::abs(lateral_m)) / std::hypot(1, tangent) >= radius_m;
  };
  return inside(p_C.x(), intrinsics.width) && inside(p_C.y(), intrinsics.height);
}

ObjectView view_of(const CameraRig& rig, const Eigen::Isometry3d& X_WB, const Eigen::Vector3d& p_W,
                   double radius_m) {
  ObjectView view;
  view.X_WC = X_WB * rig.X_BC.front();
  view.p_C = view.X_WC.inverse() * p_W;
  view.radius_m = radius_m;
  const auto every_camera = [&](double margin_m) {
    return std::ranges::all_of(rig.X_BC, [&](const Eigen::Isometry3d& X_BC) {
      return whole_in_image(rig.intrinsics, (X_WB * X_BC).inverse() * p_W, margin_m);
    });
  };
  view.centre_in_view = every_camera(0);
  view.whole_in_view = every_camera(radius_m);
  return view;
}

Eigen::Vector3d position_of(const DetectionRow& row) { return to_vector(row.p_W); }

bool on_outline(const ObjectView& view, const Eigen::Vector3d& p_W) {
  const Eigen::Vector3d detected_C = view.X_WC.inverse() * p_W;
  const double angle_rad = std::atan2(view.p_C.cross(detected_C).norm(), view.p_C.dot(detected_C));
  const double outline_rad = std::asin(std::min(1.0, view.radius_m / view.range_m()));
  return angle_rad <= outline_rad + kOutlineMarginRad;
}

Passage::Passage(const Trajectory& trajectory, const CameraRig& rig, std::size_t object)
    : trajectory_(trajectory), rig_(rig), object_(object) {}

TimeUs Passage::sample_us(std::size_t i) const {
  return std::min(trajectory_.start_us + static_cast<TimeUs>(i) * trajectory_.period_us,
                  trajectory_.end_us);
}

std::optional<ObjectView> Passage::at(TimeUs t_us) const {
  if (t_us < trajectory_.start_us || t_us > trajectory_.end_us) return std::nullopt;
  if (trajectory_.samples.empty()) return std::nullopt;
  const std::size_t last = trajectory_.samples.size() - 1;
  const auto i = std::min(
      last, static_cast<std::size_t>((t_us - trajectory_.start_us) / trajectory_.period_us));
  const std::size_t j = std::min(last, i + 1);
  const Trajectory::Sample &a = trajectory_.samples[i], &b = trajectory_.samples[j];
  if (!a.objects.at(object_) || !b.objects.at(object_)) return std::nullopt;

  const TimeUs span_us = sample_us(j) - sample_us(i);
  const double share =
      span_us > 0 ? static_cast<double>(t_us - sample_us(i)) / static_cast<double>(span_us) : 0;
  Eigen::Isometry3d X_WB = Eigen::Isometry3d::Identity();
  X_WB.linear() = a.q_W.slerp(share, b.q_W).toRotationMatrix();
  X_WB.translation() = a.p_W + share * (b.p_W - a.p_W);
  const Eigen::Vector3d p_W =
      *a.objects[object_] + share * (*b.objects[object_] - *a.objects[object_]);
  return view_of(rig_, X_WB, p_W, 0.5 * trajectory_.sizes_m.at(object_));
}

}  // namespace dodgesim

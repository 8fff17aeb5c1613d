#include "sim/flight/detection_log.h"

#include "sim/base/vector3.h"

namespace dodgesim {

DetectionLogger::DetectionLogger(const World& world, TimeUs output_delay_us)
    : world_(world), output_delay_us_(output_delay_us), found_(output_delay_us) {
  log_.first_of_object.resize(static_cast<std::size_t>(world.object_count()));
}

bool DetectionLogger::find(TimeUs now_us, std::span<const dodge::Detection> detections,
                           const Eigen::Vector3d& drift_W) {
  const bool found_before = found_object_;
  for (const dodge::Detection& detection : detections) {
    DetectionRow row;
    row.t_us = detection.t_us;
    row.output_us = now_us + output_delay_us_;
    row.obstacle_id = detection.obstacle_id;
    row.p_W = to_array(detection.centre_W);
    row.size_m = detection.size_m;
    row.depth_m = detection.depth_m;
    row.depth_sigma_m = detection.depth_sigma_m;
    const Found found = with_truth(detection, drift_W, row);
    found_object_ = found_object_ || found.true_object;
    found_.push(now_us, found);
  }
  return found_object_ && !found_before;
}

// Beside the object that was nearest; without one, or if nobody knows that instant any more, as it
// is.
DetectionLogger::Found DetectionLogger::with_truth(const dodge::Detection& detection,
                                                   const Eigen::Vector3d& drift_W,
                                                   DetectionRow row) const {
  const std::optional<Snapshot> truth = history_.at(detection.t_us);
  if (!truth) return {row};
  const Eigen::Isometry3d X_WC = truth->vehicle.pose() * world_.vehicle().X_BC.front();
  for (std::size_t i = 0; i < truth->objects.size(); ++i) {
    if (!truth->launched[i]) continue;
    const Eigen::Vector3d& p_W = truth->objects[i].p_W;
    const Eigen::Vector3d drifted_p_W = p_W + drift_W;
    const double error_m = (detection.centre_W - drifted_p_W).norm();
    if (row.position_error_m && error_m >= *row.position_error_m) continue;
    row.object = static_cast<int>(i);
    row.true_p_W = to_array(drifted_p_W);
    row.position_error_m = error_m;
    row.true_depth_m = (X_WC.inverse() * p_W).z();
  }
  if (!row.object) return {row};
  const double radius_m = world_.object(*row.object).bounding_radius_m;
  const Eigen::Vector3d& p_W = truth->objects[static_cast<std::size_t>(*row.object)].p_W;
  return {row, *row.position_error_m < true_detection_m(radius_m),
          (p_W - X_WC.translation()).norm()};
}

void DetectionLogger::add(const Found& found) {
  const DetectionRow& row = found.row;
  log_.rows.push_back(row);
  if (!found.true_object) return;
  const DetectionLog::First first{row.output_us, row.t_us, found.distance_m, *row.object};
  if (!log_.first) log_.first = first;
  auto& of_object = log_.first_of_object[static_cast<std::size_t>(*row.object)];
  if (!of_object) of_object = first;
}

}  // namespace dodgesim

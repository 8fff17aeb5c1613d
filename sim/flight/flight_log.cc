#include "sim/flight/flight_log.h"

#include <algorithm>

#include "sim/base/vector3.h"

namespace dodgesim {

namespace {

constexpr TimeUs kPeriodUs = 20000;
constexpr TimeUs kMostSamples = 256;  // longer flights are sampled more seldom

}  // namespace

FlightLogger::FlightLogger(const World& world, const Setup& setup) : setup_(setup) {
  log_.objects.resize(static_cast<std::size_t>(world.object_count()));
  Trajectory& trajectory = log_.trajectory;
  trajectory.start_us = std::max(setup.start_us, kTickUs);  // nobody observes the instant 0
  const TimeUs even_us = (setup.end_us - setup.start_us) / kMostSamples / kTickUs * kTickUs;
  trajectory.period_us = std::max(kPeriodUs, even_us + kTickUs);
  for (int i = 0; i < world.object_count(); ++i) {
    trajectory.sizes_m.push_back(2 * world.object(i).bounding_radius_m);
  }
}

void FlightLogger::observe(const World& world, const VelocityReference& reference) {
  const Snapshot& now = world.snapshot();
  for (std::size_t i = 0; i < log_.objects.size(); ++i) {
    FlightLog::Object& object = log_.objects[i];
    if (object.in_view_near || !now.launched[i]) continue;
    const std::optional<double> distance_m = distance_in_view_m(world, i);
    if (!distance_m) continue;
    if (!object.in_view_us) object.in_view_us = now.t_us;
    object.in_view_near = *distance_m <= setup_.near_m;
  }
  Trajectory& trajectory = log_.trajectory;
  if (now.t_us < trajectory.start_us) return;
  trajectory.end_us = now.t_us;
  if ((now.t_us - trajectory.start_us) % trajectory.period_us == 0) {
    trajectory.samples.push_back(sample(now, reference));
    last_.reset();
  } else {
    last_ = sample(now, reference);
  }
}

std::optional<double> FlightLogger::distance_in_view_m(const World& world,
                                                       std::size_t object) const {
  const Snapshot& now = world.snapshot();
  std::optional<double> least_m;
  const double diameter_m = 2 * world.object(static_cast<int>(object)).bounding_radius_m;
  for (int camera = 0; camera < setup_.cameras; ++camera) {
    const Eigen::Isometry3d& X_BC = world.vehicle().X_BC[static_cast<std::size_t>(camera)];
    const Eigen::Vector3d p_C = (now.vehicle.pose() * X_BC).inverse() * now.objects[object].p_W;
    if (p_C.z() <= 0 || setup_.intrinsics.f * diameter_m < p_C.z()) continue;
    if (!setup_.intrinsics.contains(setup_.intrinsics.project(p_C))) continue;
    least_m = std::min(p_C.norm(), least_m.value_or(p_C.norm()));
  }
  return least_m;
}

Trajectory::Sample FlightLogger::sample(const Snapshot& now,
                                        const VelocityReference& reference) const {
  Trajectory::Sample sample;
  sample.p_W = now.vehicle.p_W;
  sample.q_W = now.vehicle.q_W;
  sample.command_W = reference.v_W;
  sample.evading = reference.evading;
  for (std::size_t i = 0; i < now.objects.size(); ++i) {
    sample.objects.emplace_back();
    if (now.launched[i]) sample.objects.back() = now.objects[i].p_W;
  }
  return sample;
}

void FlightLogger::add_detection(const DetectionRow& row, bool true_object) {
  if (true_object) {
    FlightLog::Object& object = log_.objects.at(static_cast<std::size_t>(*row.object));
    if (!object.known_us) object.known_us = row.output_us;
    object.detections.push_back({row.output_us, to_vector(row.p_W) - to_vector(*row.true_p_W)});
  }
  std::vector<Trajectory::Detection>& shown = log_.trajectory.detections;
  const auto recent = [&](const Trajectory::Detection& d) {
    return d.true_object == true_object &&
           d.output_us > row.output_us - log_.trajectory.period_us / 2;
  };
  if (std::any_of(shown.rbegin(), shown.rend(), recent)) return;
  shown.push_back({row.output_us, to_vector(row.p_W), true_object});
}

void FlightLogger::add_told(int object, TimeUs output_us) {
  std::optional<TimeUs>& known_us = log_.objects.at(static_cast<std::size_t>(object)).known_us;
  if (!known_us) known_us = output_us;
}

void FlightLogger::add_command(const Snapshot& now, const VelocityReference& reference) {
  if (!now.any_launched()) return;
  log_.commands.push_back({now.t_us, reference.evading, reference.v_W, now.vehicle.v_W});
}

FlightLog FlightLogger::log() const {
  FlightLog log = log_;
  if (last_) log.trajectory.samples.push_back(*last_);
  return log;
}

}  // namespace dodgesim

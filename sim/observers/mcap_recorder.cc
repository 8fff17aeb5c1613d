#include "sim/observers/mcap_recorder.h"

#include <cmath>
#include <opencv2/imgproc.hpp>
#include <optional>

#include "sim/base/error.h"
#include "sim/base/formatted.h"
#include "sim/files/png.h"
#include "sim/observers/foxglove_models.h"

namespace dodgesim {

namespace {

using foxglove::Colour;
using foxglove::Level;

constexpr TimeUs kPoseEveryUs = 4000;
constexpr TimeUs kImageEveryUs = 10000;
constexpr TimeUs kPathPointEveryUs = 20000;
constexpr TimeUs kPathEveryUs = 40000;
constexpr std::size_t kPathPoints = 200;  // the last four seconds

constexpr double kArrowMPerMps = 0.25;  // length of a velocity's arrow

const Colour kRoom(0.6, 0.6, 0.6, 0.35), kObject(1.0, 0.45, 0.1, 1), kVehiclePath(0.2, 0.6, 1, 1);
const Colour kCalm(0.3, 0.8, 0.4, 0.9), kEvading(0.95, 0.2, 0.2, 0.9);
const Colour kDetection(0.9, 0.1, 0.8, 0.9), kUncertainty(0.9, 0.1, 0.8, 0.25);

std::string camera_frame(std::size_t i) { return std::string("camera_") + kCameraNames.at(i); }
std::string object_frame(std::size_t i) { return "object_" + std::to_string(i); }
std::string camera_topic(std::size_t i, const std::string& what) {
  return std::string("/camera/") + kCameraNames.at(i) + "/" + what;
}

// Turns x towards `direction`. (Eigen's FromTwoVectors takes seconds to compile.)
Eigen::Quaterniond along(const Eigen::Vector3d& direction) {
  const double yaw = std::atan2(direction.y(), direction.x());
  const double pitch = -std::atan2(direction.z(), std::hypot(direction.x(), direction.y()));
  return Eigen::AngleAxisd(yaw, Eigen::Vector3d::UnitZ()) *
         Eigen::AngleAxisd(pitch, Eigen::Vector3d::UnitY());
}

namespace schema {

using namespace foxglove::schema;

Json imu() {
  return object("dodgesim.Imu", {{"timestamp", time()},
                                 {"angular_velocity_radps", vector()},
                                 {"specific_force_mps2", vector()}});
}

Json state() {
  return object("dodgesim.State", {{"timestamp", time()},
                                   {"position_m", vector()},
                                   {"velocity_mps", vector()},
                                   {"true_position_m", vector()},
                                   {"true_velocity_mps", vector()}});
}

Json range() { return object("dodgesim.Range", {{"timestamp", time()}, {"range_m", number()}}); }

Json command() {
  return object("dodgesim.Command", {{"timestamp", time()},
                                     {"velocity_mps", vector()},
                                     {"speed_mps", number()},
                                     {"evading", boolean()},
                                     {"landing", boolean()}});
}

Json approach() {
  return object("dodgesim.Approach", {{"timestamp", time()},
                                      {"object", number()},
                                      {"distance_m", number()},
                                      {"closing_mps", number()}});
}

}  // namespace schema

}  // namespace

McapRecorder::McapRecorder(const std::string& path, const Intrinsics& intrinsics, int cameras,
                           TimeUs pilot_us)
    : writer_(path), intrinsics_(intrinsics), detections_(pilot_us) {
  add_topic("/tf", schema::frame_transforms());
  for (const char* part : {"room", "vehicle", "objects", "paths", "detections", "command"}) {
    add_topic(std::string("/scene/") + part, schema::scene_update());
  }
  add_topic("/vehicle/truth", schema::pose_in_frame());
  add_topic("/vehicle/estimate", schema::pose_in_frame());
  for (std::size_t i = 0; i < static_cast<std::size_t>(cameras); ++i) {
    add_topic(camera_topic(i, "events"), schema::compressed_image());
    add_topic(camera_topic(i, "calibration"), schema::camera_calibration());
    eyes_.emplace_back(intrinsics.width, intrinsics.height);
  }
  add_topic("/imu", schema::imu());
  add_topic("/state", schema::state());
  add_topic("/range", schema::range());
  add_topic("/command", schema::command());
  add_topic("/approach", schema::approach());
  add_topic("/log", schema::log());
}

void McapRecorder::add_topic(const std::string& topic, const Json& schema) {
  topics_[topic] = writer_.add_topic(topic, schema.at("title"), to_text(schema));
}

void McapRecorder::write(const std::string& topic, TimeUs t_us, const Json& message) {
  writer_.write(topics_.at(topic), t_us, to_text(message));
}

void McapRecorder::say(TimeUs t_us, Level level, const std::string& message) {
  write("/log", t_us, foxglove::log(t_us, level, message));
}

// What does not change.
void McapRecorder::begin(const World& world) {
  begun_ = true;
  X_BC_ = world.vehicle().X_BC;
  shown_.assign(now_.objects.size(), false);
  paths_.resize(1 + now_.objects.size());
  Json room = foxglove::entity(now_.t_us, "world", "room");
  foxglove::add_room(world.model(), kRoom, room);
  write("/scene/room", now_.t_us, foxglove::scene_update({room}));
  Json vehicle = foxglove::entity(now_.t_us, "vehicle", "vehicle");
  foxglove::add_body(world.model(), world.vehicle_body(), std::nullopt, vehicle);
  write("/scene/vehicle", now_.t_us, foxglove::scene_update({vehicle}));
  for (std::size_t i = 0; i < eyes_.size(); ++i) {
    write(camera_topic(i, "calibration"), now_.t_us,
          foxglove::camera_calibration(now_.t_us, camera_frame(i), intrinsics_.width,
                                       intrinsics_.height, intrinsics_.f));
  }
}

void McapRecorder::on_tick(const World& world) {
  // Pictures first: the last packets before this tick have come only after its beginning.
  if (now_.t_us % kImageEveryUs == 0 && begun_) write_images(now_.t_us);
  now_ = world.snapshot();
  if (!begun_) begin(world);
  show_launches(world);
  if (now_.t_us % kPoseEveryUs == 0) {
    write_transforms();
    write_approach();
    write("/vehicle/truth", now_.t_us,
          foxglove::pose_in_frame(now_.t_us, "world", now_.vehicle.p_W, now_.vehicle.q_W));
  }
  if (now_.t_us % kPathPointEveryUs == 0) {
    paths_[0].push_back(now_.vehicle.p_W);
    for (std::size_t i = 0; i < now_.objects.size(); ++i) {
      if (now_.launched[i]) paths_[1 + i].push_back(now_.objects[i].p_W);
    }
    for (auto& path : paths_) {
      if (path.size() > kPathPoints) path.pop_front();
    }
  }
  if (now_.t_us % kPathEveryUs == 0) write_paths();
  detections_.deliver(now_.t_us, [this](const auto& found) { write_detections(found); });
}

void McapRecorder::show_launches(const World& world) {
  if (now_.launched == shown_) return;
  std::vector<Json> entities;
  for (std::size_t i = 0; i < now_.objects.size(); ++i) {
    if (!now_.launched[i]) continue;
    entities.push_back(foxglove::entity(now_.t_us, object_frame(i), object_frame(i)));
    foxglove::add_body(world.model(), world.object_body(static_cast<int>(i)), kObject,
                       entities.back());
    if (!shown_[i]) {
      say(now_.t_us, Level::kInfo,
          formatted("Object %zu is thrown, %.2f m away.", i,
                    (now_.objects[i].p_W - now_.vehicle.p_W).norm()));
    }
  }
  shown_ = now_.launched;
  // All of them, because a reader that jumps in time takes the last message of a topic only.
  write("/scene/objects", now_.t_us, foxglove::scene_update(entities));
}

void McapRecorder::write_transforms() {
  Json transforms = Json::array();
  transforms.push_back(
      foxglove::frame_transform(now_.t_us, "world", "vehicle", now_.vehicle.p_W, now_.vehicle.q_W));
  for (std::size_t i = 0; i < X_BC_.size() && i < eyes_.size(); ++i) {
    transforms.push_back(foxglove::frame_transform(now_.t_us, "vehicle", camera_frame(i),
                                                   X_BC_[i].translation(),
                                                   Eigen::Quaterniond(X_BC_[i].linear())));
  }
  for (std::size_t i = 0; i < now_.objects.size(); ++i) {
    if (!now_.launched[i]) continue;
    transforms.push_back(foxglove::frame_transform(now_.t_us, "world", object_frame(i),
                                                   now_.objects[i].p_W, now_.objects[i].q_W));
  }
  write("/tf", now_.t_us, {{"transforms", transforms}});
}

// Of the nearest object.
void McapRecorder::write_approach() {
  std::optional<std::size_t> nearest;
  const auto offset_W = [this](std::size_t i) -> Eigen::Vector3d {
    return now_.objects[i].p_W - now_.vehicle.p_W;
  };
  for (std::size_t i = 0; i < now_.objects.size(); ++i) {
    if (now_.launched[i] && (!nearest || offset_W(i).norm() < offset_W(*nearest).norm())) {
      nearest = i;
    }
  }
  if (!nearest) return;
  const Eigen::Vector3d towards_W = offset_W(*nearest).normalized();
  const Eigen::Vector3d v_W = now_.objects[*nearest].v_W - now_.vehicle.v_W;
  write("/approach", now_.t_us,
        {{"timestamp", foxglove::time(now_.t_us)},
         {"object", *nearest},
         {"distance_m", offset_W(*nearest).norm()},
         {"closing_mps", -towards_W.dot(v_W)}});
}

void McapRecorder::write_paths() {
  Json paths = foxglove::entity(now_.t_us, "world", "paths");
  for (std::size_t i = 0; i < paths_.size(); ++i) {
    if (paths_[i].size() < 2) continue;
    paths["lines"].push_back(foxglove::line(foxglove::LineKind::kStrip,
                                            {paths_[i].begin(), paths_[i].end()}, 0.015,
                                            i == 0 ? kVehiclePath : kObject));
  }
  write("/scene/paths", now_.t_us, foxglove::scene_update({paths}));
}

void McapRecorder::write_images(TimeUs t_us) {
  for (std::size_t i = 0; i < eyes_.size(); ++i) {
    cv::Mat1b grey;
    cv::cvtColor(eyes_[i].image(), grey, cv::COLOR_BGR2GRAY);
    write(camera_topic(i, "events"), t_us,
          foxglove::compressed_image(t_us, camera_frame(i), png_of(grey)));
    eyes_[i].clear();
  }
}

void McapRecorder::on_imu(const ImuReading& reading) {
  write("/imu", reading.t_us,
        {{"timestamp", foxglove::time(reading.t_us)},
         {"angular_velocity_radps", foxglove::vector(reading.w_B_radps)},
         {"specific_force_mps2", foxglove::vector(reading.f_B_mps2)}});
}

void McapRecorder::on_state(const StateReading& reading) {
  write("/vehicle/estimate", reading.t_us,
        foxglove::pose_in_frame(reading.t_us, "world", reading.p_W, reading.q_W));
  write("/state", reading.t_us,
        {{"timestamp", foxglove::time(reading.t_us)},
         {"position_m", foxglove::vector(reading.p_W)},
         {"velocity_mps", foxglove::vector(reading.v_W)},
         {"true_position_m", foxglove::vector(now_.vehicle.p_W)},
         {"true_velocity_mps", foxglove::vector(now_.vehicle.v_W)}});
}

void McapRecorder::on_range(const RangeReading& reading) {
  write("/range", reading.t_us,
        {{"timestamp", foxglove::time(reading.t_us)}, {"range_m", reading.range_m}});
}

void McapRecorder::on_events(int camera, const Packet& packet) {
  eyes_.at(static_cast<std::size_t>(camera)).add(packet.events);
}

void McapRecorder::on_cycle(TimeUs now_us, const dodge::Pilot& pilot) {
  const auto found = pilot.detections();
  detections_.push(now_us, {found.begin(), found.end()});
}

void McapRecorder::write_detections(const std::vector<dodge::Detection>& detections) {
  Json entity = foxglove::entity(now_.t_us, "world", "detections");
  for (const dodge::Detection& detection : detections) {
    const Eigen::Vector3d ray_W = detection.centre_W - now_.vehicle.p_W;
    const double size_m = detection.size_m;
    const double deep_m = size_m + 4 * detection.depth_sigma_m;
    const Json pose = foxglove::pose(detection.centre_W, along(ray_W));
    entity["spheres"].push_back(
        foxglove::ellipsoid(pose, Eigen::Vector3d::Constant(size_m), kDetection));
    entity["spheres"].push_back(foxglove::ellipsoid(pose, {deep_m, size_m, size_m}, kUncertainty));
    if (!detected_) {
      say(now_.t_us, Level::kInfo, formatted("First detection, %.2f m deep.", detection.depth_m));
    }
    detected_ = true;
  }
  write("/scene/detections", now_.t_us, foxglove::scene_update({entity}));
}

void McapRecorder::on_velocity(TimeUs now_us, const dodge::VelocityCommand& command) {
  const double speed_mps = command.v_W.norm();
  write("/command", now_us,
        {{"timestamp", foxglove::time(now_us)},
         {"velocity_mps", foxglove::vector(command.v_W)},
         {"speed_mps", speed_mps},
         {"evading", command.evading},
         {"landing", command.landing}});
  if (command.landing && !landing_) say(now_us, Level::kWarning, "The vehicle lands.");
  landing_ = command.landing;
  Json entity = foxglove::entity(now_us, "world", "command");
  if (speed_mps > 0) {
    entity["arrows"].push_back(foxglove::arrow(foxglove::pose(now_.vehicle.p_W, along(command.v_W)),
                                               kArrowMPerMps * speed_mps, 0.03,
                                               command.evading ? kEvading : kCalm));
  }
  write("/scene/command", now_us, foxglove::scene_update({entity}));
}

void McapRecorder::on_command(TimeUs now_us, bool evading) {
  if (evading != evading_) {
    say(now_us, evading ? Level::kWarning : Level::kInfo,
        evading ? "The vehicle evades." : "The vehicle evades no longer.");
  }
  evading_ = evading;
}

void McapRecorder::finish(const ThrowResult& result) {
  const TimeUs end_us = now_.t_us;
  const FlightResult& flown = result.flown;
  if (flown.failed()) {
    say(end_us, Level::kError, "The flight failed: " + flown.error);
  } else if (flown.hit) {
    say(flown.hit_us.value_or(end_us), Level::kError, "The vehicle is hit.");
  } else if (flown.crashed) {
    say(end_us, Level::kError, "The vehicle crashes.");
  } else if (result.landed_us) {
    say(*result.landed_us, Level::kInfo, "The vehicle has landed.");
  } else if (flown.clearance_m) {
    say(flown.closest_us.value_or(end_us), Level::kInfo,
        formatted("Closest approach: %.3f m between the surfaces.", *flown.clearance_m));
  }
  if (result.none.ok()) {
    say(end_us, Level::kInfo,
        result.none.hit ? "Without dodging it would have been hit."
                        : "It would not have been hit without dodging either.");
  }
  writer_.finish();
}

}  // namespace dodgesim

// A throw as a recording that Foxglove and Lichtblick open: the scene in 3-D, what both event
// cameras see, what the sensors and the pilot say, and what became of it.
//
//   /tf                         where vehicle, cameras and objects truly are
//   /scene/room, /vehicle, /objects, /paths   how they look, and where they have been
//   /scene/detections           detections, with two standard deviations of their depth
//   /scene/command              the velocity that the pilot wants; red while it evades
//   /vehicle/truth, /estimate   poses
//   /camera/top/events, /calibration; /camera/bottom/...   ON white, OFF black, 100 a second
//   /imu, /state, /range, /command, /approach   numbers to plot
//   /log                        what happens, in words
#pragma once

#include <deque>
#include <map>
#include <string>
#include <vector>

#include "sim/bridge/delay_line.h"
#include "sim/camera/camera.h"
#include "sim/files/mcap_writer.h"
#include "sim/flight/flight_observer.h"
#include "sim/observers/film.h"
#include "sim/observers/foxglove.h"
#include "sim/outcome/result.h"

namespace dodgesim {

class McapRecorder : public FlightObserver {
 public:
  // All functions throw IoError when the file cannot be written.
  // `cameras` are in use: none to two. pilot_us: how long after its cycle began the pilot gives out
  // what it has detected.
  McapRecorder(const std::string& path, const Intrinsics& intrinsics, int cameras, TimeUs pilot_us);

  void on_tick(const World& world) override;
  void on_imu(const ImuReading& reading) override;
  void on_state(const StateReading& reading) override;
  void on_range(const RangeReading& reading) override;
  void on_events(int camera, const Packet& packet) override;
  void on_cycle(TimeUs now_us, const dodge::Pilot& pilot) override;
  void on_velocity(TimeUs now_us, const dodge::VelocityCommand& command) override;
  void on_command(TimeUs now_us, bool evading) override;

  // Completes the file with the verdict.
  void finish(const ThrowResult& result);

 private:
  void write(const std::string& topic, TimeUs t_us, const Json& message);
  void add_topic(const std::string& topic, const Json& schema);
  void say(TimeUs t_us, foxglove::Level level, const std::string& message);
  void begin(const World& world);
  void show_launches(const World& world);
  void write_transforms();
  void write_approach();
  void write_paths();
  void write_images(TimeUs t_us);
  void write_detections(const std::vector<dodge::Detection>& detections);

  McapWriter writer_;
  std::map<std::string, std::uint16_t> topics_;
  Intrinsics intrinsics_;
  std::vector<EventPicture> eyes_;
  std::vector<Eigen::Isometry3d> X_BC_;
  Snapshot now_;
  std::vector<bool> shown_;                         // objects, by index
  std::vector<std::deque<Eigen::Vector3d>> paths_;  // of the vehicle, then of the objects
  bool begun_ = false;
  bool evading_ = false;
  bool landing_ = false;
  DelayLine<std::vector<dodge::Detection>> detections_;  // until the pilot gives them out
  bool detected_ = false;
};

}  // namespace dodgesim

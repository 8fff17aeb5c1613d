// A flight as the vehicle would record it, for whoever wants to try a detector of his own, or
// `dodgesim detect`, on it:
//
//   top.h5, bottom.h5       the events (sim/recordings/event_writer.h), with their causes
//   top.yaml, bottom.yaml   the cameras as the pilot is told of them (camera_calibration.h)
//   imu.csv, state.csv, range.csv   what the pilot gets (sim/recordings/sensor_log.h), by the
//                           instants that it speaks of, not those at which it arrives
//   scenario.yaml           pilot, parameters and delays among it, every value spelled out
//   truth.csv               at the instants of imu.csv, where vehicle and objects truly are
//                           [m, m/s, rad/s]; cells of objects are empty before their launch
//
// Of mono there is one camera, of a pilot that needs none (oracle, none) there are none. All that
// the cameras see comes as far as it reaches the computer before the flight ends.
#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "sim/config/scenario.h"
#include "sim/files/directory.h"
#include "sim/files/output_file.h"
#include "sim/flight/flight_observer.h"
#include "sim/recordings/event_writer.h"

namespace dodgesim {

// A recording may be replaced, but no other file of the user's: throws ScenarioError if the
// directory has one of a log's names and neither events nor all that a log without cameras has.
// `option` named the directory.
void expect_recording_or_nothing(const std::filesystem::path& directory, const std::string& option);

class VehicleLog : public FlightObserver {
 public:
  // All functions throw IoError; without finish() no file appears, and an earlier recording in the
  // directory stays. With it, that gives way.
  VehicleLog(const std::filesystem::path& directory, const Scenario& scenario);

  bool wants_causes() const override { return true; }
  void on_tick(const World& world) override;
  void on_imu(const ImuReading& reading) override;
  void on_state(const StateReading& reading) override;
  void on_range(const RangeReading& reading) override;
  void on_events(int camera, const Packet& packet) override;
  void finish();

 private:
  void open_cameras(const VehicleParameters& vehicle);
  void write_truth();

  std::filesystem::path directory_;
  NewDirectory made_;
  Scenario scenario_;
  std::vector<std::unique_ptr<EventWriter>> cameras_;
  std::vector<std::string> calibrations_;  // by camera
  OutputFile imu_, states_, ranges_, truth_;
  Snapshot now_;
  bool truth_begun_ = false;
};

}  // namespace dodgesim

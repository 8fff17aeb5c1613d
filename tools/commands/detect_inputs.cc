#include "tools/commands/detect_inputs.h"

#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <numbers>
#include <stdexcept>
#include <system_error>

#include "sim/base/error.h"
#include "sim/base/joined.h"
#include "sim/config/stereo_pair.h"
#include "sim/files/text_table.h"
#include "sim/playback/detection_files.h"
#include "sim/recordings/sensor_log.h"
#include "tools/commands/command.h"

namespace dodgesim {

namespace {

// Rectified, for stereo, if they are not. `files`: theirs.
std::vector<CameraCalibration> as_pair(const std::vector<CameraCalibration>& calibrations,
                                       const std::vector<std::string>& files) {
  const auto turn_deg = [](const CameraCalibration& rectified) {
    return Eigen::AngleAxisd(rectified.camera.lens->R_CL).angle() * 180 / std::numbers::pi;
  };
  const StereoPair pair = [&] {
    try {
      return rectified(calibrations[0], calibrations[1]);
    } catch (const ScenarioError& error) {
      throw ScenarioError(joined(files, {}, " and ") + ": " + error.what());
    }
  }();
  if (pair.upper.camera.lens) {
    std::printf(
        "The cameras are rectified by their calibrations: turned by %.2f and %.2f degrees.\n",
        turn_deg(pair.upper), turn_deg(pair.lower));
  }
  return {pair.upper, pair.lower};
}

// No gyroscope of a flight camera measures more than this.
void warn_of_degrees(const std::vector<ImuReading>& imu) {
  constexpr double kMostRadps = 40;
  double most_radps = 0;
  for (const ImuReading& r : imu) most_radps = std::max(most_radps, r.w_B_radps.norm());
  if (most_radps <= kMostRadps) return;
  std::printf("The IMU turns at up to %.0f rad/s: are its rates in degrees?\n", most_radps);
}

}  // namespace

void expect_inputs_stay(const DetectArguments& arguments) {
  std::vector<std::string> inputs = {arguments.imu, arguments.state, arguments.range,
                                     arguments.scenario};
  inputs.insert(inputs.end(), arguments.events.begin(), arguments.events.end());
  for (const std::string& file : arguments.calibrations) {
    inputs.push_back(file);
    inputs.push_back(file.substr(0, file.rfind(':')));  // without the name of a camera
  }
  for (const char* name : DetectionFiles::kNames) {
    refuse_to_overwrite(inputs, arguments.out + "/" + name, "--out " + arguments.out);
  }
  if (!arguments.video.empty()) {
    refuse_to_overwrite(inputs, arguments.video, "--video " + arguments.video);
  }
}

void check_files(const DetectArguments& arguments) {
  const std::vector<std::string>& events = arguments.events;
  std::error_code neither_exists;
  if (events.size() == 2 && std::filesystem::equivalent(events[0], events[1], neither_exists)) {
    throw ScenarioError(events[1] + ": is given for both cameras; each needs its own events.");
  }
  if (arguments.calibrations.size() != events.size()) {
    throw ScenarioError(
        "Given are " + count_text(static_cast<std::int64_t>(events.size()), "file") +
        " of events, but " +
        count_text(static_cast<std::int64_t>(arguments.calibrations.size()), "calibration") +
        "; each camera needs one.");
  }
}

std::vector<CameraCalibration> load_calibrations(const DetectArguments& arguments, bool stereo) {
  std::vector<CameraCalibration> calibrations;
  for (const std::string& file : arguments.calibrations) {
    calibrations.push_back(load_camera_calibration(file));
    const CameraCalibration& read = calibrations.back();
    if (read.passed_over.empty()) continue;
    std::printf("%s: %s is taken; FILE:%s would be another.\n", file.c_str(), read.name.c_str(),
                read.passed_over.front().c_str());
  }
  if (calibrations.size() == 2 && stereo) return as_pair(calibrations, arguments.calibrations);
  return calibrations;
}

dodge::Config pilot_config(const Scenario& scenario,
                           const std::vector<CameraCalibration>& calibrations,
                           const std::vector<std::string>& files) {
  dodge::Config config = scenario.dodger;
  for (const CameraCalibration& c : calibrations) config.cameras.push_back(c.camera);
  config.p_BR = calibrations.front().p_BR;
  if (calibrations.size() == 1 && config.position.stereo_depth()) {
    config.position.depth = "mono";
    std::printf("One camera: depth comes from a known size, %g m (dodger.position.known_size_m).\n",
                config.position.known_size_m);
  }
  try {
    dodge::validate(config);
  } catch (const std::invalid_argument& error) {
    const std::string what = error.what();
    const bool of_camera = what.starts_with("Camera ");
    throw ScenarioError((of_camera ? joined(files, {}, " and ") + ": " : "") + what);
  }
  return config;
}

RecordedSensors load_sensors(const DetectArguments& arguments,
                             const std::vector<CameraCalibration>& calibrations) {
  RecordedSensors sensors;
  sensors.files = arguments.events;
  for (std::size_t i = 0; i < arguments.events.size(); ++i) {
    const dodge::CameraModel& camera = calibrations[i].camera;
    sensors.cameras.push_back(open_events(arguments.events[i], {camera.width, camera.height}));
    if (sensors.cameras.back()->in_seconds()) {
      std::printf("%s: its times have fractions, and are taken for seconds.\n",
                  arguments.events[i].c_str());
    }
    if (calibrations[i].focal_length_assumed) {
      std::printf("%s has no intrinsics: 80 degrees over %d columns are assumed.\n",
                  arguments.calibrations[i].c_str(), camera.width);
    }
  }
  if (!arguments.state.empty()) sensors.states = read_state_log(arguments.state);
  if (!arguments.range.empty()) sensors.ranges = read_range_log(arguments.range);
  if (!arguments.imu.empty()) {
    sensors.imu = read_imu_log(arguments.imu);
    const TimeUs later_us = calibrations.front().imu_later_us;
    if (later_us != 0) {
      std::printf("The IMU's instants are moved by %+.3f ms (timeshift_cam_imu).\n",
                  -1e-3 * static_cast<double>(later_us));
    }
    for (ImuReading& reading : sensors.imu) {
      reading.t_us -= later_us;
      reading.w_B_radps = calibrations.front().R_BG * reading.w_B_radps;
      reading.f_B_mps2 = calibrations.front().R_BG * reading.f_B_mps2;
    }
    warn_of_degrees(sensors.imu);
    if (calibrations.front().imu_axes_assumed) {
      std::printf("The IMU's axes are taken for the camera's (%s).\n",
                  calibrations.front().name.empty() ? "imu_axes" : "there is no T_cam_imu");
    }
  } else {
    for (const StateReading& state : sensors.states) sensors.imu.push_back({state.t_us, state.w_B});
    std::printf("No --imu: %s.\n", sensors.states.empty() ? "the camera is taken not to turn"
                                                          : "the rates are those of --state");
  }
  return sensors;
}

}  // namespace dodgesim

// What `dodgesim detect` is given: recordings, calibrations and logs, read and held against one
// another.
#pragma once

#include <string>
#include <vector>

#include "dodge/config.h"
#include "sim/config/camera_calibration.h"
#include "sim/config/scenario.h"
#include "sim/playback/playback.h"

namespace dodgesim {

struct DetectArguments {
  std::vector<std::string> events;        // by camera
  std::vector<std::string> calibrations;  // by camera
  std::string imu, state, range;          // empty: not recorded
  std::string scenario;                   // empty: defaults
  std::vector<std::string> set;
  std::string plugin;
  std::string out;
  std::string video;  // empty: none
  double slow = 10;   // of the video
};

// All of these throw ScenarioError for inputs that cannot be used, and IoError.

// No result may overwrite an input.
void expect_inputs_stay(const DetectArguments& arguments);

// Each camera has events and a calibration of its own.
void check_files(const DetectArguments& arguments);

// These say on standard output what is missing and what is taken in its place.
// By camera; of two, for stereo, rectified.
std::vector<CameraCalibration> load_calibrations(const DetectArguments& arguments, bool stereo);

// `files`: those of the calibrations.
dodge::Config pilot_config(const Scenario& scenario,
                           const std::vector<CameraCalibration>& calibrations,
                           const std::vector<std::string>& files);

// With the IMU's axes turned into those of B.
RecordedSensors load_sensors(const DetectArguments& arguments,
                             const std::vector<CameraCalibration>& calibrations);

}  // namespace dodgesim

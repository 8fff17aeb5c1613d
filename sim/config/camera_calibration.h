// The calibration of a recorded event camera: a YAML file of its own.
//
//   width: 346                                   # [px], required, as is height
//   height: 260
//   intrinsics: {fx: 331.2, fy: 331.0, cx: 172.5, cy: 129.5}            # [px]
//   distortion: {model: radtan_k1_k2_p1_p2_k3, coeffs: [-0.37, 0.15, -3e-4, -8e-4, 0]}
//   p_BC_m: [0.1, 0, 0]                          # where the camera sits on the body
//   R_BC: [[0, 0, 1], [-1, 0, 0], [0, -1, 0]]    # rows; this is the default: it looks forward
//   imu_axes: forward left up                    # where x, y and z of the IMU point
//   p_BR_m: [0, 0, -0.05]                        # where the range sensor sits on the body
//
// Without intrinsics (or with ~ in their place) a field of view of 80 degrees is assumed. The axes
// of the IMU are named by directions of the body: forward, backward, left, right, up, down; by
// default they are the camera's. Of an IMU that is turned otherwise against the camera, take its
// axes for the body's (forward left up), and give R_BC in them. Other keys, such as those that say
// where a recording comes from, are passed over, unless they look like one of these misspelled.
//
// Calibrations of Kalibr and DSEC are read, too: see camera_chain.h. So are those of ROS
// (camera_info) and of OpenCV's programs (image_width, image_height, camera_matrix,
// distortion_model plumb_bob, distortion_coefficients), to which the keys from p_BC_m on may be
// added.
#pragma once

#include <string>
#include <vector>

#include "dodge/camera_model.h"
#include "sim/base/time.h"

namespace dodgesim {

struct CameraCalibration {
  dodge::CameraModel camera;
  Eigen::Matrix3d R_BG = Eigen::Matrix3d::Identity();  // from the axes of the IMU to those of B
  Eigen::Vector3d p_BR = Eigen::Vector3d::Zero();      // [m]
  bool focal_length_assumed = false;
  bool imu_axes_assumed = false;
  TimeUs imu_later_us = 0;               // what the IMU's clock shows more than the camera's
  std::string name;                      // of the camera, if the file holds several
  std::vector<std::string> passed_over;  // the others, if nobody chose this one
};

// The camera of a file or, if it holds several, the first one; "FILE.yaml:cam1" is the one of that
// name. Throws ScenarioError like load_scenario(), IoError when reading fails.
CameraCalibration load_camera_calibration(const std::string& path_and_camera);

// The file's text for a camera whose IMU has the axes of B; reads back the same to the last bit.
std::string to_yaml(const dodge::CameraModel& camera, const Eigen::Vector3d& p_BR);

}  // namespace dodgesim

// Calibrations of other programs: those of Kalibr (camchain.yaml, camchain-imucam.yaml) and of DSEC
// (cam_to_cam.yaml), which hold several cameras under names such as cam0.
//
//   cam0:                                        # in DSEC's below `intrinsics`
//     camera_model: pinhole
//     intrinsics: [fx, fy, cx, cy]               # in DSEC's: camera_matrix
//     distortion_model: radtan                   # or none
//     distortion_coeffs: [k1, k2, p1, p2]
//     resolution: [width, height]
//     T_cam_imu: [[...], [...], [...], [...]]    # from the axes of the IMU to those of the camera
//     T_cn_cnm1: [[...], [...], [...], [...]]    # from the axes of the camera before, in its place
//     timeshift_cam_imu: 0.003                   # [s], an instant by the IMU's clock less by the
//                                                # camera's
//
// The camera looks forward, and the body's origin is the IMU: what moves the body speaks of the
// camera's axes. OpenVINS's T_imu_cam, from the camera's axes to the IMU's, is as good as
// T_cam_imu. Where the chain begins with neither, the IMU is taken for its first camera. Other
// keys, such as rostopic, are passed over.
#pragma once

#include <string>
#include <vector>

#include "sim/config/camera_calibration.h"
#include "sim/config/reader.h"

namespace dodgesim {

// The names of the cameras, in the file's order; none if this is no file of that kind.
std::vector<std::string> cameras_of_chain(const YamlNode& root);

// Requires a name of the above. What is wrong is added to the context's problems.
CameraCalibration read_chain(const YamlNode& root, const std::string& name, ReadContext& context);

}  // namespace dodgesim

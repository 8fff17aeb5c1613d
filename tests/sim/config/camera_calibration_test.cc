#include "sim/config/camera_calibration.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <numbers>

#include "sim/base/error.h"
#include "tests/complaint.h"
#include "tests/sim/files/temporary_directory.h"

namespace dodgesim {
namespace {

using ::testing::AllOf;
using testing::complaint;
using ::testing::HasSubstr;
using testing::put;
using testing::TemporaryDirectory;

class Calibration : public ::testing::Test {
 protected:
  CameraCalibration load(const std::string& text) const {
    return load_camera_calibration(put(root_ / "camera.yaml", text));
  }
  std::string refusal(const std::string& text) const {
    return complaint<ScenarioError>([&] { load(text); });
  }

  TemporaryDirectory root_;
};

TEST_F(Calibration, ReadsBackToTheLastBit) {
  dodge::CameraModel camera{.width = 346,
                            .height = 260,
                            .fx = 331.1 / 3,
                            .fy = 330.9 / 7,
                            .cx = 172.123456789012345,
                            .cy = 130.1,
                            .k1 = -0.3684363,
                            .k2 = 0.15,
                            .p1 = -3e-4,
                            .p2 = -7e-4,
                            .k3 = 1e-9};
  camera.X_BC.rotate(Eigen::AngleAxisd(0.3, Eigen::Vector3d(1, 2, 3).normalized()));
  camera.X_BC.translation() = Eigen::Vector3d(0.1, -1.0 / 3, 0);
  const Eigen::Vector3d p_BR(0.01, 0, -1.0 / 7);
  const CameraCalibration read = load(to_yaml(camera, p_BR));
  EXPECT_EQ(read.camera.width, camera.width);
  EXPECT_EQ(read.camera.height, camera.height);
  EXPECT_EQ(read.camera.fx, camera.fx);
  EXPECT_EQ(read.camera.fy, camera.fy);
  EXPECT_EQ(read.camera.cx, camera.cx);
  EXPECT_EQ(read.camera.cy, camera.cy);
  EXPECT_EQ(read.camera.k1, camera.k1);
  EXPECT_EQ(read.camera.k2, camera.k2);
  EXPECT_EQ(read.camera.p1, camera.p1);
  EXPECT_EQ(read.camera.p2, camera.p2);
  EXPECT_EQ(read.camera.k3, camera.k3);
  EXPECT_EQ(read.camera.X_BC.matrix(), camera.X_BC.matrix());
  EXPECT_EQ(read.p_BR, p_BR);
  EXPECT_EQ(read.R_BG, Eigen::Matrix3d::Identity());
  EXPECT_FALSE(read.focal_length_assumed);
  EXPECT_FALSE(read.imu_axes_assumed);
}

TEST_F(Calibration, AssumesACameraThatLooksForwardWithTheImuInItsAxes) {
  const CameraCalibration read = load("{width: 321, height: 200, intrinsics: ~}");
  EXPECT_TRUE(read.focal_length_assumed);
  EXPECT_TRUE(read.imu_axes_assumed);
  // Half the width lies 40 degrees off the axis.
  EXPECT_NEAR(std::atan(160.5 / read.camera.fx) * 180 / std::numbers::pi, 40, 1e-9);
  EXPECT_EQ(read.camera.fy, read.camera.fx);
  EXPECT_EQ(read.camera.cx, 160);
  const Eigen::Matrix3d R_BC = read.camera.X_BC.linear();
  EXPECT_EQ(R_BC * Eigen::Vector3d::UnitZ(), Eigen::Vector3d(1, 0, 0));   // its axis: forward
  EXPECT_EQ(R_BC * Eigen::Vector3d::UnitX(), Eigen::Vector3d(0, -1, 0));  // its x: to the right
  EXPECT_EQ(read.R_BG, R_BC);
  // Wherever the camera looks.
  const CameraCalibration back =
      load("{width: 321, height: 200, R_BC: [[0, 0, -1], [1, 0, 0], [0, -1, 0]]}");
  EXPECT_EQ(back.R_BG, back.camera.X_BC.linear());
  EXPECT_NE(back.R_BG, R_BC);
}

TEST_F(Calibration, TurnsTheAxesOfTheImu) {
  const std::string camera = "width: 320\nheight: 240\nimu_axes: ";
  const Eigen::Matrix3d R_BG = load(camera + "up left backward\n").R_BG;
  EXPECT_EQ(R_BG * Eigen::Vector3d(1, 2, 3), Eigen::Vector3d(-3, 2, 1));
  for (const char* wrong :
       {"left up backward", "up up left", "up left", "up left sideways", "up left backward down"}) {
    EXPECT_THAT(refusal(camera + wrong), AllOf(HasSubstr("camera.yaml:3:"), HasSubstr(wrong)));
  }
}

TEST_F(Calibration, PassesOverWhatIsForPeopleButNotMisspelledKeys) {
  EXPECT_EQ(load("width: 320\nheight: 240\nsensor: DVXplorer\nlicence: MIT\n").camera.width, 320);
  EXPECT_THAT(refusal("width: 320\nheigth: 240\n"), HasSubstr("did you mean height?"));
  EXPECT_THAT(refusal("resolution: [320, 240]\ndistortion_coeffs: [0.1, 0, 0, 0]\n"),
              HasSubstr("camera.yaml:2:1: distortion_coeffs is a key of Kalibr's"));
  EXPECT_THAT(refusal("width: 320\nheight: 240\nintrinsic: {fx: 1, fy: 1, cx: 1, cy: 1}\n"),
              HasSubstr("camera.yaml:3:1: intrinsic is not a known key; did you mean intrinsics?"));
}

TEST_F(Calibration, SaysWhereKeysOfOtherFormsBelong) {
  const std::string size = "width: 320\nheight: 240\n";
  for (const char* key : {"camera_matrix", "cameraMatrix", "K", "fx", "cy"}) {
    EXPECT_EQ(refusal(size + key + ": 1\n"),
              (root_ / "camera.yaml").string() + ":3:1: " + key +
                  " has no effect here: beside width and height it belongs in intrinsics: {fx: "
                  "..., fy: ..., cx: ..., cy: ...}.");
  }
  const std::string of_ros =
      "image_width: 320\nimage_height: 240\n"
      "camera_matrix: {data: [100, 0, 160, 0, 100, 120, 0, 0, 1]}\n";
  for (const char* key : {"K", "D", "dist_coeffs", "Distortion_Coefficients"}) {
    EXPECT_THAT(refusal(of_ros + key + ": 1\n"),
                HasSubstr(std::string(":4:1: ") + key + " has no effect here: beside image_width"));
  }
  for (const char* key : {"distortion_coefficients", "distortion_coeffs", "dist_coeffs", "D", "k1",
                          "p2", "distortion_model"}) {
    EXPECT_EQ(refusal(size + key + ": 1\n"),
              (root_ / "camera.yaml").string() + ":3:1: " + key +
                  " has no effect here: beside width and height it belongs in distortion: {model: "
                  "radtan, coeffs: [k1, k2, p1, p2, k3]}.");
  }
}

TEST_F(Calibration, IsOfOneForm) {
  const std::string ros =
      "image_width: 64\nimage_height: 48\n"
      "camera_matrix: {rows: 3, cols: 3, data: [100, 0, 32, 0, 100, 24, 0, 0, 1]}\n";
  EXPECT_EQ(load(ros + "p_BC_m: [0, 0, 1]\nwidth: ~\n").camera.fx, 100);
  for (const std::string key : {"width: 64", "intrinsics: {fx: 50, fy: 50, cx: 32, cy: 24}",
                                "distortion: {coeffs: [0, 0, 0, 0]}"}) {
    EXPECT_EQ(refusal(ros + key + "\n"),
              (root_ / "camera.yaml").string() + ":4:1: " + key.substr(0, key.find(':')) +
                  " and image_width (ROS's, OpenCV's) are keys of two forms of a calibration: take "
                  "away what belongs to one of them.");
  }
  EXPECT_THAT(refusal("image_height: 48\n"), HasSubstr("image_width is missing"));
}

TEST_F(Calibration, OfRosIsRead) {
  const std::string text =
      "image_width: 346\nimage_height: 260\ncamera_name: davis\ncamera_matrix:\n  rows: 3\n"
      "  cols: 3\n  data: [250.1, 0., 160.2, 0, 251, 120.7, 0, 0, 1]\n"
      "distortion_model: plumb_bob\ndistortion_coefficients:\n  rows: 1\n  cols: 5\n"
      "  data: [-0.37, 0.15, 0.01, 0.02, -0.03]\nrectification_matrix: {rows: 3}\n"
      "imu_axes: forward left up\n";
  const CameraCalibration read = load(text);
  EXPECT_EQ(read.camera.width, 346);
  EXPECT_EQ(read.camera.height, 260);
  EXPECT_EQ(read.camera.fx, 250.1);
  EXPECT_EQ(read.camera.fy, 251);
  EXPECT_EQ(read.camera.cx, 160.2);
  EXPECT_EQ(read.camera.cy, 120.7);
  EXPECT_EQ(read.camera.k2, 0.15);
  EXPECT_EQ(read.camera.p2, 0.02);
  EXPECT_EQ(read.camera.k3, -0.03);
  EXPECT_FALSE(read.focal_length_assumed);
  EXPECT_EQ(read.R_BG, Eigen::Matrix3d::Identity());
  const auto refused = [&](const std::string& before, const std::string& after) {
    std::string wrong = text;
    return refusal(wrong.replace(wrong.find(before), before.size(), after));
  };
  EXPECT_THAT(refused("plumb_bob", "equidistant"),
              HasSubstr("distortion_model is \"equidistant\", but must be plumb_bob"));
  EXPECT_THAT(refused("image_height", "height"), HasSubstr("image_height is missing"));
  EXPECT_THAT(refused("250.1, ", ""), HasSubstr("camera_matrix.data must be the nine numbers"));
  EXPECT_THAT(refused("0., 160.2, 0, 251, 120.7, 0, 0, 1", "0, 0, 0, 251, 0, 160.2, 120.7, 1"),
              HasSubstr("camera_matrix.data must be the nine numbers"));
  EXPECT_THAT(refused("0., 160.2", "5, 160.2"), HasSubstr("must be the nine numbers"));
  EXPECT_THAT(refused(", -0.03]", ", 0, 0, 0, 0]"),
              HasSubstr("distortion_coefficients.data must be the four or five numbers"));
}

TEST_F(Calibration, OfOpenCvIsRead) {
  const std::string text =
      "%YAML:1.0\n---\ncalibration_time: \"Fri Mar 13 10:00:00 2020\"\nimage_width: 346\n"
      "image_height: 260\naspectRatio: 1.\n# flags: +fix_aspectRatio\nflags: 2\n"
      "camera_matrix: !!opencv-matrix\n   rows: 3\n   cols: 3\n   dt: d\n"
      "   data: [ 2.501e+02, 0., 1.602e+02, 0., 251.,\n       120.7, 0., 0., 1. ]\n"
      "distortion_coefficients: !!opencv-matrix\n   rows: 5\n   cols: 1\n   dt: d\n"
      "   data: [ -0.37, 0.15, 0.01, 0.02, -3.0e-02 ]\navg_reprojection_error: 2.1e-01\n";
  const CameraCalibration read = load(text);
  EXPECT_EQ(read.camera.width, 346);
  EXPECT_EQ(read.camera.fx, 250.1);
  EXPECT_EQ(read.camera.fy, 251);
  EXPECT_EQ(read.camera.cy, 120.7);
  EXPECT_EQ(read.camera.k1, -0.37);
  EXPECT_EQ(read.camera.k3, -0.03);
  // With the corners that it has seen, and of another lens.
  std::string corners = "image_points: !!opencv-matrix\n   rows: 10\n   data: [0";
  for (int i = 0; i < 10000; ++i) corners += ", 1.5";
  EXPECT_EQ(load(text + "fisheye_model: 0\n" + corners + "]\n").camera.k1, -0.37);
  EXPECT_THAT(refusal(text + "fisheye_model: 1\n"), HasSubstr("fisheye_model is 1, a lens that"));
  EXPECT_THAT(refusal(text + "imu_axis: forward left up\n"),
              HasSubstr("imu_axis is not a known key; did you mean imu_axes?"));
}

TEST_F(Calibration, SaysWhatIsMissingOrWrong) {
  EXPECT_THAT(refusal("width: 320\n"), HasSubstr("height is missing"));
  EXPECT_THAT(refusal("width: 0\nheight: 240\n"), HasSubstr("width is 0"));
  const std::string size = "width: 320\nheight: 240\n";
  EXPECT_THAT(refusal(size + "intrinsics: {fx: 190, cx: 1, cy: 1}\n"),
              HasSubstr("intrinsics.fy is missing"));
  EXPECT_THAT(refusal(size + "distortion: {model: fisheye, coeffs: [0, 0, 0, 0]}\n"),
              HasSubstr("distortion.model is \"fisheye\""));
  EXPECT_THAT(refusal(size + "distortion: {coeffs: [0, 0, 0]}\n"), HasSubstr("four or five"));
  EXPECT_THAT(refusal(size + "R_BC: [[1, 0, 0], [0, 1, 0], [0, 0, -1]]\n"),
              AllOf(HasSubstr("camera.yaml:3:"), HasSubstr("must be a rotation")));
  EXPECT_THAT(refusal(size + "R_BC: [[1, 0, 0], [0, 1, 0]]\n"), HasSubstr("must be a rotation"));
}

}  // namespace
}  // namespace dodgesim

#include "sim/config/camera_chain.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "sim/base/error.h"
#include "tests/complaint.h"
#include "tests/sim/files/temporary_directory.h"

namespace dodgesim {
namespace {

using testing::complaint;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using testing::put;
using testing::TemporaryDirectory;

// As Kalibr writes them.
constexpr const char* kChain = R"(cam0:
  T_cam_imu:
  - [0.0, -1.0, 0.0, 0.01]
  - [0.0, 0.0, -1.0, -0.02]
  - [1.0, 0.0, 0.0, 0.03]
  - [0.0, 0.0, 0.0, 1.0]
  cam_overlaps: [1]
  camera_model: pinhole
  distortion_coeffs: [-0.37, 0.15, -3.0e-04, -0.0008]
  distortion_model: radtan
  intrinsics: [199.1, 198.8, 132.2, 110.7]
  resolution: [240, 180]
  rostopic: /dvs/image_raw
  timeshift_cam_imu: 0.0025
cam1:
  cam_overlaps: [0]
  camera_model: pinhole
  distortion_coeffs: []
  distortion_model: none
  intrinsics: [330.1, 330.2, 170.0, 130.0]
  resolution: [346, 260]
  rostopic: /davis/image_raw
)";

class CameraChain : public ::testing::Test {
 protected:
  CameraCalibration load(const std::string& text, const std::string& camera = "") const {
    return load_camera_calibration(put(root_ / "chain.yaml", text) + camera);
  }
  // Of the chain with `before` replaced.
  std::string refusal(const std::string& before, const std::string& after) const {
    std::string text = kChain;
    text.replace(text.find(before), before.size(), after);
    return complaint<ScenarioError>([&] { load(text); });
  }

  TemporaryDirectory root_;
};

TEST_F(CameraChain, OfKalibrIsRead) {
  const CameraCalibration read = load(kChain);
  EXPECT_EQ(read.name, "cam0");
  EXPECT_THAT(read.passed_over, ElementsAre("cam1"));
  const dodge::CameraModel& camera = read.camera;
  EXPECT_EQ(camera.width, 240);
  EXPECT_EQ(camera.height, 180);
  EXPECT_EQ(camera.fx, 199.1);
  EXPECT_EQ(camera.fy, 198.8);
  EXPECT_EQ(camera.cx, 132.2);
  EXPECT_EQ(camera.cy, 110.7);
  EXPECT_EQ(camera.k1, -0.37);
  EXPECT_EQ(camera.k2, 0.15);
  EXPECT_EQ(camera.p1, -3e-4);
  EXPECT_EQ(camera.p2, -8e-4);
  EXPECT_EQ(camera.k3, 0);
  EXPECT_EQ(read.imu_later_us, 2500);
  EXPECT_FALSE(read.imu_axes_assumed);
  // The IMU has the axes of the body: x along the camera's z, y against its x.
  EXPECT_EQ(read.R_BG, Eigen::Matrix3d::Identity());
  EXPECT_EQ(camera.X_BC * Eigen::Vector3d(0.01, -0.02, 0.03), Eigen::Vector3d::Zero());
}

TEST_F(CameraChain, HasCamerasToChooseFrom) {
  const CameraCalibration read = load(kChain, ":cam1");
  EXPECT_EQ(read.name, "cam1");
  EXPECT_THAT(read.passed_over, IsEmpty());
  EXPECT_EQ(read.camera.width, 346);
  EXPECT_EQ(read.camera.k1, 0);
  EXPECT_EQ(read.imu_later_us, 0);
  EXPECT_TRUE(read.imu_axes_assumed);
  EXPECT_EQ(read.R_BG, read.camera.X_BC.linear());
  EXPECT_THAT(complaint<ScenarioError>([&] { load(kChain, ":cam2"); }),
              HasSubstr("chain.yaml: There is no camera cam2, but cam0 and cam1."));
  EXPECT_THAT(complaint<ScenarioError>([&] { load("width: 240\nheight: 180\n", ":cam0"); }),
              HasSubstr("holds one camera"));
}

TEST_F(CameraChain, MayHaveSuchANameItself) {
  const std::string path = put(root_ / "a:cam1.yaml", kChain);
  EXPECT_EQ(load_camera_calibration(path).name, "cam0");
  EXPECT_EQ(load_camera_calibration(path + ":cam1").name, "cam1");
}

TEST_F(CameraChain, OfDsecIsRead) {
  const std::string text =
      "intrinsics:\n  cam0:\n    camera_matrix: [553.4, 553.3, 346.6, 216.5]\n"
      "    camera_model: pinhole\n    distortion_coeffs: [-0.09, 0.19, 1e-4, -2e-4]\n"
      "    distortion_model: radtan\n    resolution: [640, 480]\n"
      "  camRect0:\n    camera_matrix: [569.7, 569.7, 335.0, 221.2]\n"
      "    resolution: [640, 480]\n    camera_model: pinhole\nextrinsics:\n  T_10: []\n";
  EXPECT_EQ(load(text).camera.fx, 553.4);
  EXPECT_EQ(load(text).camera.k2, 0.19);
  EXPECT_EQ(load(text, ":camRect0").camera.fx, 569.7);
  EXPECT_EQ(load(text, ":camRect0").camera.k1, 0);
}

TEST_F(CameraChain, SaysWhatIsMissingOrWrong) {
  EXPECT_THAT(refusal("distortion_model: radtan", "distortion_model: equidistant"),
              HasSubstr("chain.yaml:10:21: cam0.distortion_model is equidistant, a fisheye's"));
  EXPECT_THAT(refusal("pinhole", "omni"),
              HasSubstr("cam0.camera_model is \"omni\", but must be pinhole"));
  EXPECT_THAT(refusal("  resolution: [240, 180]\n", ""), HasSubstr("cam0.resolution must be"));
  EXPECT_THAT(refusal("[240, 180]", "[240.5, 180]"), HasSubstr("whole numbers"));
  EXPECT_THAT(refusal("[199.1, 198.8, 132.2, 110.7]", "[199.1, 132.2, 110.7]"),
              HasSubstr("cam0.intrinsics must be the 4 numbers"));
  EXPECT_THAT(refusal("199.1", "-199.1"), HasSubstr("at least 1"));
  EXPECT_THAT(refusal("-0.37, ", ""), HasSubstr("cam0.distortion_coeffs must be the 4 numbers"));
  EXPECT_THAT(refusal("[0.0, -1.0, 0.0, 0.01]", "[0.0, 1.0, 0.0, 0.01]"),
              HasSubstr("cam0.T_cam_imu must be four rows"));
  EXPECT_THAT(refusal("[0.0, -1.0, 0.0, 0.01]", "[0.0, -1.0, x]"), HasSubstr("T_cam_imu must be"));
  EXPECT_THAT(refusal("  rostopic", "  imu_axes: forward left up\n  rostopic"),
              HasSubstr("imu_axes has no effect in a chain"));
  EXPECT_THAT(
      complaint<ScenarioError>([&] { load(std::string("imu_axes: forward left up\n") + kChain); }),
      HasSubstr("chain.yaml:1:1: imu_axes has no effect in a chain"));
}

}  // namespace
}  // namespace dodgesim

// Random pairs of cameras, and points that are projected into them by a lens of the test's own.
#include "sim/config/stereo_pair.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "sim/base/error.h"
#include "sim/base/formatted.h"
#include "sim/base/random.h"
#include "sim/base/rotation.h"
#include "sim/camera/looking_forward.h"
#include "tests/complaint.h"
#include "tests/sim/files/temporary_directory.h"

namespace dodgesim {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;
using testing::complaint;
using ::testing::HasSubstr;

Vector3d any_vector(RandomStream& random, double most) {
  return {random.uniform(-most, most), random.uniform(-most, most), random.uniform(-most, most)};
}

// Looks forward, but for a turn.
CameraCalibration camera_at(const Vector3d& p_B, const Vector3d& turn_rad) {
  CameraCalibration calibration;
  calibration.camera.X_BC.linear() = looking_forward() * rotation(turn_rad).toRotationMatrix();
  calibration.camera.X_BC.translation() = p_B;
  return calibration;
}

// The lens of a camera before it was rectified.
Vector2d pixel_of(const dodge::CameraModel& camera, const Vector3d& p_B) {
  const Vector3d p = camera.X_BC.inverse() * p_B;
  const double x = p.x() / p.z(), y = p.y() / p.z(), r2 = x * x + y * y;
  const double radial = 1 + camera.k1 * r2 + camera.k2 * r2 * r2;
  return {
      camera.fx * (x * radial + 2 * camera.p1 * x * y + camera.p2 * (r2 + 2 * x * x)) + camera.cx,
      camera.fy * (y * radial + camera.p1 * (r2 + 2 * y * y) + 2 * camera.p2 * x * y) + camera.cy};
}

TEST(StereoPair, OfRandomCamerasSeesPointsInOneColumnAndAtTheirDepth) {
  RandomStream random(1, 0, "pairs");
  for (int trial = 0; trial < 200; ++trial) {
    CameraCalibration upper = camera_at(any_vector(random, 0.2), any_vector(random, 0.05));
    CameraCalibration lower =
        camera_at(upper.camera.X_BC * (Vector3d(0, 0.15, 0) + any_vector(random, 0.03)),
                  any_vector(random, 0.05));
    for (dodge::CameraModel* camera : {&upper.camera, &lower.camera}) {
      camera->fx = random.uniform(180, 210);
      camera->fy = random.uniform(180, 210);
      camera->cx += random.uniform(-10, 10);
      camera->cy += random.uniform(-10, 10);
      camera->k1 = random.uniform(-0.1, 0);
      camera->p1 = random.uniform(-1e-3, 1e-3);
      camera->p2 = random.uniform(-1e-3, 1e-3);
    }
    const StereoPair pair = rectified(upper, lower);
    const dodge::CameraModel &u = pair.upper.camera, &l = pair.lower.camera;
    EXPECT_EQ(u.X_BC.translation(), upper.camera.X_BC.translation());
    EXPECT_TRUE(u.lens && l.lens);
    const double baseline_m = (u.X_BC.inverse() * l.X_BC.translation()).y();
    for (int i = 0; i < 20; ++i) {
      const double z = random.uniform(0.5, 5);
      const Vector3d p_C(z * random.uniform(-0.5, 0.5), z * random.uniform(-0.3, 0.3), z);
      const Vector3d p_B = u.X_BC * p_C;
      const Vector2d seen_u = u.bearing(pixel_of(upper.camera, p_B));
      const Vector2d seen_l = l.bearing(pixel_of(lower.camera, p_B));
      EXPECT_NEAR((seen_u - p_C.hnormalized()).norm(), 0, 1e-7);
      EXPECT_NEAR(seen_u.x(), seen_l.x(), 1e-7);
      EXPECT_NEAR(seen_u.y() - seen_l.y(), baseline_m / z, 1e-7);
    }
    // As the core wants it.
    EXPECT_EQ(u.fx, l.fx);
    EXPECT_EQ(u.cx, l.cx);
    EXPECT_EQ(u.cy, l.cy);
    EXPECT_TRUE(u.X_BC.linear() == l.X_BC.linear());
  }
}

TEST(StereoPair, ThatIsRectifiedStaysAsItIs) {
  const CameraCalibration upper = camera_at({0.1, 0, 0.07}, Vector3d::Zero());
  const CameraCalibration lower = camera_at({0.1, 0, -0.08}, Vector3d::Zero());
  const StereoPair pair = rectified(upper, lower);
  EXPECT_FALSE(pair.upper.camera.lens || pair.lower.camera.lens);
  EXPECT_TRUE(pair.upper.camera.X_BC.matrix() == upper.camera.X_BC.matrix());
  EXPECT_TRUE(pair.lower.camera.X_BC.matrix() == lower.camera.X_BC.matrix());
}

TEST(StereoPair, LiesOneBelowTheOther) {
  const CameraCalibration upper = camera_at({0, 0, 0.1}, Vector3d::Zero());
  const auto refusal = [&](const Vector3d& p_B) {
    return complaint<ScenarioError>([&] { rectified(upper, camera_at(p_B, {0.01, 0, 0})); });
  };
  EXPECT_THAT(refusal({0, -0.15, 0.1}), HasSubstr("degrees aside."));
  EXPECT_THAT(refusal({0, 0, 0.25}), HasSubstr("above the first: give the upper camera first."));
  EXPECT_THAT(refusal({0, 0, 0.1}), HasSubstr("give both the same place (p_BC_m; "));
  EXPECT_THAT(complaint<ScenarioError>([&] { rectified(upper, upper); }),
              HasSubstr("give both the same place (p_BC_m; "));
  EXPECT_EQ(refusal({0, -0.05, 0}), "");
}

// The same rig, told by where each camera is to the IMU, and by where one is to the other.
TEST(StereoPair, OfAChainIsOneRig) {
  const auto rows = [](const Eigen::Isometry3d& X) {
    std::string text;
    for (int i = 0; i < 4; ++i) {
      text += "  - [";
      for (int j = 0; j < 4; ++j) {
        text += formatted("%.17g", X.matrix()(i, j)) + (j < 3 ? ", " : "]\n");
      }
    }
    return text;
  };
  const auto lens =
      "  camera_model: pinhole\n  distortion_model: none\n  intrinsics: [190, 190, 160, 120]\n"
      "  resolution: [320, 240]\n";
  Eigen::Isometry3d X_UG(rotation(Vector3d(0.3, -0.2, 1)));
  X_UG.translation() = Vector3d(0.01, 0.04, -0.02);
  Eigen::Isometry3d X_LU(rotation(Vector3d(0.02, 0.03, -0.01)));
  X_LU.translation() = Vector3d(0.003, -0.15, 0.004);
  const testing::TemporaryDirectory root;
  const auto pair = [&](const std::string& upper, const std::string& lower) {
    const std::string file = testing::put(
        root / "chain.yaml", std::string("cam0:\n") + lens + upper + "cam1:\n" + lens + lower);
    return rectified(load_camera_calibration(file + ":cam0"),
                     load_camera_calibration(file + ":cam1"));
  };
  const std::string to_upper = "  T_cam_imu:\n" + rows(X_UG);
  const StereoPair a = pair(to_upper, "  T_cam_imu:\n" + rows(X_LU * X_UG));
  const StereoPair b = pair(to_upper, "  T_cn_cnm1:\n" + rows(X_LU));
  const StereoPair c = pair("  T_imu_cam:\n" + rows(X_UG.inverse()), "  T_cn_cnm1:\n" + rows(X_LU));
  for (const StereoPair& other : {b, c}) {
    EXPECT_TRUE(a.lower.camera.X_BC.isApprox(other.lower.camera.X_BC, 1e-12));
    EXPECT_TRUE(a.lower.camera.lens->R_CL.isApprox(other.lower.camera.lens->R_CL, 1e-12));
    EXPECT_TRUE(a.upper.R_BG.isApprox(other.upper.R_BG, 1e-12));
  }
  EXPECT_NEAR((a.upper.camera.X_BC.inverse() * a.lower.camera.X_BC.translation()).y(),
              X_LU.translation().norm(), 1e-12);
  // The lower camera's frame, before it was turned, is where the chain says.
  const Eigen::Matrix3d R_UL =
      (looking_forward().transpose() * a.lower.camera.X_BC.linear()) * a.lower.camera.lens->R_CL;
  EXPECT_TRUE(R_UL.isApprox(X_LU.linear().transpose(), 1e-9));
  // Without an IMU the upper camera is the origin.
  const StereoPair d = pair("", "  T_cn_cnm1:\n" + rows(X_LU));
  EXPECT_TRUE(d.upper.imu_axes_assumed);
  EXPECT_TRUE(d.upper.camera.X_BC.translation().isZero());
}

}  // namespace
}  // namespace dodgesim

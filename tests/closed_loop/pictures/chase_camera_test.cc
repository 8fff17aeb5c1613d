#include "sim/observers/chase_camera.h"

#include <gtest/gtest.h>

namespace dodgesim {
namespace {

BodyState at(double x, double y, double z, double heading_rad = 0) {
  BodyState vehicle;
  vehicle.p_W = {x, y, z};
  vehicle.q_W = Eigen::AngleAxisd(heading_rad, Eigen::Vector3d::UnitZ());
  return vehicle;
}

TEST(ChaseCamera, LooksAheadOfTheVehicleFromBehindAndBeside) {
  for (const double heading_rad : {0.0, 0.7, -2.0}) {
    ChaseCamera camera(4);
    const PictureView view = camera.follow(at(1, 2, 3, heading_rad));
    const Eigen::Vector3d ahead = view.look_at_W - Eigen::Vector3d(1, 2, 3);
    EXPECT_NEAR(std::atan2(ahead.y(), ahead.x()), heading_rad, 1e-9);
    EXPECT_NEAR(ahead.z(), 0, 1e-9);
    const double sight_rad = view.azimuth_deg * M_PI / 180;
    EXPECT_GT(std::cos(sight_rad - heading_rad), 0.3);
    EXPECT_LT(std::cos(sight_rad - heading_rad), 0.7);
    EXPECT_LT(view.elevation_deg, 0);
    EXPECT_EQ(view.distance_m, 4);
  }
}

TEST(ChaseCamera, StandsStillWhileTheVehicleDodges) {
  ChaseCamera camera(4);
  const Eigen::Vector3d start = camera.follow(at(0, 0, 2)).look_at_W;
  EXPECT_EQ(camera.follow(at(0, 0.5, 2.5)).look_at_W, start);
  EXPECT_EQ(camera.follow(at(-0.3, -0.5, 1.5, 1.0)).look_at_W, start);
}

TEST(ChaseCamera, GoesAlongWithAVehicleThatFliesAway) {
  ChaseCamera camera(4);
  const Eigen::Vector3d start = camera.follow(at(0, 0, 2)).look_at_W;
  for (double x = 0; x <= 20; x += 0.01) camera.follow(at(x, 0, 2));
  const Eigen::Vector3d moved = camera.follow(at(20, 0, 2)).look_at_W - start;
  EXPECT_NEAR((moved - Eigen::Vector3d(20 - ChaseCamera::kLeashM, 0, 0)).norm(), 0, 1e-9);
}

}  // namespace
}  // namespace dodgesim

#include "sim/flight/detection_log.h"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <array>

#include "tests/sim/world/test_world.h"

namespace dodgesim {
namespace {

using Eigen::Vector3d;

constexpr TimeUs kOutputDelayUs = 3500;
const Vector3d kSmallBall(5, 0, 9), kLargeBall(5, 3, 9);

// Two balls, of 0.1 m and 0.3 m of radius. The test says which are in flight.
class DetectionLoggerTest : public ::testing::Test {
 protected:
  DetectionLoggerTest()
      : world_(test_spec({{"ball", 0.2}, {"ball", 0.6}})), logger_(world_, kOutputDelayUs) {
    world_.reset(kStart, 0, Vector3d::Zero());
  }

  void launch(int object) {
    world_.launch(object, thrown(object == 0 ? kSmallBall : kLargeBall, Vector3d::Zero()));
  }

  // The pilot finds something here, of the instant at which the balls are launched.
  bool find(const Vector3d& centre_W, const Vector3d& drift_W = Vector3d::Zero()) {
    logger_.observe(world_.snapshot());
    dodge::Detection detection;
    detection.centre_W = centre_W;
    return logger_.find(0, std::array{detection}, drift_W);
  }

  DetectionRow row_of(const Vector3d& centre_W, const Vector3d& drift_W = Vector3d::Zero()) {
    find(centre_W, drift_W);
    logger_.log_outputs(kOutputDelayUs, [](const DetectionRow&, bool) {});
    return logger_.log().rows.back();
  }

  // The cameras look along x.
  double camera_x_m() const { return kStart.x() + world_.vehicle().X_BC[0].translation().x(); }

  World world_;
  DetectionLogger logger_;
};

TEST_F(DetectionLoggerTest, ADetectionIsOfAnObjectNotFarFromIt) {
  launch(0);
  launch(1);
  struct Case {
    Vector3d ball_W;
    double distance_m;
    bool true_object;
  };
  for (const Case& c : {Case{kSmallBall, 0.499, true}, Case{kSmallBall, 0.501, false},
                        Case{kLargeBall, 0.649, true}, Case{kLargeBall, 0.651, false}}) {
    find(c.ball_W + c.distance_m * Vector3d(0.6, 0, -0.8));
    int logged = 0;
    logger_.log_outputs(kOutputDelayUs, [&](const DetectionRow& row, bool true_object) {
      ++logged;
      EXPECT_EQ(true_object, c.true_object) << c.distance_m;
      EXPECT_EQ(row.object, c.ball_W == kLargeBall ? 1 : 0);
      EXPECT_NEAR(row.position_error_m.value(), c.distance_m, 1e-12);
    });
    EXPECT_EQ(logged, 1);
  }
}

TEST_F(DetectionLoggerTest, BesideItIsTheNearestObject) {
  launch(0);
  launch(1);
  for (const double y_m : {1.4, 1.6}) {
    const DetectionRow row = row_of({5, y_m, 9});
    const Vector3d ball_W = y_m < 1.5 ? kSmallBall : kLargeBall;
    EXPECT_EQ(row.object, y_m < 1.5 ? 0 : 1);
    EXPECT_NEAR(row.position_error_m.value(), 1.4, 1e-12);
    EXPECT_EQ(Vector3d(row.true_p_W.value().data()), ball_W);
    EXPECT_NEAR(row.true_depth_m.value(), 5 - camera_x_m(), 1e-9);
  }
}

TEST_F(DetectionLoggerTest, BesideItIsNoObjectThatHasNotBeenLaunched) {
  const Vector3d waiting_W = world_.snapshot().objects[0].p_W;
  launch(1);
  EXPECT_EQ(row_of(waiting_W).object, 1);
  EXPECT_FALSE(logger_.log().first);
}

TEST_F(DetectionLoggerTest, BesideItIsNothingBeforeTheFirstLaunch) {
  const DetectionRow row = row_of(world_.snapshot().objects[0].p_W);
  EXPECT_FALSE(row.object || row.true_p_W || row.position_error_m || row.true_depth_m);
}

TEST_F(DetectionLoggerTest, TheFirstOfAnObjectCountsFromItsOutputOn) {
  launch(0);
  EXPECT_FALSE(find({5, 1, 9}));  // of nothing
  EXPECT_TRUE(find(kSmallBall + Vector3d(0, 0.1, 0)));
  EXPECT_FALSE(find(kSmallBall));  // not the first
  const auto ignore = [](const DetectionRow&, bool) {};
  logger_.log_outputs(kOutputDelayUs - 1, ignore);
  EXPECT_TRUE(logger_.log().rows.empty());
  EXPECT_FALSE(logger_.log().first);
  logger_.log_outputs(kOutputDelayUs, ignore);
  EXPECT_EQ(logger_.log().rows.size(), 3u);
  ASSERT_TRUE(logger_.log().first);
  EXPECT_EQ(logger_.log().first->output_us, kOutputDelayUs);
  EXPECT_EQ(logger_.log().first->t_us, 0);
  const Vector3d camera_W = kStart + world_.vehicle().X_BC[0].translation();
  EXPECT_NEAR(logger_.log().first->distance_m, (kSmallBall - camera_W).norm(), 1e-9);
  EXPECT_TRUE(logger_.log().first_of_object.at(0));
  EXPECT_FALSE(logger_.log().first_of_object.at(1));
}

TEST_F(DetectionLoggerTest, TheTruthIsPutIntoTheDriftedFrameOfTheEstimates) {
  launch(0);
  const Vector3d drift_W(1, 0, 2);
  EXPECT_FALSE(find(kSmallBall, drift_W));
  EXPECT_TRUE(find(kSmallBall + drift_W, drift_W));
  const DetectionRow row = row_of(kSmallBall + drift_W, drift_W);
  EXPECT_NEAR(row.position_error_m.value(), 0, 1e-12);
  EXPECT_EQ(Vector3d(row.true_p_W.value().data()), kSmallBall + drift_W);
  // From the camera, wherever that thinks it is.
  EXPECT_NEAR(row.true_depth_m.value(), 5 - camera_x_m(), 1e-9);
}

}  // namespace
}  // namespace dodgesim

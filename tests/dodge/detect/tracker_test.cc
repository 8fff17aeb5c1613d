#include "dodge/detect/tracker.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <stdexcept>
#include <vector>

#include "tests/dodge/generator.h"

namespace dodge {
namespace {

using Eigen::Vector3d;

constexpr double kLifetimeS = 0.8;

// A ball of the given size seen from the origin.
Detection seen(TimeUs t_us, const Vector3d& centre, double size_m = 0.2) {
  Detection detection;
  detection.t_us = t_us;
  detection.centre_W = centre;
  detection.depth_m = centre.x();
  detection.depth_sigma_m = 0.03;
  detection.size_m = size_m;
  const Vector3d y = 0.5 * size_m * Vector3d::UnitY(), z = 0.5 * size_m * Vector3d::UnitZ();
  const Vector3d sight = size_m * centre.normalized();
  detection.p_W = {centre + y + z, centre - y + z, centre - y - z,
                   centre + y - z, centre - sight, centre + sight};
  return detection;
}

void update(Tracker& tracker, TimeUs now, std::vector<Detection> detections) {
  tracker.update(now, detections);
}

TEST(Tracker, FollowsTwoBallsThatCross) {
  Generator random(1);
  Tracker tracker({}, {}, kLifetimeS);
  // At 0.2 s they are 0.2 m apart, well within the gate of each other.
  const std::array<Vector3d, 2> p = {Vector3d(3, 0.3, 0), Vector3d(3, -0.3, 0.2)};
  const std::array<Vector3d, 2> v = {Vector3d(-6, -1.5, 0), Vector3d(-6, 1.5, 0)};
  std::array<int, 2> ids = {-1, -1};
  for (TimeUs t_us = 0; t_us <= 400000; t_us += 4000) {
    const double t = seconds(t_us);
    std::array<Detection, 2> detections;
    // The order in which they are found changes.
    const std::size_t first = random.bits() % 2;
    for (std::size_t i = 0; i < 2; ++i) {
      const std::size_t ball = i == 0 ? first : 1 - first;
      detections[i] = seen(t_us, p[ball] + v[ball] * t + 0.02 * random.normal_vector());
    }
    tracker.update(t_us + 3500, detections);
    ASSERT_EQ(tracker.obstacles().size(), 2);
    const std::array<int, 2> found = {detections[first == 0 ? 0 : 1].obstacle_id,
                                      detections[first == 0 ? 1 : 0].obstacle_id};
    if (t_us == 0) ids = found;
    ASSERT_EQ(found, ids) << t_us;
    ASSERT_NE(ids[0], ids[1]);
  }
  for (const TrackedObstacle& tracked : tracker.obstacles()) {
    const Obstacle& obstacle = tracked.obstacle;
    const std::size_t ball = obstacle.v_WO.y() < 0 ? 0 : 1;
    EXPECT_EQ(obstacle.detections, 101);
    EXPECT_EQ(obstacle.t_us, 403500);
    EXPECT_EQ(obstacle.last_detection_us, 400000);
    EXPECT_TRUE(tracked.confirmed);
    EXPECT_LT((obstacle.v_WO - v[ball]).norm(), 1.0);
    EXPECT_LT((obstacle.p_WO - (p[ball] + 0.4035 * v[ball])).norm(), 0.06);
  }
}

TEST(Tracker, MovesTheEllipsoidWithThePredictionBetweenDetections) {
  Tracker tracker({}, {}, kLifetimeS);
  for (TimeUs t_us = 0; t_us <= 100000; t_us += 5000) {
    const double t = seconds(t_us);
    update(tracker, t_us, {seen(t_us, Vector3d(3 - 5 * t, 0.1, 0.2), 0.3)});
  }
  const TrackedObstacle before = tracker.obstacles().at(0);
  EXPECT_TRUE(before.ellipsoid.centre_W.isApprox(before.obstacle.p_WO, 1e-3));
  EXPECT_NEAR(before.ellipsoid.semi_axes_m.maxCoeff(), 0.3, 1e-2);
  update(tracker, 180000, {});
  const TrackedObstacle after = tracker.obstacles().at(0);
  EXPECT_EQ(after.obstacle.t_us, 180000);
  EXPECT_EQ(after.obstacle.last_detection_us, 100000);
  EXPECT_NEAR(after.obstacle.p_WO.x(), 3 - 5 * 0.18, 0.03);
  EXPECT_TRUE((after.ellipsoid.centre_W - after.obstacle.p_WO)
                  .isApprox(before.ellipsoid.centre_W - before.obstacle.p_WO, 1e-9));
  EXPECT_GT(after.covariance(0, 0), before.covariance(0, 0));
}

TEST(Tracker, ConfirmsAnObstacleAfterTheSetNumberOfDetections) {
  AssociationConfig config;
  config.min_detections = 3;
  Tracker tracker(config, {}, kLifetimeS);
  for (int i = 0; i < 4; ++i) {
    update(tracker, 1000 * i, {seen(1000 * i, Vector3d(2, 0, 0))});
    EXPECT_EQ(tracker.obstacles().at(0).confirmed, i >= 2);
  }
}

TEST(Tracker, RemovesAnObstacleAfterItsLifetime) {
  Tracker tracker({}, {}, kLifetimeS);
  for (int i = 0; i < 3; ++i) update(tracker, 1000 * i, {seen(1000 * i, Vector3d(2, 0, 0))});
  update(tracker, 2000 + 800000, {});
  EXPECT_EQ(tracker.obstacles().size(), 1);
  update(tracker, 2000 + 800001, {});
  EXPECT_TRUE(tracker.obstacles().empty());
}

TEST(Tracker, ForgetsWhatIsFromBeforeTheClockWasSetBack) {
  Tracker tracker({}, {}, kLifetimeS);
  for (int i = 0; i < 3; ++i) update(tracker, 1000 * i, {seen(1000 * i, Vector3d(2, 0, 0))});
  tracker.predict(1999);
  EXPECT_TRUE(tracker.obstacles().empty());
}

TEST(Tracker, DropsWhatWasNotConfirmedEarlier) {
  Tracker tracker({}, {}, kLifetimeS);
  update(tracker, 0, {seen(0, Vector3d(2, 0, 0))});
  update(tracker, 25000, {});
  EXPECT_EQ(tracker.obstacles().size(), 1);
  update(tracker, 25001, {});
  EXPECT_TRUE(tracker.obstacles().empty());
}

TEST(Tracker, DropsWhatWasNotConfirmedOnlyOnceItWasLookedForAndMissed) {
  Tracker tracker({}, {}, kLifetimeS);
  update(tracker, 0, {seen(0, Vector3d(2, 0, 0))});
  tracker.predict(60000);  // long after the timeout, but nobody has looked
  EXPECT_EQ(tracker.obstacles().size(), 1);
  update(tracker, 64000, {});
  EXPECT_EQ(tracker.obstacles().size(), 1) << "missed by this look, dropped by what follows";
  tracker.predict(68000);
  EXPECT_TRUE(tracker.obstacles().empty());
}

TEST(Tracker, BetweenLooksItPredictsAndForgets) {
  Tracker tracker({}, {}, kLifetimeS);
  for (int i = 0; i < 3; ++i) update(tracker, 1000 * i, {seen(1000 * i, Vector3d(2, 0, 0))});
  tracker.predict(5000);
  EXPECT_EQ(tracker.obstacles().at(0).obstacle.t_us, 5000);
  tracker.predict(2000 + 800001);
  EXPECT_TRUE(tracker.obstacles().empty());
}

// A slow pilot's cycles, farther apart than the timeout.
TEST(Tracker, ConfirmsWhatEveryCycleSeesHoweverFarApartTheyAre) {
  Tracker tracker({}, {}, kLifetimeS);
  for (int i = 0; i < 3; ++i) {
    update(tracker, 60000 * i, {seen(60000 * i, Vector3d(3 - 0.06 * 8 * i, 0, 0))});
    ASSERT_EQ(tracker.obstacles().size(), 1);
  }
  EXPECT_TRUE(tracker.obstacles()[0].confirmed);
}

TEST(Tracker, NeverReusesAnIdentifier) {
  Tracker tracker({}, {}, kLifetimeS);
  std::vector<Detection> detections = {seen(0, Vector3d(2, 0, 0)), seen(0, Vector3d(2, 1, 0))};
  tracker.update(0, detections);
  EXPECT_EQ(detections[0].obstacle_id, 0);
  EXPECT_EQ(detections[1].obstacle_id, 1);
  detections = {seen(900000, Vector3d(2, 0, 0))};
  tracker.update(900000, detections);
  EXPECT_EQ(detections[0].obstacle_id, 2);
}

TEST(Tracker, IsNotMovedByADetectionThatComesLate) {
  // Each look is followed by one of 4 ms, and 4 cm of the ball's way, before.
  KalmanConfig kalman;
  kalman.acceleration_noise_mps2_sqrthz = 0;
  Tracker tracker({}, kalman, kLifetimeS);
  const auto ball = [](TimeUs t_us) { return seen(t_us, {4 - 10 * seconds(t_us), 0, 0}); };
  for (TimeUs t_us = 10000; t_us <= 100000; t_us += 10000) {
    update(tracker, t_us, {ball(t_us)});
    update(tracker, t_us, {ball(t_us - 4000)});
  }
  ASSERT_EQ(tracker.obstacles().size(), 1);
  const Obstacle& obstacle = tracker.obstacles()[0].obstacle;
  EXPECT_EQ(obstacle.detections, 20);
  EXPECT_NEAR(obstacle.p_WO.x(), 3, 1e-3);
  EXPECT_NEAR(obstacle.v_WO.x(), -10, 0.02);
  // So late that the ball has left the place by more than the gate.
  std::vector<Detection> late = {ball(40000)};
  tracker.update(101000, late);
  EXPECT_EQ(late[0].obstacle_id, obstacle.id);
  EXPECT_EQ(tracker.obstacles().size(), 1);
}

TEST(Tracker, PredictsObstaclesToTheInstantOfEachDetection) {
  AssociationConfig association;
  association.gate_sigmas = 3;
  KalmanConfig kalman;
  kalman.acceleration_noise_mps2_sqrthz = 0.1;
  Tracker tracker(association, kalman, kLifetimeS);
  const auto ball = [](TimeUs t_us) { return seen(t_us, {4 - 10 * seconds(t_us), 0, 0}); };
  for (TimeUs t_us = 0; t_us <= 100000; t_us += 4000) update(tracker, t_us, {ball(t_us)});
  ASSERT_EQ(tracker.obstacles().size(), 1);
  // Something else was seen before, when the ball was 0.2 m farther.
  std::vector<Detection> both = {seen(90000, {2, 3, 0}), ball(110000)};
  tracker.update(110000, both);
  EXPECT_EQ(both[1].obstacle_id, tracker.obstacles()[0].obstacle.id);
  EXPECT_NE(both[0].obstacle_id, both[1].obstacle_id);
}

TEST(Tracker, IgnoresDetectionsThatAreNotFinite) {
  Tracker tracker({}, {}, kLifetimeS);
  Detection bad_centre = seen(0, Vector3d(2, 0, 0)), bad_point = bad_centre, bad_sigma = bad_centre,
            bad_size = bad_centre;
  bad_centre.centre_W.x() = std::nan("");
  bad_point.p_W[3].y() = INFINITY;
  bad_sigma.depth_sigma_m = std::nan("");
  bad_size.size_m = std::nan("");
  std::vector<Detection> detections = {bad_centre, bad_point, bad_sigma, bad_size};
  for (Detection& detection : detections) detection.obstacle_id = 7;
  tracker.update(0, detections);
  EXPECT_TRUE(tracker.obstacles().empty());
  for (const Detection& detection : detections) EXPECT_EQ(detection.obstacle_id, -1);
}

TEST(Tracker, DetectionsThatAreNotFiniteTakeNoTrackFromOthers) {
  Tracker tracker({}, {}, kLifetimeS);
  for (TimeUs t_us = 0; t_us < 50000; t_us += 10000) update(tracker, t_us, {seen(t_us, {2, 0, 0})});
  ASSERT_EQ(tracker.obstacles().size(), 1);
  Detection bad = seen(50000, {2, 0, 0});
  bad.size_m = std::nan("");
  std::vector<Detection> detections = {bad, seen(50000, {2, 0.02, 0})};
  tracker.update(50000, detections);
  EXPECT_EQ(detections[0].obstacle_id, -1);
  EXPECT_EQ(detections[1].obstacle_id, tracker.obstacles()[0].obstacle.id);
  EXPECT_EQ(tracker.obstacles().size(), 1);
}

TEST(Tracker, StaysFiniteWithDetectionsOfNoSizeAndOutOfOrder) {
  Generator random(2);
  Tracker tracker({}, {}, kLifetimeS);
  for (int i = 0; i < 2000; ++i) {
    std::vector<Detection> detections(random.bits() % 4);
    for (Detection& detection : detections) {
      const TimeUs t_us = 1000 * i - static_cast<TimeUs>(random.bits() % 20000);
      const Vector3d centre =
          random.bits() % 4 == 0 ? Vector3d::Zero().eval() : random.uniform_vector(-0.5, 0.5);
      detection = seen(t_us, centre, random.bits() % 3 == 0 ? 0 : 0.2);
      detection.depth_sigma_m = random.bits() % 2 == 0 ? 0 : 0.1;
    }
    tracker.update(1000 * i, detections);
    for (const TrackedObstacle& tracked : tracker.obstacles()) {
      ASSERT_TRUE(tracked.obstacle.p_WO.allFinite() && tracked.obstacle.v_WO.allFinite());
      ASSERT_TRUE(tracked.ellipsoid.semi_axes_m.allFinite() && tracked.covariance.allFinite());
      ASSERT_GT(tracked.ellipsoid.semi_axes_m.minCoeff(), 0);
    }
  }
}

TEST(Tracker, RefusesANegativeLifetime) {
  EXPECT_THROW(Tracker({}, {}, -1), std::invalid_argument);
  EXPECT_THROW(Tracker({}, {}, std::nan("")), std::invalid_argument);
}

TEST(KnownObstacle, IsABallThatActsAtOnce) {
  const TrackedObstacle known = known_obstacle(3, 42, {1, 2, 3}, {-5, 0, 1}, 0.2);
  EXPECT_EQ(known.obstacle.id, 3);
  EXPECT_EQ(known.obstacle.last_detection_us, 42);
  EXPECT_TRUE(known.confirmed);
  EXPECT_EQ(known.ellipsoid.centre_W, Vector3d(1, 2, 3));
  EXPECT_EQ(known.ellipsoid.semi_axes_m, Vector3d::Constant(0.1));
}

}  // namespace
}  // namespace dodge

#include "dodge/detect/association.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <stdexcept>
#include <vector>

#include "dodge/check_ranges.h"
#include "tests/dodge/generator.h"

namespace dodge {
namespace {

using Eigen::Vector3d;
using ::testing::ElementsAre;

MeasuredPosition at(double x, double y = 0, double z = 0) {
  return {Vector3d(x, y, z), Eigen::Matrix3d::Zero()};
}

PredictedObstacle obstacle(double x, int detections = 5) {
  PredictedObstacle predicted;
  predicted.p_W = Vector3d(x, 0, 0);
  predicted.detections = detections;
  return predicted;
}

std::vector<int> associate(const AssociationConfig& config,
                           const std::vector<MeasuredPosition>& detections,
                           const std::vector<PredictedObstacle>& obstacles) {
  std::vector<PredictedObstacle> predicted;  // the same at every detection's instant
  for (std::size_t i = 0; i < detections.size(); ++i) {
    predicted.insert(predicted.end(), obstacles.begin(), obstacles.end());
  }
  Associator associator(config);
  const auto result = associator.associate(detections, predicted);
  return {result.begin(), result.end()};
}

TEST(Associator, TakesTheClosestObstacleWithinTheSphere) {
  EXPECT_THAT(associate({}, {at(1.0), at(3.0)}, {obstacle(0.7), obstacle(1.2), obstacle(2.0)}),
              ElementsAre(1, -1));
}

TEST(Associator, LooksAsFarForAnObstacleThatWasSeenOnceAsItMayHaveComeSince) {
  const auto index_at = [](double x, int detections, double unseen_s) {
    PredictedObstacle predicted = obstacle(0, detections);
    predicted.unseen_s = unseen_s;
    return associate({}, {at(x)}, {predicted}).at(0);
  };
  EXPECT_EQ(index_at(0.09, 1, 0), 0);
  EXPECT_EQ(index_at(0.11, 1, 0), -1);
  EXPECT_EQ(index_at(0.69, 1, 0.06), 0);
  EXPECT_EQ(index_at(0.71, 1, 0.06), -1);
  EXPECT_EQ(index_at(0.34, 2, 0.06), 0);
  EXPECT_EQ(index_at(0.36, 2, 0.06), -1) << "its velocity is known";
}

TEST(Associator, GivesEachObstacleToTheClosestDetectionOnly) {
  // Both detections are closest to obstacle 1; the nearer one gets it, the other takes what is
  // left.
  EXPECT_THAT(associate({}, {at(1.2), at(1.05)}, {obstacle(1.4), obstacle(1.0)}),
              ElementsAre(0, 1));
  EXPECT_THAT(associate({}, {at(1.2), at(1.05)}, {obstacle(1.0)}), ElementsAre(-1, 0));
}

TEST(Associator, BreaksTiesByTheLowerIndex) {
  EXPECT_THAT(associate({}, {at(0.1), at(0.1)}, {obstacle(0)}), ElementsAre(0, -1));
  EXPECT_THAT(associate({}, {at(0)}, {obstacle(0.25), obstacle(-0.25)}), ElementsAre(0));
}

TEST(Associator, GatesByTheUncertaintyOfBothTowardsTheDetection) {
  PredictedObstacle uncertain = obstacle(0);
  uncertain.P_W = Vector3d(0.16, 0.0001, 0.0001).asDiagonal();
  const auto measured = [](double x, double y) {
    MeasuredPosition detection = at(x, y);
    detection.R_W = Vector3d(0.09, 0.0003, 0.0003).asDiagonal();  // with P: 0.5 m, 0.02 m
    return detection;
  };
  AssociationConfig config;
  config.gate_sigmas = 3;
  EXPECT_THAT(associate(config, {measured(1.49, 0)}, {uncertain}), ElementsAre(0));
  EXPECT_THAT(associate(config, {measured(1.51, 0)}, {uncertain}), ElementsAre(-1));
  EXPECT_THAT(associate(config, {measured(0, 0.059)}, {uncertain}), ElementsAre(0));
  EXPECT_THAT(associate(config, {measured(0, 0.061)}, {uncertain}), ElementsAre(-1));
  EXPECT_THAT(associate(config, {measured(1.3, 0.04)}, {uncertain}), ElementsAre(-1)) << "both";
  // Of two as uncertain, the nearest is that of the fewer deviations, not of the fewer metres.
  EXPECT_THAT(associate(config, {measured(0, 0.05), measured(1, 0)}, {uncertain}),
              ElementsAre(-1, 0));
}

TEST(Associator, GivesADetectionToTheLikelierObstacleNotToTheVaguer) {
  PredictedObstacle known = obstacle(0), vague = obstacle(0.5);
  known.P_W = 0.0004 * Eigen::Matrix3d::Identity();  // 0.02 m
  vague.P_W = 0.09 * Eigen::Matrix3d::Identity();    // 0.3 m
  AssociationConfig config;
  config.gate_sigmas = 3;
  // 2 deviations from the known, 1.5 from the vague, where it is 1500 times less likely.
  EXPECT_THAT(associate(config, {at(0.04)}, {known, vague}), ElementsAre(0));
  EXPECT_THAT(associate(config, {at(0.04)}, {vague, known}), ElementsAre(1));
  EXPECT_THAT(associate(config, {at(0.07)}, {known, vague}), ElementsAre(1)) << "outside the gate";
}

TEST(Associator, HasNothingToSayWithoutDetectionsOrObstacles) {
  EXPECT_THAT(associate({}, {}, {obstacle(0)}), ElementsAre());
  EXPECT_THAT(associate({}, {at(0), at(1)}, {}), ElementsAre(-1, -1));
}

TEST(Associator, IgnoresADetectionWithoutAPosition) {
  EXPECT_THAT(associate({}, {at(std::nan("")), at(0.1)}, {obstacle(0)}), ElementsAre(-1, 0));
}

TEST(Associator, IsOneToOneAndLeavesNoPairThatWouldBothRatherHaveEachOther) {
  Generator random(1);
  const AssociationConfig config;
  for (int k = 0; k < 300; ++k) {
    std::vector<MeasuredPosition> detections(random.bits() % 6);
    std::vector<PredictedObstacle> obstacles(random.bits() % 6);
    for (MeasuredPosition& d : detections) d.p_W = random.uniform_vector(-0.4, 0.4);
    for (PredictedObstacle& o : obstacles) {
      o.p_W = random.uniform_vector(-0.4, 0.4);
      o.detections = 5;
    }
    const std::vector<int> result = associate(config, detections, obstacles);
    const auto distance = [&](std::size_t d, std::size_t o) {
      return (detections[d].p_W - obstacles[o].p_W).norm();
    };
    std::vector<double> detection_has(detections.size(), 1e9), obstacle_has(obstacles.size(), 1e9);
    std::multiset<int> used;
    for (std::size_t d = 0; d < result.size(); ++d) {
      if (result[d] < 0) continue;
      const auto o = static_cast<std::size_t>(result[d]);
      EXPECT_LE(distance(d, o), config.radius_m);
      detection_has[d] = obstacle_has[o] = distance(d, o);
      used.insert(result[d]);
    }
    EXPECT_EQ(used.size(), std::set<int>(used.begin(), used.end()).size());
    for (std::size_t d = 0; d < detections.size(); ++d) {
      for (std::size_t o = 0; o < obstacles.size(); ++o) {
        if (distance(d, o) > config.radius_m) continue;
        EXPECT_GE(distance(d, o), std::min(detection_has[d], obstacle_has[o]));
      }
    }
  }
}

TEST(AssociationConfig, RefusesValuesOutOfRange) {
  const auto refused = [](auto change) {
    AssociationConfig config;
    change(config);
    EXPECT_THROW(check_ranges(config), std::invalid_argument);
  };
  refused([](AssociationConfig& c) { c.radius_m = 0; });
  refused([](AssociationConfig& c) { c.first_radius_m = std::nan(""); });
  refused([](AssociationConfig& c) { c.first_speed_mps = -1; });
  refused([](AssociationConfig& c) { c.min_detections = 0; });
  refused([](AssociationConfig& c) { c.gate_sigmas = -1; });
}

}  // namespace
}  // namespace dodge

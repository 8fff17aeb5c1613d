#include "sim/world/snapshot.h"

#include <gtest/gtest.h>

namespace dodgesim {
namespace {

// A vehicle that turns and an object that flies evenly.
Snapshot even_motion(TimeUs t_us) {
  const double t_s = seconds(t_us);
  Snapshot now;
  now.t_us = t_us;
  now.vehicle.p_W = {0.5 * t_s, -1.5 * t_s, 2};
  now.vehicle.q_W = Eigen::AngleAxisd(5 * t_s, Eigen::Vector3d::UnitZ());
  BodyState object;
  object.v_W = {-8, 0, 1 - 9.81 * t_s};
  object.p_W = {3 - 8 * t_s, 0.2, 1.8 + t_s};
  now.objects = {object};
  now.launched = {true};
  return now;
}

TEST(SnapshotHistory, TellsTheStateBetweenTwoSnapshots) {
  SnapshotHistory history;
  for (TimeUs t_us = 1000; t_us <= 3000; t_us += kTickUs) history.add(even_motion(t_us));
  for (const TimeUs t_us : {1000, 1001, 1125, 1249, 1250, 2990, 3000}) {
    const std::optional<Snapshot> state = history.at(t_us);
    const Snapshot expected = even_motion(t_us);
    ASSERT_TRUE(state);
    EXPECT_EQ(state->t_us, t_us);
    EXPECT_LT((state->objects[0].p_W - expected.objects[0].p_W).norm(), 1e-12);
    EXPECT_LT((state->objects[0].v_W - expected.objects[0].v_W).norm(), 1e-12);
    EXPECT_LT((state->vehicle.p_W - expected.vehicle.p_W).norm(), 1e-12);
    EXPECT_LT(state->vehicle.q_W.angularDistance(expected.vehicle.q_W), 1e-9);
  }
}

TEST(SnapshotHistory, KnowsNothingBeforeTheFirstKeptAndAfterTheLast) {
  SnapshotHistory history;
  EXPECT_FALSE(history.at(0));
  for (TimeUs t_us = 0; t_us <= SnapshotHistory::kKeptUs + 10000; t_us += 5000) {
    history.add(even_motion(t_us));
  }
  EXPECT_FALSE(history.at(9999));
  EXPECT_TRUE(history.at(10000));
  EXPECT_TRUE(history.at(SnapshotHistory::kKeptUs + 10000));
  EXPECT_FALSE(history.at(SnapshotHistory::kKeptUs + 10001));
}

// A launch moves the object at once.
TEST(Snapshot, IsNotInterpolatedAcrossALaunch) {
  Snapshot before = even_motion(0), after = even_motion(kTickUs);
  before.launched = {false};
  before.objects[0].p_W = {0, 0, -100};
  const Snapshot between = interpolate(before, after, kTickUs / 2);
  EXPECT_EQ(between.objects[0].p_W, after.objects[0].p_W);
}

}  // namespace
}  // namespace dodgesim

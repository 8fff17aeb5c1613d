#include "sim/paper/miss.h"

#include <gtest/gtest.h>

#include "sim/flight/fly_throw.h"
#include "sim/paper/miss_investigator.h"
#include "tests/sim/paper/synthetic_passage.h"

namespace dodgesim {
namespace {

ObservedCycle cycle(std::array<int, 2> events, std::array<int, 2> clusters,
                    std::optional<ObservedCycle::Location> location = std::nullopt) {
  ObservedCycle cycle;
  cycle.events = events;
  cycle.clusters = clusters;
  cycle.location = location;
  return cycle;
}

Miss miss(const std::vector<ObservedCycle>& cycles, const std::string& depth = "stereo") {
  dodge::DepthConfig limits;  // 0.2 to 1.5 m, 3 to 80 cm
  limits.depth = depth;
  return miss_of(cycles, limits, 30);
}

TEST(Miss, IsHowFarThePilotGot) {
  EXPECT_EQ(miss({}), Miss::kFewEvents);
  EXPECT_EQ(miss({cycle({100, 29}, {0, 0})}), Miss::kFewEvents);
  EXPECT_EQ(miss({cycle({100, 30}, {0, 0})}), Miss::kNoCluster);
  EXPECT_EQ(miss({cycle({100, 100}, {0, 2})}), Miss::kOneCamera);
  EXPECT_EQ(miss({cycle({100, 100}, {1, 1})}), Miss::kNoMatch);
  EXPECT_EQ(miss({cycle({100, 100}, {1, 1}, ObservedCycle::Location{1.51, 0.2})}), Miss::kRange);
  EXPECT_EQ(miss({cycle({100, 100}, {1, 1}, ObservedCycle::Location{1.0, 0.9})}), Miss::kSize);
  EXPECT_EQ(miss({cycle({100, 100}, {1, 1}, ObservedCycle::Location{1.0, 0.2})}), Miss::kElsewhere);
}

TEST(Miss, IsTheBestOfAllCycles) {
  EXPECT_EQ(miss({cycle({0, 0}, {0, 0}), cycle({100, 100}, {1, 1}), cycle({100, 100}, {0, 1})}),
            Miss::kNoMatch);
}

TEST(Miss, OfOneCameraAsksForOneCamera) {
  EXPECT_EQ(miss({cycle({30, 0}, {0, 0})}, "mono"), Miss::kNoCluster);
  EXPECT_EQ(miss({cycle({100, 0}, {0, 0}, ObservedCycle::Location{2, 0.2})}, "mono"), Miss::kRange);
}

Scenario passing_ball(const std::string& dodger) {
  return paper_scenario(
      "fly_oracle: false\nafter_s: 0.1\n"
      "throw: {size_m: 0.2, speed_mps: 8, distance_m: 1.2, bearing_deg: 45, launch_s: 0.1,\n"
      "        aim_offset_m: [-0.6, 0], launch_height_m: 2}\n"
      "dodger: {repulsive: {k_r0: 0}, " +
      dodger + "}\n");
}

constexpr RangeBin kNear{0, 1};

// Of a pilot with these parameters, while the ball is near.
std::vector<ObservedCycle> near_cycles(const std::string& dodger) {
  const Scenario scenario = passing_ball(dodger);
  MissObserver observer(scenario);
  EXPECT_TRUE(fly_throw(scenario, 0, &observer).flown.ok());
  std::vector<ObservedCycle> cycles;
  for (const ObservedCycle& cycle : observer.cycles()) {
    if (cycle.centre_in_view && kNear.contains(cycle.range_m)) cycles.push_back(cycle);
  }
  EXPECT_GT(cycles.size(), 10u);
  return cycles;
}

TEST(MissObserver, FindsWhatAFlyingPilotLacks) {
  EXPECT_EQ(miss(near_cycles("cluster: {min_pixels: 100000}")), Miss::kNoCluster);

  LoadedCampaign campaign;
  campaign.scenario = passing_ball("position: {stereo: {min_correlation: 1}}");
  MissInvestigator investigator(campaign);
  EXPECT_EQ(investigator.reason(0, kNear, 0, 1000000), Miss::kNoMatch);
  EXPECT_EQ(investigator.reason(0, kNear, 0, 100000), Miss::kFewEvents) << "before the launch";
  EXPECT_EQ(investigator.reason(0, {5, 6}, 0, 1000000), Miss::kFewEvents) << "never so far";

  const std::vector<ObservedCycle> good = near_cycles("cluster: {}");
  EXPECT_EQ(miss(good), Miss::kElsewhere);
  dodge::DepthConfig limits;
  limits.min_size_m = 0.5;
  EXPECT_EQ(miss_of(good, limits, 30), Miss::kSize);
  limits.max_range_m = 0.3;
  EXPECT_EQ(miss_of(good, limits, 30), Miss::kRange);
  for (const ObservedCycle& cycle : good) {
    const double located_m = cycle.location ? cycle.location->range_m : cycle.range_m;
    EXPECT_NEAR(located_m, cycle.range_m, 0.3);
  }
}

}  // namespace
}  // namespace dodgesim

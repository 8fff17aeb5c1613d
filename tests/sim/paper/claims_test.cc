// The tables of the claims, over campaigns that nobody has flown.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "sim/paper/experiment.h"
#include "tests/sim/paper/synthetic_campaign.h"

namespace dodgesim {
namespace {

using testing::HasSubstr;

// Two throws, one of 4 and one of 8 m/s, for each value of a sweep; all that `hit` says hit.
LoadedCampaign swept(const std::vector<std::vector<AxisValue>>& sweep,
                     const std::function<bool(std::size_t part, double speed_mps)>& hit) {
  std::vector<ThrowResult> results;
  for (std::size_t part = 0; part < sweep.size(); ++part) {
    for (int i = 0; i < 2; ++i) {
      ThrowResult result = thrown(static_cast<int>(2 * part) + i, true, false);
      result.sweep = static_cast<int>(part);
      result.sweep_values = sweep[part];
      result.flown.hit = hit(part, result.speed_mps);
      results.push_back(result);
    }
  }
  return campaign(std::move(results));
}

TEST(LatencyClaim, SaysAtWhichLatencyEachSpeedIsLost) {
  std::vector<std::vector<AxisValue>> oracle, pilot;
  for (const char* range : {"1.5", "3"}) {
    for (const char* delay : {"3000", "59500"}) {
      oracle.push_back({{"oracle.range_cap_m", range}, {"delays.command_us", delay}});
    }
  }
  for (const char* delay : {"3000", "29500", "59500"}) {
    pilot.push_back({{"delays.command_us", delay}});
  }
  const auto none = [](std::size_t, double) { return false; };
  const PaperTables tables = latency_experiment().analyse(
      {swept(oracle, none),
       swept(pilot, [](std::size_t part, double speed) { return speed > 5 && part == 2; }),
       swept(pilot, [](std::size_t part, double speed) { return speed > 5 || part > 0; })});
  // falanga2020 loses 8 m/s half-way between 30 and 60 ms, dodgesim at once, and 4 m/s half-way
  // between 3.5 and 30 ms.
  EXPECT_THAT(tables.markdown,
              testing::ContainsRegex("\\| 4 m/s \\|[^\n]*\\| > 60 \\| > 60 \\| > 60 \\| 17 \\|"));
  EXPECT_THAT(tables.markdown,
              testing::ContainsRegex("\\| 8 m/s \\|[^\n]*\\| > 60 \\| > 60 \\| 45 \\| < 3.5 \\|"));
  EXPECT_THAT(tables.csv, HasSubstr("\"falanga2020, 3 m\",8 m/s,60.0 ms,0,1,0.0000,"));
  EXPECT_EQ(tables.plots.size(), 4u);
}

TEST(ThresholdClaim, TellsFalseEventsFromMissedOnes) {
  LoadedCampaign a = swept({{{"dodger.time_image.threshold_a_s", "0.1"}}},
                           [](std::size_t, double) { return false; });
  LoadedCampaign b = swept({{{"dodger.time_image.threshold_b", "0.2"}}},
                           [](std::size_t, double) { return false; });
  // 1000 events, 200 of a ball; 100 in clusters, 50 of them the ball's.
  a.results[0].truth_rows = {{0, 0, false, {1000, 200, 100, 50}}};
  a.results[1].truth_rows = {{1, 0, true, {1000, 100, 100, 90}}};
  const std::string tables = threshold_experiment().analyse({a, b}).markdown;
  EXPECT_THAT(tables, HasSubstr("| 25.0 % | 90.0 % | 50.0 % | 10.0 % |"));
  EXPECT_THAT(tables, HasSubstr("| **0.1** |"));
  EXPECT_THAT(tables, HasSubstr("| 0.2 |"));
}

TEST(RangeClaim, PutsTheRangesBesideTheSpeeds) {
  const LoadedCampaign pilot =
      swept({{{"dodger.position.max_range_m", "1"}}, {{"dodger.position.max_range_m", "3"}}},
            [](std::size_t part, double) { return part == 0; });
  const LoadedCampaign oracle =
      swept({{{"oracle.range_cap_m", "1"}}, {{"oracle.range_cap_m", "3"}}},
            [](std::size_t, double speed) { return speed > 5; });
  const PaperTables tables = range_experiment().analyse({pilot, oracle});
  EXPECT_THAT(tables.csv, HasSubstr("falanga2020,1 m,4 m/s,0,1,"));
  EXPECT_THAT(tables.csv, HasSubstr("falanga2020,3 m,4 m/s,1,1,"));
  EXPECT_THAT(tables.csv, HasSubstr("oracle,3 m,8 m/s,0,1,"));
}

}  // namespace
}  // namespace dodgesim

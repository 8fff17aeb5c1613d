// The table of flights whose state estimate drifts.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "sim/paper/experiment.h"
#include "tests/sim/paper/synthetic_campaign.h"

namespace dodgesim {
namespace {

using ::testing::HasSubstr;

ThrowResult landed(int index, TimeUs landing_us) {
  ThrowResult result = thrown(index, false, false);
  result.landing_us = landing_us;
  result.landed_us = landing_us + 5000000;
  return result;
}

TEST(Drift, TellsTheMonitorsLandingsFromCrashesWithoutIt) {
  const LoadedCampaign none = campaign({thrown(0, false, false)});
  LoadedCampaign up = campaign({landed(0, 3700000), landed(1, 3800000), thrown(2, false, false)});
  up.scenario.sensors.state_estimate.height_drift_mps = 0.2;
  for (ThrowResult& result : up.results) {
    result.object.clear();  // nobody throws
    result.sweep = result.index / 2;
    result.sweep_values = {{"dodger.height_monitor.enabled", result.sweep == 0 ? "true" : "false"}};
  }
  up.results[2].flown.crashed = true;
  LoadedCampaign balls = campaign({thrown(0, true, false), landed(1, 1900000)});
  for (ThrowResult& result : balls.results) {
    result.cell_values = {
        {"sensors.state_estimate.height_drift_mps", result.index == 0 ? "0" : "0.5"}};
  }
  ThrowResult failed = thrown(2, true, false);
  failed.cell_values = balls.results[0].cell_values;
  failed.flown.status = "error";
  balls.results.push_back(failed);
  const std::string table = drift_experiment().analyse({none, up, up, balls}).markdown;
  EXPECT_THAT(table,
              HasSubstr("\n| hover | 0 | on | 0 / 1 (0.00 to 0.79) | 0 / 1 (0.00 to 0.79) | - |"));
  EXPECT_THAT(table, HasSubstr("\n| hover | 0.2 | on | 2 / 2 (0.34 to 1.00) | 0 / 2 (0.00 to 0.66) "
                               "| 3.75 (3.70 to 3.80) | - |\n"));
  EXPECT_THAT(
      table,
      HasSubstr("\n| hover | 0.2 | off | 0 / 1 (0.00 to 0.79) | 1 / 1 (0.21 to 1.00) | - |"));
  EXPECT_THAT(
      table,
      HasSubstr("\n| balls | 0 | on | 0 / 1 (0.00 to 0.79) | 0 / 1 (0.00 to 0.79) | - | 1 / 2 ("));
  EXPECT_THAT(
      table,
      HasSubstr("\n| balls | 0.5 | on | 1 / 1 (0.21 to 1.00) | 0 / 1 (0.00 to 0.79) | 1.90 ("));
}

}  // namespace
}  // namespace dodgesim

// The table of flights in which nobody throws.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "sim/paper/experiment.h"
#include "tests/sim/paper/synthetic_campaign.h"

namespace dodgesim {
namespace {

using ::testing::HasSubstr;

ThrowResult undisturbed(int index, bool evaded, int detections) {
  ThrowResult result = thrown(index, false, false);
  result.object.clear();
  result.none.status = result.oracle.status = "not flown";
  result.evaded = evaded;
  result.detections = detections;
  result.duration_us = 90'000'000;
  return result;
}

TEST(Quiet, CountsFlightsThatEvadeAndMinutesOfThoseThatWereFlown) {
  const PaperExperiment quiet = quiet_experiment();
  ThrowResult failed = undisturbed(2, true, 5);
  failed.flown.status = "error";
  LoadedCampaign first = campaign({undisturbed(0, true, 3), undisturbed(1, false, 1), failed});
  first.results[1].flown.crashed = true;
  std::vector<LoadedCampaign> campaigns(quiet.flights.size(), campaign({undisturbed(0, false, 0)}));
  campaigns.front() = first;
  campaigns.back().scenario =
      paper_scenario("pilot: dodgesim\nroom: field\ndodger: {position: {depth: mono}}\n");
  const std::string table = quiet.analyse(campaigns).markdown;
  EXPECT_THAT(table, HasSubstr("\n| falanga2020 | two | room | hover | 2 | 3.0 | 4 | "
                               "1 / 2 (0.09 to 0.91) | 1 / 2 (0.09 to 0.91) |\n"));
  EXPECT_THAT(table, HasSubstr("\n| dodgesim | one | field | hover | 1 | 1.5 | 0 | 0 / 1 ("));
}

// With one camera, the parameters are those of the indoor experiments.
TEST(Quiet, FliesOneCameraAsIndoors) {
  const auto scenario = [](const std::string& file, const std::vector<Setting>& settings) {
    return load_scenario(std::string(DODGESIM_SOURCE_DIR) + "/scenarios/paper/" + file,
                         testing::kModels, settings);
  };
  const Scenario indoor = scenario("indoor.yaml", {});
  int with_one_camera = 0;
  for (const PaperFlight& flight : quiet_experiment().flights) {
    const Scenario quiet = scenario(flight.scenario, flight.settings);
    EXPECT_FALSE(quiet.anyone_throws()) << flight.name;
    if (quiet.dodger.position.depth != "mono") continue;
    ++with_one_camera;
    EXPECT_EQ(quiet.dodger.time_image.threshold_b, indoor.dodger.time_image.threshold_b);
    EXPECT_EQ(quiet.dodger.cluster.min_events, indoor.dodger.cluster.min_events);
    EXPECT_EQ(quiet.dodger.cluster.max_aspect, indoor.dodger.cluster.max_aspect);
  }
  EXPECT_EQ(with_one_camera, 4);
}

}  // namespace
}  // namespace dodgesim

// The tables of the claims, over campaigns that nobody has flown.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <functional>

#include "sim/paper/avoidance_bound.h"
#include "sim/paper/experiment.h"
#include "tests/sim/paper/synthetic_campaign.h"

namespace dodgesim {
namespace {

using ::testing::DoubleNear;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::StartsWith;

// For each value of a sweep so many throws of 4 and of 8 m/s, in turn; all that `hit` says hit.
LoadedCampaign swept(const std::vector<std::vector<AxisValue>>& sweep,
                     const std::function<bool(std::size_t part, double speed_mps)>& hit,
                     int repeats = 1) {
  std::vector<ThrowResult> results;
  for (std::size_t part = 0; part < sweep.size(); ++part) {
    for (int i = 0; i < 2 * repeats; ++i) {
      ThrowResult result = thrown(static_cast<int>(results.size()), true, false);
      result.sweep = static_cast<int>(part);
      result.sweep_values = sweep[part];
      result.flown.hit = hit(part, result.speed_mps);
      results.push_back(result);
    }
  }
  return campaign(std::move(results));
}

// Of a plot's series, those with exactly two points on one vertical line about one half: their x.
std::vector<double> ticks_of(const Plot& plot) {
  std::vector<double> ticks;
  for (const Series& series : plot.series) {
    const bool vertical = series.x.size() == 2 && series.x[0] == series.x[1];
    if (vertical && series.y[0] > 0 && series.y[0] + series.y[1] == 1) {
      ticks.push_back(series.x[0]);
    }
  }
  return ticks;
}

TEST(LatencyClaim, SaysAtWhichLatencyEachSpeedIsLost) {
  std::vector<std::vector<AxisValue>> oracle, pilot;
  for (const char* range : {"1.5", "3"}) {
    for (const char* delay : {"0", "56500"}) {
      oracle.push_back({{"oracle.range_cap_m", range}, {"delays.perception_us", delay}});
    }
  }
  for (const char* delay : {"0", "26500", "56500"}) {
    pilot.push_back({{"delays.perception_us", delay}});
  }
  const auto none = [](std::size_t, double) { return false; };
  LoadedCampaign own = swept(
      pilot, [](std::size_t part, double speed) { return speed > 5 || part > 0; }, 4);
  own.results[8].flown.hit = false;  // one of 4 m/s with 30 ms
  const PaperTables tables = latency_experiment().analyse(
      {swept(oracle, none),
       swept(
           pilot, [](std::size_t part, double speed) { return speed > 5 && part == 2; }, 4),
       own});
  // s / v - t_a - 0.1 - 1 - 2 - 3 - 0.25 ms, and the latencies between which half is lost. One
  // throw tells nothing, four that all end alike do, and one of four does not.
  EXPECT_THAT(tables.markdown, HasSubstr("| 4 m/s | 247 | 254 | 622 | 629 | > 60 (not told) | > 60 "
                                         "(not told) | > 60 | 3.5 to 30 (3.5 to 60) |"));
  EXPECT_THAT(tables.markdown, HasSubstr("| 8 m/s | 60 | 51 | 247 | 238 | > 60 (not told) | > 60 "
                                         "(not told) | 30 to 60 | < 3.5 |"));
  EXPECT_THAT(tables.markdown, HasSubstr("it takes 6.3 ms more than the perception"));
  EXPECT_THAT(tables.csv, HasSubstr("\"falanga2020, 1.5 m\",8 m/s,60.0 ms,0,4,0.0000,"));
  ASSERT_EQ(tables.plots.size(), 4u);
  // The ticks are the table's bounds of the rotors; for 3 m, 622 ms is beyond the plot.
  EXPECT_THAT(ticks_of(tables.plots[0].plot), ElementsAre(DoubleNear(50.6, 0.3)));
  EXPECT_THAT(ticks_of(tables.plots[1].plot), ElementsAre(DoubleNear(238.1, 0.5)));
}

TEST(ThresholdClaim, TellsFalseEventsFromMissedOnes) {
  LoadedCampaign a = swept({{{"dodger.time_image.threshold_a_s", "0.1"}}},
                           [](std::size_t, double) { return false; });
  LoadedCampaign b = swept({{{"dodger.time_image.threshold_b", "0.2"}}},
                           [](std::size_t, double) { return false; });
  // 1000 events, 200 of a ball; 100 in clusters, 50 of them the ball's.
  a.results[0].truth_rows = {{0, 0, false, {1000, 200, 100, 50}}};
  a.results[1].truth_rows = {{1, 0, true, {1000, 100, 100, 90}}};
  // Of a flight that failed nobody knows whether it would have had a false alarm.
  a.results.push_back(a.results[0]);
  a.results.back().flown.status = "error";
  a.results.back().truth_rows.clear();
  const PaperTables analysed = threshold_experiment().analyse({a, b});
  const std::string& tables = analysed.markdown;
  EXPECT_THAT(tables, HasSubstr("| 25.0 % (25.0 to 25.0) | 90.0 % (90.0 to 90.0) | "
                                "50.0 % (50.0 to 50.0) | 10.0 % (10.0 to 10.0) |"));
  EXPECT_THAT(tables, HasSubstr("| **0.1** |"));
  EXPECT_THAT(tables, HasSubstr("| 0.2 |"));
  // One table of numbers for both.
  EXPECT_THAT(analysed.csv, StartsWith("key,value,dodged,would_have_hit,"));
  EXPECT_THAT(analysed.csv, HasSubstr("\ndodger.time_image.threshold_a_s,0.1,2,3,,0,2,"
                                      "0.2500,0.9000,0.5000,0.1000\n"
                                      "dodger.time_image.threshold_b,0.2,2,2,"));
}

TEST(ThresholdClaim, TellsTheLeastAndTheGreatestOfTheThrows) {
  LoadedCampaign a = swept({{{"dodger.time_image.threshold_a_s", "0.1"}}},
                           [](std::size_t, double) { return false; });
  LoadedCampaign b = swept({{{"dodger.time_image.threshold_b", "0.1"}}},
                           [](std::size_t, double) { return false; });
  a.results[0].truth_rows = {{0, 0, false, {1000, 100, 20, 10}}, {0, 1, false, {1000, 100, 0, 0}}};
  a.results[1].truth_rows = {{1, 0, false, {1000, 200, 40, 40}}};
  // 10 of 200 and 40 of 200; 10 of 20 and none of 40.
  EXPECT_THAT(threshold_experiment().analyse({a, b}).markdown,
              HasSubstr("| 12.5 % (5.0 to 20.0) | - | 16.7 % (0.0 to 50.0) | - |"));
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
  // From the tick on, the bound is at least the speed: 4 and 8 m/s.
  const std::vector<double> ticks = ticks_of(tables.plots[1].plot);
  ASSERT_EQ(ticks.size(), 2u);
  const double tau_s = 1e-6 * static_cast<double>(oracle.scenario.delays.pilot_us()) +
                       latency_without_pilot_s(oracle.scenario);
  for (std::size_t i = 0; i < 2; ++i) {
    const double speed_mps = i == 0 ? 4 : 8;
    EXPECT_NEAR(rotors_bound(oracle.scenario, ticks[i]).greatest_speed_mps(tau_s), speed_mps, 0.05);
  }
}

TEST(SpeedClaim, KeepsThePilotsInOrder) {
  const std::vector<std::vector<AxisValue>> once = {{}};
  const std::vector<std::vector<AxisValue>> ranges = {{{"oracle.range_cap_m", "1.5"}},
                                                      {{"oracle.range_cap_m", "0"}}};
  const auto all = [](std::size_t, double) { return true; };
  const auto none = [](std::size_t, double) { return false; };
  const auto fast = [](std::size_t, double speed) { return speed > 5; };
  const auto capped = [](std::size_t part, double) { return part == 0; };
  const PaperTables tables =
      speed_experiment().analyse({swept(once, all), swept(once, none), swept(once, fast),
                                  swept(once, all), swept(ranges, capped), swept(ranges, none)});
  // The slow balls' columns, then the others'.
  const std::string hit = "0 / 1 (0.00 to 0.79)", dodged = "1 / 1 (0.21 to 1.00)";
  const auto row = [](const std::vector<std::string>& cells) {
    std::string text = "|";
    for (const std::string& cell : cells) text += " " + cell + " |";
    return text;
  };
  EXPECT_THAT(tables.markdown, HasSubstr(row({"falanga2020", hit, hit, dodged, dodged})));
  EXPECT_THAT(tables.markdown, HasSubstr(row({"dodgesim", dodged, hit, hit, hit})));
  EXPECT_THAT(tables.markdown, HasSubstr(row({"oracle, 1.5 m", hit, hit, dodged, dodged})));
  EXPECT_THAT(tables.markdown, HasSubstr(row({"oracle", dodged, dodged, dodged, dodged})));
}

TEST(FieldClaim, ComparesEachVariantWithTheFirstAtItsRange) {
  std::vector<std::vector<AxisValue>> ranges,
      lambdas = {{{"dodger.repulsive.lambda_decay_1ps", "10"}}};
  for (const char* range : {"1.5", "3"}) ranges.push_back({{"oracle.range_cap_m", range}});
  const std::size_t variants = field_experiment().flights.size() - 1;
  const auto none = [](std::size_t, double) { return false; };
  std::vector<LoadedCampaign> campaigns(variants, swept(ranges, none));
  // The second variant loses everything, at 3 m only, and the one after "no_speed" at 1.5 m.
  campaigns[1] = swept(ranges, [](std::size_t part, double) { return part == 1; });
  campaigns[5] = swept(ranges, [](std::size_t part, double) { return part == 0; });
  campaigns.push_back(swept(lambdas, none));
  const PaperTables tables = field_experiment().analyse(campaigns);
  const std::string second = "| (27) instead of (28) and (29), with \\|v\\| and \\|F_z\\| | ";
  EXPECT_THAT(tables.markdown,
              HasSubstr(second + "1 / 1 (0.21 to 1.00) | 1 / 1 (0.21 to 1.00) | 1.0000 |"));
  EXPECT_THAT(tables.markdown,
              HasSubstr(second + "0 / 1 (0.00 to 0.79) | 0 / 1 (0.00 to 0.79) | 0.5000 |"));
  const std::string without_speed = "\n(27) instead of (28), both without |v|: ";
  EXPECT_THAT(tables.markdown, HasSubstr(without_speed + "2 lost, 0 gained, p 0.5000.\n"));
  EXPECT_THAT(tables.markdown, HasSubstr(without_speed + "0 lost, 0 gained, p 1.0000.\n"));
}

TEST(PhysicsClaim, PutsTheStudyBesideItsOwnSpeedsAndSizes) {
  std::vector<ThrowResult> results;
  for (int i = 0; i < 40; ++i) {
    results.push_back(thrown(i, true, true));
    results.back().speed_mps = i < 20 ? 7 : 10;
    results.back().size_m = 0.3;
  }
  const PaperExperiment physics = physics_experiment();
  const std::vector<LoadedCampaign> campaigns(physics.flights.size(), campaign(results));
  const std::string tables = physics.analyse(campaigns).markdown;
  // No figure of the study for 7 m/s; 0 % for 10 m/s at 1.5 m; 29 % at 2 m, which ours excludes.
  EXPECT_THAT(tables, HasSubstr("| 0.3 m | 0 / 20 (0.00 to 0.16) | 0 / 20 (0.00 to 0.16), 0 |"));
  EXPECT_THAT(tables,
              HasSubstr("| 0.3 m | 0 / 20 (0.00 to 0.16) | **0 / 20 (0.00 to 0.16), 29** |"));
}

TEST(TranslationClaim, KnowsHowFarTheImageMoves) {
  const LoadedCampaign flown =
      swept({{{"mission.speed_mps", "1.5"}}}, [](std::size_t, double) { return true; });
  // 190.7 px, 1.5 m/s, tan 30 degrees, 10 ms, 3 m; the synthetic oracle dodges.
  const PaperTables tables = translation_experiment().analyse({flown});
  EXPECT_THAT(tables.markdown,
              HasSubstr("| 1.5 | 0.55 | 2 / 2 (0.34 to 1.00) | 0 / 2 (0.00 to 0.66) |"));
  EXPECT_THAT(tables.csv, HasSubstr("\n1.5,0.55,2,0,2,"));
}

}  // namespace
}  // namespace dodgesim

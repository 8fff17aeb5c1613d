// The tables of the avoidance experiments.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <map>
#include <set>
#include <string>
#include <vector>

#include "sim/paper/experiment.h"
#include "sim/paper/rate_grid.h"
#include "tests/sim/paper/synthetic_campaign.h"

namespace dodgesim {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

TEST(AvoidanceTables, NameTheShapeAboveItsCauses) {
  const PaperExperiment shapes = shapes_experiment();
  const LoadedCampaign dodged = campaign({thrown(0, true, false)});
  std::vector<LoadedCampaign> campaigns(shapes.flights.size(), dodged);
  campaigns[4] = campaign({thrown(0, true, true, "seen late")});  // the third shape
  const std::string tables = shapes.analyse(campaigns).markdown;
  EXPECT_THAT(tables, HasSubstr("\nmarker, 0.14 m:\n\n| cause of hits and crashes |"));
  EXPECT_THAT(tables, HasSubstr("| seen late | 1 | 0 |"));
  EXPECT_THAT(tables, Not(HasSubstr("\nball, 0.1 m:")));  // nothing hit it
}

// The flights of three sets, of which hover's are given.
std::vector<LoadedCampaign> outdoors(const LoadedCampaign& falanga2020,
                                     const LoadedCampaign& dodgesim) {
  const LoadedCampaign one = campaign({thrown(0, true, false)});
  std::vector<LoadedCampaign> campaigns = {falanga2020, dodgesim, one, one, one, one};
  const char* const names[] = {"hover", "goal flight", "several balls"};
  for (std::size_t i = 0; i < campaigns.size(); ++i) campaigns[i].scenario.name = names[i / 2];
  return campaigns;
}

TEST(AvoidanceTables, HaveRowsOfAllSetsTogether) {
  const LoadedCampaign lost = campaign({thrown(0, true, true, "seen late"),    // 4 m/s
                                        thrown(1, true, true, "seen late")});  // 8 m/s
  const LoadedCampaign dodged = campaign({thrown(0, true, false), thrown(1, true, false)});
  const PaperTables tables = outdoor_experiment().analyse(outdoors(lost, dodged));
  EXPECT_THAT(tables.markdown, HasSubstr("\n| hover, 6 to 8 m/s | 0 / 1 ("));
  EXPECT_THAT(tables.markdown, HasSubstr("\n| all sets, to 6 m/s | 2 / 3 ("));
  EXPECT_THAT(tables.markdown, HasSubstr("\n| all sets, 6 to 8 m/s | 0 / 1 ("));
  EXPECT_THAT(tables.markdown, Not(HasSubstr("above 8 m/s")));  // nobody threw so fast
  EXPECT_THAT(tables.csv, HasSubstr("\n\"all sets, all\",\"2 / 4 ("));
  EXPECT_THAT(tables.csv, HasSubstr(",0 / 2,0.5000\n"));
}

TEST(AvoidanceTables, OneSetHasNoRowsOfAllSets) {
  const LoadedCampaign one = campaign({thrown(0, true, false)});
  EXPECT_THAT(indoor_experiment().analyse({one, one}).markdown, Not(HasSubstr("all sets")));
}

TEST(AvoidanceTables, KeepLossesOfPerceptionApartFromWhatTheOracleLosesToo) {
  ThrowResult missed = thrown(0, true, true, "not detected"),
              late = thrown(1, true, true, "seen late");
  late.oracle.hit = true;
  LoadedCampaign lost = campaign({missed, late}), dodged = campaign({missed, late});
  lost.scenario.oracle.range_cap_m = 1.5;
  for (ThrowResult& result : dodged.results) {
    result.flown.hit = false;
    result.cause = "";
  }
  const std::string tables = outdoor_experiment().analyse(outdoors(lost, dodged)).markdown;
  const std::string half = rate_text({1, 2}), none = rate_text({0, 2}), both = rate_text({2, 2});
  EXPECT_THAT(tables, HasSubstr("\n| hover | falanga2020 | " + none + " | 1.5 m | " + half +
                                " | 0.00 (0.00 to 3.84) | " + half + " | 1 not detected | " + half +
                                " | 1 seen late |\n"));
  EXPECT_THAT(tables, HasSubstr("\n| hover | dodgesim | " + both + " | any | " + half +
                                " | 2.00 (0.44 to 9.05) | " + none + " |  | " + none + " |  |\n"));
  EXPECT_THAT(tables,
              HasSubstr("\n| all sets | falanga2020 | " + rate_text({2, 4}) + " | 1.5 m |"));
}

TEST(AvoidanceTables, EveryShapeMeetsThrowsOfItsOwn) {
  std::map<std::string, std::set<std::string>> shapes;  // by the seed of their throws
  for (const PaperFlight& flight : shapes_experiment().flights) {
    std::map<std::string, std::string> settings;
    for (const Setting& setting : flight.settings) settings[setting.key] = setting.value;
    shapes[settings["seed"]].insert(settings["throw.object"]);
  }
  EXPECT_EQ(shapes.size(), 12u);  // tumbling and not
  for (const auto& [seed, objects] : shapes) EXPECT_EQ(objects.size(), 1u) << seed;
}

// The ball comes from ahead, within 1.5 m of the camera at a height above it.
ThrowResult from_height(double height_m, ThrowResult result) {
  result.trajectory = to_bytes(straight_flight({3, 0, 0.075 + height_m}, {-2, 0, 0}, 0.1));
  return result;
}

// Another ball is in view, half a metre ahead of the first.
ThrowResult with_second_ball(ThrowResult result) {
  Trajectory trajectory = trajectory_from_bytes(result.trajectory);
  trajectory.sizes_m.push_back(0.1);
  for (Trajectory::Sample& sample : trajectory.samples) {
    sample.objects.push_back(Eigen::Vector3d(sample.objects[0]->x() - 0.5, 0, 0.075));
  }
  result.trajectory = to_bytes(trajectory);
  return result;
}

// A set flown by the pilot, and by an oracle that dodges nothing.
void add_set(const std::vector<ThrowResult>& results, std::vector<LoadedCampaign>& campaigns) {
  LoadedCampaign flown = campaign(results);
  flown.scenario.oracle.range_cap_m = 1.5;
  for (ThrowResult& result : flown.results) {
    if (result.trajectory.empty()) result = from_height(0, result);
  }
  campaigns.push_back(flown);
  for (ThrowResult& result : flown.results) result.flown.hit = result.none.hit;
  campaigns.push_back(flown);
}

TEST(MoreThrows, AreSplitByWhatIsInViewWithinTheRange) {
  const ThrowResult lost = thrown(0, true, true, "not detected"), dodged = thrown(1, true, false);
  std::vector<LoadedCampaign> campaigns;
  // The view ends at 32 degrees: 0.79 m above the axis at a range of 1.5 m.
  add_set({from_height(0.7, lost), from_height(0.7, dodged), from_height(0.9, lost)}, campaigns);
  add_set({from_height(-0.9, lost), from_height(0, dodged)}, campaigns);
  // Never within 1.5 m; and beside another one that is in view there first.
  add_set({from_height(2, lost), with_second_ball(from_height(0.9, dodged))}, campaigns);
  add_set({lost}, campaigns);
  const std::string table = more_throws_experiment().analyse(campaigns).markdown;
  EXPECT_THAT(table, HasSubstr("\n| in view within 1.5 m | 4 | 4 | 3 / 4 ("));
  EXPECT_THAT(table, HasSubstr("\n| not in view within 1.5 m | 3 | 3 | 0 / 3 ("));
  EXPECT_THAT(table, HasSubstr("\n| all of outdoor.md | 7 | 7 | 3 / 7 ("));
}

TEST(MoreThrows, LeaveOutFlightsThatFailed) {
  std::vector<LoadedCampaign> campaigns;
  for (int i = 0; i < 4; ++i) add_set({thrown(0, true, false), thrown(1, true, true)}, campaigns);
  for (FlightResult ThrowResult::*flight :
       {&ThrowResult::flown, &ThrowResult::none, &ThrowResult::oracle}) {
    std::vector<LoadedCampaign> failed = campaigns;
    ThrowResult& result = failed[0].results[1];
    (result.*flight).status = "error";
    if (flight == &ThrowResult::flown) result.trajectory.clear();  // there is none
    EXPECT_THAT(more_throws_experiment().analyse(failed).markdown,
                HasSubstr("\n| all of outdoor.md | 5 | 5 | 3 / 5 ("));
  }
  campaigns[1].results[1].flown.status = "error";
  EXPECT_THAT(more_throws_experiment().analyse(campaigns).markdown,
              HasSubstr("\n| all of outdoor.md | 5 | 5 | 3 / 5 ("));
}

// A worker that dies takes every flight of its throw with it.
TEST(AvoidanceTables, CountThrowsThatWereLostWithTheirWorker) {
  const LoadedCampaign dodged = campaign({thrown(0, true, false), thrown(1, true, false)});
  LoadedCampaign lost = dodged;
  FlightResult not_flown;
  not_flown.status = "not flown";
  lost.results[1].none = lost.results[1].oracle = not_flown;
  lost.results[1].flown.status = "lost";
  for (const auto& campaigns : {outdoors(lost, dodged), outdoors(dodged, lost)}) {
    const std::string table = outdoor_experiment().analyse(campaigns).markdown;
    EXPECT_THAT(table, HasSubstr("\n| hover, to 6 m/s | 1 / 1 (")) << table;
  }
}

TEST(AvoidanceTables, SayWhichThrowsAreNotTheSame) {
  LoadedCampaign first = campaign({thrown(0, true, false), thrown(1, true, false)});
  LoadedCampaign other = first;
  other.results[1].size_m += 0.01;
  try {
    outdoor_experiment().analyse(outdoors(first, other));
    FAIL() << "different throws were compared";
  } catch (const std::invalid_argument& error) {
    EXPECT_STREQ(error.what(), "Throw 1 of hover and throw 1 of hover are not the same.");
  }
}

TEST(MoreThrows, AreFlownByThePilotAndByAnOracleThatMustSee) {
  const std::vector<PaperFlight> flights = more_throws_experiment().flights;
  ASSERT_EQ(flights.size(), 10u);
  EXPECT_EQ(flights[0].arguments(), "scenarios/paper/outdoor_hover.yaml");
  EXPECT_EQ(flights[1].arguments(),
            "scenarios/paper/outdoor_hover.yaml --set pilot=oracle --set "
            "oracle.field_of_view=true");
  for (std::size_t i = 0; i < flights.size(); i += 2) {
    EXPECT_EQ(flights[i + 1].arguments(),
              flights[i].arguments() + " --set pilot=oracle --set oracle.field_of_view=true");
  }
  EXPECT_EQ(flights.back().scenario, "outdoor_scattered.yaml");
}

TEST(MoreThrows, StandBesideAnOracleThatMustHaveTheBallInView) {
  std::vector<ThrowResult> results;
  for (int i = 0; i < 40; ++i) results.push_back(thrown(i, true, i % 4 != 0));
  std::vector<LoadedCampaign> campaigns;
  for (int i = 0; i < 4; ++i) add_set(results, campaigns);
  for (std::size_t i = 1; i < campaigns.size(); i += 2) {
    for (ThrowResult& result : campaigns[i].results) result.flown.hit = result.index % 2 != 0;
  }
  const std::string table = more_throws_experiment().analyse(campaigns).markdown;
  // The oracle that is told dodges everything, the other one half, the pilot a quarter.
  EXPECT_THAT(table, HasSubstr("| hover, aimed less well | 40 | 40 | " + short_rate_text({10, 40}) +
                               " | " + short_rate_text({40, 40}) + " | 0.25 ("));
  EXPECT_THAT(table, HasSubstr(") | " + short_rate_text({20, 40}) + " | 0.50 ("));
}

TEST(MoreThrows, CountOfAllThrownWhatTheyLeaveUnharmed) {
  const ThrowResult hit = thrown(0, true, true, "seen late"), missed = thrown(1, false, false);
  std::vector<LoadedCampaign> campaigns;
  for (int i = 0; i < 4; ++i) add_set({hit, missed, missed, missed}, campaigns);
  const std::string table = more_throws_experiment().analyse(campaigns).markdown;
  EXPECT_THAT(table, HasSubstr("\n| hover, aimed less well | 4 | 1 | 0 / 1 ("));
  EXPECT_THAT(table, HasSubstr("| 3 / 4 (0.30 to 0.95) |\n"));
}

TEST(AvoidanceTables, AnOracleIsToldOfWhatItsPilotMayBelieve) {
  for (const PaperFlight& flight : outdoor_experiment().flights) {
    const bool second = flight.name.ends_with("_dodgesim");
    EXPECT_EQ(flight.arguments().ends_with(" --set pilot=dodgesim --set oracle.range_cap_m=5"),
              second)
        << flight.arguments();
    EXPECT_EQ(flight.settings.empty(), !second);
  }
}

}  // namespace
}  // namespace dodgesim

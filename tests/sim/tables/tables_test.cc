#include "sim/tables/tables.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/sim/tables/fake_throws.h"

namespace dodgesim {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

ThrowResult throw_with(int index, const FlightResult& pilot, const FlightResult& none,
                       const FlightResult& oracle) {
  ThrowResult result = ball(index, 0.1, 2, 4);
  result.flown = pilot;
  result.none = none;
  result.oracle = oracle;
  result.evaded = none.hit && !pilot.hit;
  return result;
}

Tables tables(const std::vector<ThrowResult>& results, const std::string& pilot = "falanga2020") {
  LoadedCampaign campaign;
  campaign.scenario.pilot = pilot;
  campaign.scenario.name = "test";
  campaign.results = results;
  return make_tables(campaign);
}

TEST(Tables, MarkdownAndCsvAreAsExpected) {
  std::vector<ThrowResult> results;
  results.push_back(throw_with(0, flown(false), flown(true), flown(false)));
  results.push_back(throw_with(1, flown(true), flown(true), flown(false)));
  results[1].size_m = 0.2;
  results[1].cause = "seen late";
  results.push_back(throw_with(2, flown(false), flown(false), flown(false)));
  results[2].evaded = true;
  const Tables made = tables(results);
  EXPECT_EQ(made.markdown, R"(# test

3 throws, pilot falanga2020. Cells: dodged / would have hit (rate, 95 % Wilson interval); for the pilot none: would have hit / throws.

Dodged: 1 / 2 (0.500, 0.095 to 0.905)

## By size and distance

| size | pilot | 2 m | all distances |
|---|---|---|---|
| 0.1 m | falanga2020 | 1 / 1 (1.000, 0.207 to 1.000) | 1 / 1 (1.000, 0.207 to 1.000) |
| 0.1 m | oracle | 1 / 1 (1.000, 0.207 to 1.000) | 1 / 1 (1.000, 0.207 to 1.000) |
| 0.1 m | none: would have hit | 1 / 2 (0.500, 0.095 to 0.905) | 1 / 2 (0.500, 0.095 to 0.905) |
| 0.2 m | falanga2020 | 0 / 1 (0.000, 0.000 to 0.793) | 0 / 1 (0.000, 0.000 to 0.793) |
| 0.2 m | oracle | 1 / 1 (1.000, 0.207 to 1.000) | 1 / 1 (1.000, 0.207 to 1.000) |
| 0.2 m | none: would have hit | 1 / 1 (1.000, 0.207 to 1.000) | 1 / 1 (1.000, 0.207 to 1.000) |
| all | falanga2020 | 1 / 2 (0.500, 0.095 to 0.905) | 1 / 2 (0.500, 0.095 to 0.905) |
| all | oracle | 2 / 2 (1.000, 0.342 to 1.000) | 2 / 2 (1.000, 0.342 to 1.000) |
| all | none: would have hit | 2 / 3 (0.667, 0.208 to 0.939) | 2 / 3 (0.667, 0.208 to 0.939) |

## By speed

| speed | falanga2020 | oracle | none: would have hit |
|---|---|---|---|
| 4 m/s | 1 / 2 (0.500, 0.095 to 0.905) | 2 / 2 (1.000, 0.342 to 1.000) | 2 / 3 (0.667, 0.208 to 0.939) |

## Collisions, detections and latencies

All throws. Median (10 % to 90 % quantile), count.

| size_m | hit or crashed | detected, of those in view | false alarms |
|---|---|---|---|
| 0.1 | 0 / 2 (0.000, 0.000 to 0.658) | 0 / 0 | 0 / 2 (0.000, 0.000 to 0.658) |
| 0.2 | 1 / 1 (1.000, 0.207 to 1.000) | 0 / 0 | 0 / 1 (0.000, 0.000 to 0.793) |
| all | 1 / 3 (0.333, 0.061 to 0.792) | 0 / 0 | 0 / 3 (0.000, 0.000 to 0.561) |

| size_m | detection_distance_m | time_to_contact_s | view_to_detection_s | image_to_detection_s | detection_to_command_s | clearance_m |
|---|---|---|---|---|---|---|
| 0.1 | - | - | - | - | - | 0.25 (0.25 to 0.25), 2 |
| 0.2 | - | - | - | - | - | 0 (0 to 0), 1 |
| all | - | - | - | - | - | 0.25 (0 to 0.25), 3 |

## Why it was hit or crashed

| cause | throws | throw numbers |
|---|---|---|
| seen late | 1 | 1 |

Of 1 throw that would have missed, falanga2020 evaded 1 and was hit by 0.

)");
  EXPECT_THAT(made.csv,
              ::testing::StartsWith("size_m,distance_m,speed_mps,pilot,throws,"
                                    "would_have_hit,dodged,rate,rate_lo,rate_hi,rate_interval,"));
  EXPECT_THAT(made.csv, HasSubstr("\n0.1,2,all,falanga2020,2,1,1,1,"));
  EXPECT_THAT(made.csv, HasSubstr("\nall,all,all,falanga2020,3,2,1,0.5,"));
  EXPECT_THAT(made.csv, HasSubstr("\nall,all,4,none,3,2,0,0,"));
}

TEST(Tables, SayThatTheVehicleCrashesByItself) {
  FlightResult crash = flown(false);
  crash.crashed = true;
  const std::vector<ThrowResult> results = {
      throw_with(0, crash, crash, FlightResult{}),
      throw_with(1, flown(true), flown(true), FlightResult{})};
  EXPECT_THAT(tables(results).markdown,
              HasSubstr("In 1 throw of these the vehicle crashed with nobody dodging"));
}

TEST(Tables, SayWhichObjectsTouchedTheRoomOnTheirWay) {
  std::vector<ThrowResult> results = {throw_with(0, flown(false), flown(false), FlightResult{}),
                                      throw_with(1, flown(true), flown(true), FlightResult{})};
  EXPECT_THAT(tables(results).markdown, ::testing::Not(HasSubstr("touched the room")));
  results[0].none_after_room = true;
  EXPECT_THAT(tables(results).markdown,
              HasSubstr("In 1 throw an object had touched the room when it came nearest"));
}

TEST(Tables, EveryCellOfAGridHasItsRowWhateverTheKeys) {
  std::vector<ThrowResult> results;
  for (int i = 0; i < 8; ++i) {
    results.push_back(throw_with(i, flown(i == 3), flown(true), FlightResult{}));
    results.back().cell_values = {{"throw.bearing_deg", i % 2 == 0 ? "-20" : "20"},
                                  {"delays.command_us", i % 4 < 2 ? "0" : "10000"},
                                  {"throw.size_m", "0.1"}};
  }
  const Tables made = tables(results);
  EXPECT_THAT(made.markdown, HasSubstr("## By cell of the grid\n\n| throw.bearing_deg | "
                                       "delays.command_us | throw.size_m | falanga2020: dodged |"));
  EXPECT_THAT(made.markdown, HasSubstr("\n| -20 | 0 | 0.1 | 2 / 2 (1.000, 0.342 to 1.000) |"));
  EXPECT_THAT(made.markdown, HasSubstr("\n| 20 | 10000 | 0.1 | 1 / 2 (0.500, 0.095 to 0.905) |"));
  EXPECT_THAT(made.csv, ::testing::StartsWith(
                            "size_m,distance_m,speed_mps,throw.bearing_deg,delays.command_us,"));
  EXPECT_THAT(made.csv, HasSubstr("\n0.1,all,all,20,10000,falanga2020,2,2,1,"));
  EXPECT_THAT(made.csv, HasSubstr("\n0.1,2,all,all,all,falanga2020,8,8,7,"));
  EXPECT_THAT(made.csv, HasSubstr("\nall,all,all,all,all,falanga2020,8,8,7,"));
}

TEST(Tables, ACellThatTheOtherTablesShowHasOneRowInTheCsv) {
  std::vector<ThrowResult> results = {throw_with(0, flown(false), flown(true), FlightResult{})};
  results[0].cell_values = {{"throw.distance_m", "2"}};
  const std::string csv = tables(results).csv;
  const std::size_t at = csv.find("\nall,2,all,falanga2020,");
  ASSERT_NE(at, std::string::npos);
  EXPECT_EQ(csv.find("\nall,2,all,falanga2020,", at + 1), std::string::npos);
}

TEST(Tables, WithoutOracleThereIsNoRowOfIt) {
  const Tables made = tables({throw_with(0, flown(false), flown(true), FlightResult{})});
  EXPECT_THAT(made.markdown, ::testing::Not(HasSubstr("oracle")));
}

TEST(Tables, AnOracleIsNotShownBesideItself) {
  const std::vector<ThrowResult> results = {throw_with(0, flown(false), flown(true), flown(false))};
  const ThrowStatistics sum = statistics_of({&results[0]}, "oracle");
  EXPECT_EQ(sum.flown().tally.throws, 1);
  EXPECT_FALSE(sum.oracle_flew);
  EXPECT_TRUE(statistics_of({&results[0]}, "falanga2020").oracle_flew);
}

TEST(Tables, AnOraclesErrorIsNotShownTwice) {
  const FlightResult broken = failed("No context.");
  const std::string markdown =
      tables({throw_with(0, broken, flown(true), broken)}, "oracle").markdown;
  EXPECT_THAT(markdown, HasSubstr("1 flight failed"));
}

TEST(Tables, AThrowThatNobodyCouldFlyIsNamedOnceAndInNoRate) {
  const FlightResult broken = failed("It starts inside another.");
  const Tables made = tables({throw_with(0, broken, broken, broken),
                              throw_with(1, broken, FlightResult{}, FlightResult{}),
                              throw_with(2, flown(false), flown(true), flown(true))});
  EXPECT_THAT(made.markdown, HasSubstr("Dodged: 1 / 1 ("));
  EXPECT_THAT(made.markdown, HasSubstr("| all | falanga2020 | 1 / 1 (1.000, 0.207 to 1.000), 2 "
                                       "errors |"));
  EXPECT_THAT(made.markdown, HasSubstr("| all | oracle | 0 / 1 (0.000, 0.000 to 0.793) |"));
  EXPECT_THAT(made.markdown,
              HasSubstr("| all | none: would have hit | 1 / 1 (1.000, 0.207 to 1.000) |"));
  EXPECT_THAT(made.markdown,
              HasSubstr("## Errors\n\n2 throws could not be flown, whoever the pilot, which no "
                        "rate counts:\n\n- throw 0: It starts inside another.\n- throw 1: It "
                        "starts inside another.\n"));
  EXPECT_THAT(made.csv, HasSubstr("all,all,all,none,1,1,0,"));
}

TEST(Tables, AnOverviewOfASweepHasOneLineForEachValueInPlaceOfItsTables) {
  std::vector<ThrowResult> results = {throw_with(0, flown(false), flown(true), flown(false)),
                                      throw_with(1, flown(true), flown(true), flown(false))};
  EXPECT_EQ(tables(results).overview, tables(results).markdown) << "no sweep";
  for (std::size_t i = 0; i < 2; ++i) {
    results[i].sweep = static_cast<int>(i);
    results[i].sweep_values = {{"delays.compute_us", i == 0 ? "0" : "3500"}};
  }
  const Tables swept = tables(results);
  EXPECT_THAT(swept.markdown, HasSubstr("## By size and distance"));
  EXPECT_THAT(swept.overview, Not(HasSubstr("##")));
  EXPECT_THAT(swept.overview, HasSubstr("\n| 0 | 1 / 1 ("));
  EXPECT_THAT(swept.overview, HasSubstr("\n| 3500 | 0 / 1 ("));
}

TEST(Tables, ShowTheNameAsItIs) {
  LoadedCampaign campaign;
  campaign.scenario.name = "a_b <i>";
  EXPECT_THAT(make_tables(campaign).markdown, HasSubstr("# a_b \\<i\\>\n"));
}

TEST(Tables, ErrorsAreShownWithThrowPilotAndReason) {
  const Tables made =
      tables({throw_with(0, failed("The state diverged."), flown(true), flown(true)),
              throw_with(1, flown(false), flown(true), failed("No context."))});
  EXPECT_THAT(made.markdown, HasSubstr("| 1 / 2 (0.500, 0.095 to 0.905), 1 error |"));
  EXPECT_THAT(made.markdown, HasSubstr("2 flights failed, which is no success:\n\n"
                                       "- throw 0, pilot falanga2020: The state diverged.\n"
                                       "- throw 1, pilot oracle: No context.\n"));
}

TEST(Tables, SayOfHowManyThrowsNobodyKnowsWhetherTheyWouldHaveHit) {
  const FlightResult lost = failed("It took too long.");
  const std::string markdown = tables({throw_with(0, flown(true), lost, flown(false)),
                                       throw_with(1, flown(false), flown(true), flown(false))})
                                   .markdown;
  EXPECT_THAT(markdown, HasSubstr("Dodged: 1 / 2 ("));
  EXPECT_THAT(markdown, HasSubstr("Whether 1 throw would have hit is not known, as the flight in "
                                  "which nobody dodges failed or was not flown: counted as "
                                  "if so, and as not dodged."));
}

TEST(Tables, SayHowManyThrowsMissedAVehicleThatOnlyWasElsewhere) {
  std::vector<ThrowResult> results;
  for (int i = 0; i < 3; ++i) {
    results.push_back(throw_with(i, flown(i == 2), flown(true), flown(false)));
  }
  EXPECT_THAT(tables(results).markdown, ::testing::Not(HasSubstr("without an evasion")));
  results[0].evaded = false;
  const std::string markdown = tables(results).markdown;
  EXPECT_THAT(markdown, HasSubstr("Dodged: 2 / 3 ("));
  EXPECT_THAT(markdown, HasSubstr("Of the throws that count as dodged 1 missed falanga2020 without "
                                  "an evasion: it was not where the throw was aimed."));
}

TEST(Tables, LandingsAreNamedWhenThereAreAny) {
  std::vector<ThrowResult> results;
  for (int i = 0; i < 4; ++i) {
    results.push_back(throw_with(i, flown(false), flown(true), FlightResult{}));
  }
  EXPECT_THAT(tables(results).markdown, ::testing::Not(HasSubstr("landing")));
  results[0].landing_us = results[1].landing_us = 1000000;  // the object would have hit at 1.5 s
  results[1].landed_us = 1400000;
  results[2].landing_us = 1600000;
  const std::string markdown = tables(results).markdown;
  EXPECT_THAT(markdown, HasSubstr("Emergency landings: falanga2020 began one in 3 flights and "
                                  "touched down in 1. 2 throws that would have hit came later "
                                  "and count as not dodged.\n"));
  EXPECT_THAT(markdown, HasSubstr("Dodged: 2 / 4 "));
}

TEST(Tables, EvasionsOfQuietFlightsAreFalseAlarms) {
  ThrowResult quiet;
  quiet.flown = flown(false);
  std::vector<ThrowResult> results(4, quiet);
  results[2].evaded = true;
  const Tables made = tables(results);
  EXPECT_THAT(made.markdown, HasSubstr("False alarms: falanga2020 evaded in 1 / 4 (0.250, "));
  EXPECT_THAT(made.markdown, ::testing::Not(HasSubstr("crashed")));
  EXPECT_THAT(made.markdown, ::testing::Not(HasSubstr("By size")));
  EXPECT_THAT(made.markdown, HasSubstr("4 flights, pilot falanga2020.\n"));
}

TEST(Tables, CrashesOfQuietFlightsAreCounted) {
  ThrowResult quiet;
  quiet.flown = flown(false);
  std::vector<ThrowResult> results(4, quiet);
  results[1].flown = flown(false, true);
  const Tables made = tables(results);
  EXPECT_THAT(made.markdown, HasSubstr("nobody threw.\n\nIt crashed in 1 flight of these.\n"));
  EXPECT_THAT(made.csv, HasSubstr(",flights,collisions,"));
  EXPECT_THAT(made.csv, HasSubstr(",4,1,0.25,"));
}

TEST(Tables, AFlightOfThePilotNoneFailsOnceOnly) {
  const FlightResult diverged = failed("diverged");
  ThrowResult result = throw_with(0, diverged, diverged, FlightResult{});
  const Tables made = tables({result}, "none");
  EXPECT_THAT(made.markdown, HasSubstr("1 throw could not be flown"));
  EXPECT_THAT(made.markdown, HasSubstr("1 error |"));
  const std::string row = "\nall,all,all,none,";
  EXPECT_THAT(made.csv, HasSubstr(row));
  EXPECT_EQ(made.csv.find(row), made.csv.rfind(row)) << "and has one row";
}

TEST(Tables, SayWhatTheReadoutLostOnceItMatters) {
  std::vector<ThrowResult> results = {
      throw_with(0, flown(true), flown(true), flown(false)),
      throw_with(1, flown(true), flown(true), flown(false)),
  };
  results[0].events = {600, 0};
  results[1].events = {0, 400};
  results[1].events_lost = {4, 5};
  EXPECT_THAT(tables(results).markdown, Not(HasSubstr("readout")));
  results[1].events_lost = {800, 200};
  EXPECT_THAT(tables(results).markdown,
              HasSubstr("The readout of the event cameras lost 50 % of their events"));
}

}  // namespace
}  // namespace dodgesim

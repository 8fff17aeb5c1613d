#include "sim/tables/throw_statistics.h"

#include <gtest/gtest.h>

#include "tests/sim/tables/fake_throws.h"

namespace dodgesim {
namespace {

ThrowResult result_of(const FlightResult& flight, const FlightResult& none) {
  ThrowResult result;
  result.flown = flight;
  result.none = none;
  return result;
}

TEST(Tally, OnlyAnUnharmedFlightThroughADangerousThrowIsADodge) {
  Tally sum;
  sum.add(result_of(flown(false), flown(true)));        // dodged
  sum.add(result_of(flown(true), flown(true)));         // hit
  sum.add(result_of(flown(false, true), flown(true)));  // dodged into the wall
  sum.add(result_of(flown(false), flown(false)));       // would have missed
  EXPECT_EQ(sum.throws, 4);
  EXPECT_EQ(sum.would_have_hit, 3);
  EXPECT_EQ(sum.dodged, 1);
  EXPECT_EQ(sum.errors, 0);
}

TEST(Tally, AThrowThatThePilotGaveUpOnIsNoDodgeButCounts) {
  Tally sum;
  for (const bool would_hit : {true, false}) {
    ThrowResult landed = result_of(flown(false), flown(would_hit));
    landed.landing_us = 1;
    sum.add(landed);
  }
  EXPECT_EQ(sum.throws, 2);
  EXPECT_EQ(sum.would_have_hit, 1);
  EXPECT_EQ(sum.dodged, 0);
  EXPECT_EQ(sum.collisions.count, 0);
}

TEST(Tally, AnErrorNeverCountsAsASuccess) {
  Tally sum;
  sum.add(result_of(failed("diverged"), flown(true)));
  sum.add(result_of(flown(false), failed("diverged")));  // nobody knows whether it would have hit
  sum.add(result_of(failed("worker died"), FlightResult{}));  // nor here
  sum.add(result_of(FlightResult{}, flown(true)));            // not asked for: not judged
  sum.add(result_of(failed("diverged"), flown(false)));  // would have missed: no chance to dodge
  EXPECT_EQ(sum.throws, 4);
  EXPECT_EQ(sum.would_have_hit, 3);
  EXPECT_EQ(sum.dodged, 0);
  EXPECT_EQ(sum.errors, 4);
  EXPECT_EQ(rate_text(sum.shown(Role::kNone)), rate_text({1, 2}));  // of what is known
}

// One denominator for all pilots.
TEST(Tally, AThrowThatNobodyCouldFlyIsAnErrorAndInNoRate) {
  ThrowResult impossible = ball(0, 0.2, 3, 6), diverged = ball(1, 0.2, 3, 6);
  impossible.flown = failed("behind a wall");
  diverged.flown = diverged.none = diverged.oracle = failed("inside the floor");
  for (const ThrowResult& result : {impossible, diverged}) {
    EXPECT_TRUE(result.nobody_could_fly());
    Tally pilot, oracle, none;
    pilot.add(result);
    oracle.add(result, &ThrowResult::oracle);
    none.add(result, &ThrowResult::none);
    EXPECT_EQ(pilot.errors, 1);
    for (const Tally& sum : {oracle, none}) EXPECT_EQ(sum.errors, 0);
    for (const Tally& sum : {pilot, oracle, none}) {
      EXPECT_EQ(sum.throws, 0);
      EXPECT_EQ(sum.would_have_hit, 0);
      EXPECT_EQ(sum.collisions.of, 0);
    }
    EXPECT_EQ(failed_flights(result, "falanga2020").size(), 1u);
  }
}

TEST(Tally, AThrowThatOnlyThePilotFailedCountsAgainstIt) {
  ThrowResult crashed = ball(0, 0.2, 3, 6), lost = crashed, quiet;
  crashed.flown = failed("the plugin threw an exception");
  crashed.none = flown(true);
  lost.flown = failed("out of memory");
  lost.flown.status = "lost";
  quiet.flown = failed("diverged");
  for (const ThrowResult& result : {crashed, lost}) {
    EXPECT_FALSE(result.nobody_could_fly());
    Tally sum;
    sum.add(result);
    EXPECT_EQ(sum.would_have_hit, 1);
    EXPECT_EQ(sum.errors, 1);
  }
  EXPECT_FALSE(quiet.nobody_could_fly());
}

TEST(Tally, CollisionsAreCountedOverAllFlightsThatDidNotFail) {
  Tally sum;
  sum.add(result_of(flown(true), flown(false)));  // would have missed, walked into
  sum.add(result_of(flown(false, true), flown(true)));
  sum.add(result_of(flown(false), failed("diverged")));
  sum.add(result_of(failed("diverged"), flown(true)));
  EXPECT_EQ(sum.collisions.count, 2);
  EXPECT_EQ(sum.collisions.of, 3);
}

TEST(Rate, CarriesItsCountAndInterval) {
  EXPECT_EQ(rate_text({92, 100}), "92 / 100 (0.920, 0.850 to 0.959)");
  EXPECT_EQ(rate_text({0, 0}), "0 / 0");
}

ThrowStatistics statistics(const std::vector<ThrowResult>& results) {
  return statistics_of(parts_of(results, "falanga2020").front().results, "falanga2020");
}

TEST(ThrowStatistics, ALandingBeforeTheObjectCameIsNoDodgeOneAfterItIs) {
  ThrowResult before = ball(0, 0.2, 3, 6), after = ball(1, 0.2, 3, 6);
  for (ThrowResult* result : {&before, &after}) {
    result->flown = result->oracle = flown(false);
    result->none = flown(true);  // at 1.5 s
  }
  before.landing_us = 1499750;
  after.landing_us = 1500000;
  EXPECT_TRUE(before.gave_up());
  EXPECT_FALSE(after.gave_up());
  const ThrowStatistics sum = statistics({before, after});
  EXPECT_EQ(sum.flown().tally.dodged, 1);
  EXPECT_EQ(sum.flown().tally.would_have_hit, 2);
  EXPECT_EQ(sum.by(Role::kOracle).tally.dodged, 2) << "it is the flown pilot that landed";
}

// Seen at 1.0 s, detected at 1.2 s from an image of 1.185 s, evaded at 1.21 s.
ThrowResult detected(int index) {
  ThrowResult result = ball(index, 0.2, 3, 6);
  result.flown = flown(false);
  result.none = flown(true);
  result.first_in_view_us = 1000000;
  result.first_detection_t_us = 1185000;
  result.first_detection_us = 1200000;
  result.first_detection_distance_m = 1.5;
  result.time_to_contact_us = 250000;
  result.first_command_us = 1210000;
  result.evaded = true;
  return result;
}

TEST(ThrowStatistics, MeasureTheChainFromViewToCommand) {
  const std::vector<ThrowResult> results = {detected(0), detected(1)};
  const ThrowStatistics sum = statistics(results);
  const auto median = [](const Measured& sample) { return sample.quantile(0.5)->value; };
  EXPECT_DOUBLE_EQ(median(sum.view_to_detection_s), 0.2);
  EXPECT_DOUBLE_EQ(median(sum.image_to_detection_s), 0.015);
  EXPECT_DOUBLE_EQ(median(sum.detection_to_command_s), 0.01);
  EXPECT_DOUBLE_EQ(median(sum.time_to_contact_s), 0.25);
  EXPECT_DOUBLE_EQ(median(sum.detection_distance_m), 1.5);
  EXPECT_DOUBLE_EQ(median(sum.flown().clearance_m), 0.25);
}

TEST(ThrowStatistics, DetectionsAreCountedOfThrowsThatCameIntoView) {
  std::vector<ThrowResult> results = {detected(0), detected(1), detected(2)};
  results[1].first_detection_us.reset();
  results[2].first_in_view_us.reset();
  results[2].first_detection_us.reset();
  const ThrowStatistics sum = statistics(results);
  EXPECT_EQ(sum.detected.count, 1);
  EXPECT_EQ(sum.detected.of, 2);
}

TEST(ThrowStatistics, TheOracleIsNotBlamedForDetectingNothing) {
  std::vector<ThrowResult> results = {detected(0)};
  results[0].first_detection_us.reset();
  EXPECT_EQ(statistics_of({&results[0]}, "oracle").detected.of, 0);
}

TEST(ThrowStatistics, AFalseAlarmIsNoAnswerToTheDetectionThatFollows) {
  std::vector<ThrowResult> results = {detected(0)};
  results[0].first_command_us = 900000;
  results[0].false_alarm = true;
  const ThrowStatistics sum = statistics(results);
  EXPECT_EQ(sum.false_alarms.count, 1);
  EXPECT_EQ(sum.detection_to_command_s.count(), 0u);
}

TEST(Parts, ValuesOfASweepAreNeverPooled) {
  std::vector<ThrowResult> results = {detected(0), detected(1), detected(2)};
  results[1].sweep = 1;
  results[1].sweep_values = {{"pilot", "oracle"}};
  const std::vector<Part> parts = parts_of(results, "falanga2020");
  ASSERT_EQ(parts.size(), 2u);
  EXPECT_EQ(parts[0].results.size(), 2u);
  EXPECT_EQ(parts[0].pilot, "falanga2020");
  EXPECT_EQ(parts[1].results.front()->index, 1);
  EXPECT_EQ(parts[1].pilot, "oracle");  // the sweep says who flew
}

TEST(ThrowStatistics, FailedFlightsSayNothingOfThePilot) {
  std::vector<ThrowResult> results = {detected(0)};
  results[0].flown = failed("diverged");
  results[0].cause = "seen late";
  const ThrowStatistics sum = statistics(results);
  EXPECT_EQ(sum.detected.of, 0);
  EXPECT_EQ(sum.false_alarms.of, 0);
  EXPECT_TRUE(sum.causes.empty());
  EXPECT_EQ(sum.flown().tally.errors, 1);
  EXPECT_FALSE(sum.flown().clearance_m.quantile(0.5));
}

TEST(ThrowStatistics, FailedFlightsInWhichNobodyThrewAreErrors) {
  std::vector<ThrowResult> results(2);
  results[0].flown = flown(false);
  results[1].flown = failed("diverged");
  const ThrowStatistics sum = statistics(results);
  EXPECT_EQ(sum.flown().tally.errors, 1);
  EXPECT_EQ(sum.flown().tally.collisions.of, 1);
  EXPECT_EQ(sum.flown().tally.throws, 0);
}

}  // namespace
}  // namespace dodgesim

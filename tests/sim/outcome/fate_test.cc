#include "sim/outcome/fate.h"

#include <gtest/gtest.h>

#include <set>

#include "tests/sim/tables/fake_throws.h"

namespace dodgesim {
namespace {

ThrowResult throw_of(const FlightResult& by_pilot, const FlightResult& by_nobody) {
  ThrowResult result = ball(0, 0.2, 3, 6);
  result.flown = by_pilot;
  result.none = by_nobody;
  return result;
}

ThrowResult quiet_flight(bool evaded) {
  ThrowResult result;
  result.flown = flown(false);
  result.evaded = evaded;
  return result;
}

TEST(Fate, OfThrowsThatWouldHaveHitAndOfThoseThatWouldNot) {
  EXPECT_EQ(fate_of(throw_of(flown(false), flown(true))), Fate::kDodged);
  EXPECT_EQ(fate_of(throw_of(flown(false), flown(false))), Fate::kWouldHaveMissed);
  EXPECT_EQ(fate_of(throw_of(flown(true), flown(true))), Fate::kHit);
  EXPECT_EQ(fate_of(throw_of(flown(true), flown(false))), Fate::kHit) << "it walked into it";
  EXPECT_EQ(fate_of(throw_of(flown(false, true), flown(true))), Fate::kCrashed);
  EXPECT_EQ(fate_of(throw_of(flown(true, true), flown(true))), Fate::kHit) << "what comes first";
}

TEST(Fate, OfFlightsInWhichNobodyThrew) {
  EXPECT_EQ(fate_of(quiet_flight(false)), Fate::kQuiet);
  EXPECT_EQ(fate_of(quiet_flight(true)), Fate::kFalseAlarm);
  ThrowResult crashed = quiet_flight(true);
  crashed.flown.crashed = true;
  EXPECT_EQ(fate_of(crashed), Fate::kCrashed);
}

TEST(Fate, ALandingThatBeganBeforeTheObjectCameIsNoDodge) {
  ThrowResult result = throw_of(flown(false), flown(true));  // at 1.5 s
  result.landing_us = 1499750;
  EXPECT_EQ(fate_of(result), Fate::kLanded);
  result.landing_us = 1500000;
  EXPECT_EQ(fate_of(result), Fate::kDodged);
  result.flown = flown(true);
  result.landing_us = 1499750;
  EXPECT_EQ(fate_of(result), Fate::kHit);
  ThrowResult quiet = quiet_flight(true);
  quiet.landing_us = 1000000;
  EXPECT_EQ(fate_of(quiet), Fate::kLanded);
}

TEST(Fate, OfFlightsThatFailed) {
  EXPECT_EQ(fate_of(throw_of(failed("diverged"), flown(true))), Fate::kFailed);
  EXPECT_EQ(fate_of(throw_of(flown(false), failed("diverged"))), Fate::kNotJudged);
  EXPECT_EQ(fate_of(throw_of(flown(true), failed("diverged"))), Fate::kHit);
  ThrowResult nobody = throw_of(failed("behind a wall"), FlightResult());
  EXPECT_EQ(fate_of(nobody), Fate::kNotFlown);
  nobody.flown.status = "lost";
  EXPECT_EQ(fate_of(nobody), Fate::kFailed) << "with its worker, which need not happen again";
  ThrowResult quiet = quiet_flight(false);
  quiet.flown = failed("diverged");
  EXPECT_EQ(fate_of(quiet), Fate::kFailed);
}

// "Dodged" is one thing in tables and in the report.
TEST(Fate, IsDodgedWhereTheTallyCountsADodge) {
  const FlightResult flights[] = {flown(false), flown(true), flown(false, true), failed("diverged"),
                                  FlightResult()};
  for (const FlightResult& by_pilot : flights) {
    for (const FlightResult& by_nobody : flights) {
      const ThrowResult result = throw_of(by_pilot, by_nobody);
      EXPECT_EQ(fate_of(result) == Fate::kDodged, result.dodged());
    }
  }
}

TEST(Fate, HasANameEach) {
  std::set<std::string> names;
  for (std::size_t i = 0; i < kFates.size(); ++i) {
    EXPECT_EQ(static_cast<std::size_t>(kFates[i]), i) << "the report counts so";
    names.insert(to_text(kFates[i]));
  }
  EXPECT_EQ(names.size(), kFates.size());
}

}  // namespace
}  // namespace dodgesim

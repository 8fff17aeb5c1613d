#include "sim/paper/losses.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>

#include "tests/sim/paper/synthetic_campaign.h"

namespace dodgesim {
namespace {

ThrowResult with_oracle(ThrowResult result, bool hit) {
  result.oracle.hit = hit;
  return result;
}

TEST(Losses, HoldEveryThrowAgainstTheOracle) {
  Losses losses;
  losses.add(with_oracle(thrown(0, true, false), false));
  losses.add(with_oracle(thrown(1, true, false), true));  // luckier than its oracle
  losses.add(with_oracle(thrown(2, true, true, "not detected"), false));
  losses.add(with_oracle(thrown(3, true, true, "not detected"), false));
  losses.add(with_oracle(thrown(4, true, true, "seen late"), false));
  losses.add(with_oracle(thrown(5, true, true, "seen late"), true));
  EXPECT_EQ(rate_text(losses.dodged()), rate_text({2, 6}));
  EXPECT_EQ(rate_text(losses.dodged_by_oracle()), rate_text({4, 6}));
  EXPECT_EQ(rate_text(losses.lost_to_perception()), rate_text({3, 6}));
  EXPECT_EQ(rate_text(losses.lost_with_oracle()), rate_text({1, 6}));
  EXPECT_EQ(losses.perception.at("not detected"), 2);
  EXPECT_EQ(losses.perception.at("seen late"), 1);
  EXPECT_EQ(losses.with_oracle, (std::map<std::string, int>{{"seen late", 1}}));
}

TEST(Losses, LeaveOutWhatWouldHaveMissedAndWhatFailed) {
  Losses losses;
  losses.add(thrown(0, false, true, "wrong direction"));
  for (FlightResult ThrowResult::*flight :
       {&ThrowResult::flown, &ThrowResult::none, &ThrowResult::oracle}) {
    ThrowResult result = thrown(1, true, true, "seen late");
    (result.*flight).status = "error";
    losses.add(result);
    (result.*flight).status = "not flown";
    losses.add(result);
  }
  EXPECT_EQ(losses.counts.total(), 0);
}

TEST(Losses, CanBeHeldAgainstAnotherOracle) {
  const ThrowResult lost = with_oracle(thrown(0, true, true, "seen late"), false);
  ThrowResult failed = thrown(0, true, false);
  failed.flown.status = "error";
  Losses losses;
  losses.add(lost, thrown(0, true, false));
  losses.add(lost, thrown(0, true, true));
  losses.add(lost, failed);
  EXPECT_EQ(rate_text(losses.dodged_by_oracle()), rate_text({1, 2}));
  EXPECT_EQ(rate_text(losses.lost_to_perception()), rate_text({1, 2}));
}

TEST(Losses, TheRatioToTheOracleHasAnIntervalOverThrows) {
  Losses losses;
  losses.counts = {40, 10, 5, 45};  // both, only the oracle, only the pilot, neither
  const std::string text = ratio_text(losses);
  double ratio = 0, low = 0, high = 0;
  ASSERT_EQ(std::sscanf(text.c_str(), "%lf (%lf to %lf)", &ratio, &low, &high), 3) << text;
  EXPECT_DOUBLE_EQ(ratio, 0.9);
  // Delta method: the logarithm's variance is (10 + 5) / (45 * 50).
  const double sd = std::sqrt(15.0 / (45 * 50));
  EXPECT_NEAR(low, 0.9 * std::exp(-1.96 * sd), 0.03);
  EXPECT_NEAR(high, 0.9 * std::exp(1.96 * sd), 0.03);
}

TEST(Losses, TheRatioHasAnIntervalAlsoWhereNothingDiffers) {
  Losses losses;
  losses.counts = {80, 0, 0, 0};
  EXPECT_EQ(ratio_text(losses), "1.00 (0.98 to 1.02)");
  losses.counts = {0, 13, 0, 7};
  EXPECT_EQ(ratio_text(losses), "0.00 (0.00 to 0.30)");
}

TEST(Losses, AnOracleThatDodgesNothingGivesNoRatio) {
  Losses losses;
  EXPECT_EQ(ratio_text(losses), "-");
  losses.counts = {0, 0, 3, 10};
  EXPECT_EQ(ratio_text(losses), "-");
}

TEST(Losses, WhoLandedBeforeTheObjectCameHasLostUnharmed) {
  ThrowResult landed = thrown(0, true, false);
  landed.landing_us = 1;
  Losses losses;
  losses.add(landed);
  EXPECT_EQ(losses.lost_to_perception().count, 1);
  EXPECT_EQ(losses.perception.at("landed before"), 1);
}

}  // namespace
}  // namespace dodgesim

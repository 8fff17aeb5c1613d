#include "sim/paper/losses.h"

#include <gtest/gtest.h>

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
  EXPECT_EQ(rate_text(losses.lost_to_actuation()), rate_text({1, 6}));
  EXPECT_EQ(losses.perception.at("not detected"), 2);
  EXPECT_EQ(losses.perception.at("seen late"), 1);
  EXPECT_EQ(losses.actuation, (std::map<std::string, int>{{"seen late", 1}}));
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

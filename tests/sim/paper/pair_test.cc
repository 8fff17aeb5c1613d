#include "sim/paper/pair.h"

#include <gtest/gtest.h>

#include <functional>
#include <stdexcept>

#include "tests/sim/paper/synthetic_campaign.h"
#include "tests/sim/tables/fake_throws.h"

namespace dodgesim {
namespace {

bool all(const ThrowResult&) { return true; }

PilotPair compare_pilots(const LoadedCampaign& first, const LoadedCampaign& second,
                         const std::function<bool(const ThrowResult&)>& belongs) {
  PilotPair pair;
  pair.add(first, second, belongs);
  return pair;
}

TEST(PilotPair, CountsTheThrowsThatWouldHaveHitPairwise) {
  const LoadedCampaign first =
      campaign({thrown(0, true, true, "seen late"), thrown(1, true, true, "seen late"),
                thrown(2, true, false), thrown(3, false, false)});
  const LoadedCampaign second =
      campaign({thrown(0, true, false), thrown(1, true, true, "wrong position"),
                thrown(2, true, false), thrown(3, false, true, "wrong direction")});
  const PilotPair pair = compare_pilots(first, second, all);
  EXPECT_EQ(pair.paired.only_second, 1);
  EXPECT_EQ(pair.paired.only_first, 0);
  EXPECT_EQ(pair.paired.both, 1);
  EXPECT_EQ(pair.paired.neither, 1);
  EXPECT_EQ(pair.first.success().count, 1);
  EXPECT_EQ(pair.first.success().of, 3);
  EXPECT_EQ(pair.second.success().count, 2);
  EXPECT_EQ(pair.first_causes.at("seen late"), 2);
  EXPECT_EQ(pair.second_causes.at("wrong direction"), 1);
}

void expect_rates_of_the_pairs(const PilotPair& pair, int throws) {
  EXPECT_EQ(pair.first.success().of, throws);
  EXPECT_EQ(pair.second.success().of, throws);
  EXPECT_EQ(pair.paired.total(), throws);
  EXPECT_EQ(pair.first.success().count, pair.paired.both + pair.paired.only_first);
  EXPECT_EQ(pair.second.success().count, pair.paired.both + pair.paired.only_second);
}

TEST(PilotPair, CountsTheSameThrowsInRatesAndPairsWhereOneIsNotJudged) {
  ThrowResult unjudged_hit = thrown(0, false, false), unjudged_miss = thrown(1, false, false),
              unjudged = thrown(2, false, false);
  for (ThrowResult* result : {&unjudged_hit, &unjudged_miss, &unjudged}) {
    result->none = failed("diverged");
  }
  const LoadedCampaign first = campaign({unjudged_hit, unjudged_miss, unjudged});
  const LoadedCampaign second =
      campaign({thrown(0, true, false), thrown(1, false, false), unjudged});
  const PilotPair pair = compare_pilots(first, second, all);
  expect_rates_of_the_pairs(pair, 2);
  EXPECT_EQ(pair.paired.both, 1) << "the second one's flight without a pilot tells";
  EXPECT_EQ(pair.paired.neither, 1) << "nobody knows whether it would have hit";
  expect_rates_of_the_pairs(compare_pilots(second, first, all), 2);
}

TEST(PilotPair, CountsNoThrowThatOnlyOneOfThemCouldHaveFlown) {
  ThrowResult of_nobody = thrown(0, true, false), unjudged = of_nobody;
  unjudged.none = failed("diverged");
  of_nobody.flown = of_nobody.none = of_nobody.oracle = failed("diverged");
  const PilotPair pair = compare_pilots(campaign({of_nobody, thrown(1, true, false)}),
                                        campaign({unjudged, thrown(1, true, true)}), all);
  expect_rates_of_the_pairs(pair, 1);
  EXPECT_EQ(pair.first.errors, 1);
  EXPECT_EQ(pair.second.errors, 1);
}

TEST(PilotPair, CountsOnlyWhatBelongs) {
  const LoadedCampaign flown = campaign({thrown(0, true, true), thrown(1, true, false)});
  const PilotPair fast =
      compare_pilots(flown, flown, [](const ThrowResult& r) { return r.speed_mps > 5; });
  EXPECT_EQ(fast.first.success().of, 1);
  EXPECT_EQ(fast.first.success().count, 1);
}

TEST(PilotPair, CountsOneSetAfterTheOther) {
  const LoadedCampaign lost = campaign({thrown(0, true, true, "seen late")});
  const LoadedCampaign dodged = campaign({thrown(0, true, false)});
  PilotPair pair;
  pair.add(lost, dodged, all);
  pair.add(dodged, dodged, all);
  EXPECT_EQ(pair.first.success().count, 1);
  EXPECT_EQ(pair.second.success().count, 2);
  EXPECT_EQ(pair.paired.both, 1);
  EXPECT_EQ(pair.paired.only_second, 1);
  EXPECT_EQ(pair.first_causes.at("seen late"), 1);
}

TEST(PilotPair, RefusesPilotsThatFlewOtherThrows) {
  const LoadedCampaign flown = campaign({thrown(0, true, true)});
  LoadedCampaign other = flown;
  other.results[0].speed_mps = 5;
  EXPECT_THROW(compare_pilots(flown, other, all), std::invalid_argument);
  EXPECT_THROW(compare_pilots(flown, campaign({}), all), std::invalid_argument);
}

}  // namespace
}  // namespace dodgesim

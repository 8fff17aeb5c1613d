#include "sim/gate/gate.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <stdexcept>

#include "tests/sim/gate/outcomes_fixture.h"

namespace dodgesim {
namespace {

using ::testing::HasSubstr;
using testing::tables_of;
using testing::throw_that;

Baseline baseline_of(const std::string& outcomes) {
  return {tables_of(outcomes), "", GateRules{}, "abc", "one kind"};
}

GateVerdict judged(const std::string& before, const std::string& after,
                   const GateRules& rules = {}) {
  return judge(baseline_of(before), tables_of(after), "one kind", rules);
}

const GateCheck& check(const GateVerdict& verdict, const std::string& name) {
  for (const GateCheck& c : verdict.checks) {
    if (c.name == name) return c;
  }
  throw std::logic_error("no check " + name);
}

TEST(Gate, PassesUnchangedThrows) {
  EXPECT_TRUE(judged("ddhd", "ddhd").passed());
  EXPECT_TRUE(judged("ddhd", "ddhd", {0, 0.95, "all"}).passed());
}

TEST(Gate, FailsWhenTheRateFellByMoreThanTheMargin) {
  const std::string good(40, 'd');
  std::string bad = good;
  bad.replace(0, 10, std::string(10, 'h'));
  const GateVerdict verdict = judged(good, bad);
  EXPECT_FALSE(verdict.passed());
  EXPECT_EQ(check(verdict, "success rate").result, GateCheck::Result::kFailed);
  EXPECT_THAT(
      check(verdict, "success rate").reason,
      HasSubstr("fell by 0.250, with a confidence of 0.95 by more than the margin of 0.05 "));
  EXPECT_TRUE(judged(good, bad, {0.3, 0.95, "nothing"}).passed()) << "within a margin of 0.3";
  EXPECT_TRUE(judged(bad, good).passed()) << "to become better is no failure";
}

TEST(Gate, DoesNotFailByChance) {
  const std::string good(40, 'd');
  std::string one_lost = good;
  one_lost[7] = 'h';
  const GateVerdict verdict = judged(good, one_lost);
  EXPECT_TRUE(verdict.passed());
  EXPECT_EQ(verdict.comparison.lost.size(), 1U);
}

TEST(Gate, FailsWhenItCouldNeverFail) {
  const GateRules rate_only{0.05, 0.95, "nothing"};
  const GateVerdict few = judged("dd", "dd", rate_only);
  EXPECT_EQ(check(few, "enough throws").result, GateCheck::Result::kFailed);
  EXPECT_FALSE(judged("mmm", "mmm").passed()) << "nothing would have hit";
  EXPECT_TRUE(judged("dd", "dd").passed()) << "the bytes can fail";
  EXPECT_FALSE(judge(baseline_of("dd"), tables_of({throw_that(0, 'd'), throw_that(1, 'd')}),
                     "another kind", GateRules{})
                   .passed())
      << "the bytes are not compared";
}

TEST(Gate, SaysHowManyLossesItTakes) {
  const std::string good(60, 'd');
  const std::string reason = check(judged(good, good), "enough throws").reason;
  EXPECT_THAT(reason, HasSubstr("with 60 throws the success rate fails from "));
  const int needed = std::stoi(reason.substr(reason.find("from ") + 5));
  const auto with_lost = [&](int lost) {
    std::string bad = good;
    std::fill_n(bad.begin(), lost, 'h');
    return judged(good, bad, {0.05, 0.95, "nothing"}).passed();
  };
  EXPECT_TRUE(with_lost(needed - 1));
  EXPECT_FALSE(with_lost(needed));
  EXPECT_THAT(reason, HasSubstr(" lost on if none is gained"));
}

TEST(Gate, NeedsMoreLossesWhereThrowsAreGained) {
  std::string before(60, 'd'), after = before;
  std::fill_n(after.begin(), 9, 'h');
  EXPECT_FALSE(judged(before, after, {0.05, 0.95, "nothing"}).passed());
  before.back() = 'h';
  EXPECT_TRUE(judged(before, after, {0.05, 0.95, "nothing"}).passed());
}

TEST(Gate, FailsForOtherThrows) {
  ThrowResult other = throw_that(0, 'd');
  other.bearing_deg = 10;
  const GateVerdict verdict =
      judge(baseline_of("d"), tables_of({other}), "one kind", {0.05, 0.95, "nothing"});
  EXPECT_THAT(check(verdict, "same throws").reason, HasSubstr("not the baseline's throws"));
  EXPECT_FALSE(verdict.passed());
}

TEST(Gate, FailsForOtherThrowsOfOneSeed) {
  const std::string good(40, 'd');
  Baseline before = baseline_of(good);
  std::vector<ThrowResult> others;
  for (int i = 0; i < 40; ++i) others.push_back(throw_that(i, 'd'));
  others[7].size_m += 0.1;
  CampaignTables after = tables_of(others);
  before.tables.seed = after.seed = 3;
  const GateVerdict verdict = judge(before, after, "another kind", {0.05, 0.95, "nothing"});
  EXPECT_EQ(check(verdict, "success rate").result, GateCheck::Result::kPassed);
  EXPECT_THAT(check(verdict, "same throws").reason,
              HasSubstr("these are not the baseline's throws"));
  EXPECT_FALSE(verdict.passed());
}

TEST(Gate, LetsNoThrowEscape) {
  const std::string good(40, 'd');
  const auto reason = [&](const std::string& after) {
    const GateVerdict verdict = judged(good, after, {0.3, 0.95, "nothing"});
    EXPECT_EQ(check(verdict, "success rate").result, GateCheck::Result::kPassed);
    return check(verdict, "same throws").result == GateCheck::Result::kFailed
               ? check(verdict, "same throws").reason
               : "passed";
  };
  EXPECT_EQ(reason(good), "passed");
  EXPECT_THAT(reason(good.substr(2)), HasSubstr("of the baseline only: 38, 39"));
  EXPECT_THAT(reason(good + "d"), HasSubstr("of this campaign only: 40"));
  std::string missed = good;
  missed[3] = 'm';
  EXPECT_THAT(
      reason(missed),
      HasSubstr(
          "throws that would have missed, or that nobody could fly, in one of the two only: 3"));
  EXPECT_FALSE(judged(good, good.substr(2), {0.3, 0.95, "all"}).passed());

  std::vector<ThrowResult> grazed;
  for (int i = 0; i < 40; ++i) grazed.push_back(throw_that(i, i == 3 ? 'm' : 'd'));
  const GateVerdict elsewhere =
      judge(baseline_of(good), tables_of(grazed), "another kind", {0.05, 0.95, "all"});
  EXPECT_TRUE(elsewhere.passed());
  EXPECT_THAT(check(elsewhere, "same throws").reason, HasSubstr("in one of the two only: 3"));
}

TEST(Gate, FailsWhenAThrowCouldNotBeFlown) {
  const GateVerdict verdict = judged("dd", "de");
  EXPECT_FALSE(verdict.passed());
  EXPECT_THAT(check(verdict, "every throw was flown").reason, HasSubstr("1 (flown: killed"));
}

TEST(Gate, HoldsTheBytesThatMustNotChange) {
  std::vector<ThrowResult> flown;
  for (int i = 0; i < 20; ++i) flown.push_back(throw_that(i, 'd'));
  flown[1].events_hash = 5;
  const Baseline before = baseline_of(std::string(20, 'd'));
  const auto passed = [&](const char* must_equal) {
    return judge(before, tables_of(flown), "one kind", {0.05, 0.95, must_equal}).passed();
  };
  EXPECT_TRUE(passed("nothing"));
  EXPECT_TRUE(passed("physics")) << "what the sensor sees is no physics of the throw";
  EXPECT_FALSE(passed("all"));
  flown[1].none.clearance_m = 1e-9;
  EXPECT_TRUE(passed("nothing"));
  EXPECT_FALSE(passed("physics"));
}

TEST(Gate, AColumnThatHasGoneOrComeIsAChange) {
  const ThrowResult plain = throw_that(0, 'd');
  ThrowResult of_grid = plain;
  of_grid.cell_values = {{"delays.compute_us", "0"}};
  const auto reason = [](const ThrowResult& before, const ThrowResult& after,
                         const char* must_equal) {
    const Baseline baseline = {tables_of({before}), "", GateRules{}, "abc", "one kind"};
    const GateVerdict verdict =
        judge(baseline, tables_of({after}), "one kind", {0.05, 0.95, must_equal});
    return check(verdict,
                 must_equal == std::string("all") ? "same bytes" : "same bytes of the physics")
        .reason;
  };
  EXPECT_THAT(reason(of_grid, plain, "all"), HasSubstr("had a column delays.compute_us"));
  EXPECT_THAT(reason(plain, of_grid, "all"), HasSubstr("had no column delays.compute_us"));
  EXPECT_EQ(reason(of_grid, plain, "physics"), "");
}

TEST(Gate, HoldsTheBytesOfEveryObject) {
  ThrowResult flown = throw_that(0, 'd');
  flown.object_rows.resize(1);
  const Baseline before = {tables_of({flown}), "", GateRules{}, "abc", "one kind"};
  const auto passed = [&](const char* must_equal) {
    return judge(before, tables_of({flown}), "one kind", {0.05, 0.95, must_equal}).passed();
  };
  flown.object_rows[0].first_detection_us = 7;
  EXPECT_TRUE(passed("physics"));
  EXPECT_FALSE(passed("all"));
  flown.object_rows[0].none_hit = true;
  EXPECT_FALSE(passed("physics"));
}

TEST(Gate, TellsButDoesNotJudgeBytesAcrossKindsOfMachines) {
  std::vector<ThrowResult> flown;
  for (int i = 0; i < 40; ++i) flown.push_back(throw_that(i, 'd'));
  flown[0].none.clearance_m = 1e-9;
  const GateVerdict verdict =
      judge(baseline_of(std::string(40, 'd')), tables_of(flown), "another kind", GateRules{});
  EXPECT_TRUE(verdict.passed());
  const GateCheck& bytes = check(verdict, "same bytes of the physics");
  EXPECT_EQ(bytes.result, GateCheck::Result::kLeftOut);
  EXPECT_THAT(bytes.reason, HasSubstr("changed: throws.csv: throw 0 none_clearance_m was "));
}

TEST(Gate, WritesJunitThatCountsItsFailures) {
  const std::string xml = junit_xml(judged("dd", "de"), "a <b> & \"c\"", "x < y\x01");
  EXPECT_THAT(xml, HasSubstr("tests=\"5\" failures=\"1\" skipped=\"1\""));
  EXPECT_THAT(xml, HasSubstr("classname=\"a &lt;b&gt; &amp; &quot;c&quot;\""));
  EXPECT_THAT(xml, HasSubstr("x &lt; y?"));
  EXPECT_THAT(xml, HasSubstr("<failure message=\"throws that failed: 1 (flown: killed, &quot;by"));
}

}  // namespace
}  // namespace dodgesim

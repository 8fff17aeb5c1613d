#include "sim/gate/gate.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/sim/gate/outcomes_fixture.h"

namespace dodgesim {
namespace {

using testing::csv_of;
using ::testing::HasSubstr;
using testing::table_of;
using testing::throw_that;

Baseline baseline_of(const std::string& outcomes) {
  return {table_of(outcomes), "", GateRules{}, "abc", "one kind"};
}

GateVerdict judged(const std::string& before, const std::string& after, GateRules rules = {}) {
  return judge(baseline_of(before), table_of(after), "one kind", rules);
}

const GateCheck& check(const GateVerdict& verdict, const std::string& name) {
  for (const GateCheck& c : verdict.checks) {
    if (c.name == name) return c;
  }
  throw std::logic_error("no check " + name);
}

TEST(Gate, passes_unchanged_throws) {
  EXPECT_TRUE(judged("ddhd", "ddhd").passed());
  EXPECT_TRUE(judged("ddhd", "ddhd", {0, 0.95, "all"}).passed());
}

TEST(Gate, fails_when_the_rate_fell_by_more_than_the_margin) {
  const std::string good(40, 'd');
  std::string bad = good;
  bad.replace(0, 10, std::string(10, 'h'));
  const GateVerdict verdict = judged(good, bad);
  EXPECT_FALSE(verdict.passed());
  EXPECT_EQ(check(verdict, "success rate").result, GateCheck::Result::kFailed);
  EXPECT_THAT(check(verdict, "success rate").reason, HasSubstr("fell by 0.250"));
  EXPECT_TRUE(judged(good, bad, {0.3, 0.95, "nothing"}).passed()) << "within a margin of 0.3";
  EXPECT_TRUE(judged(bad, good).passed()) << "to become better is no failure";
}

TEST(Gate, does_not_fail_by_chance) {
  const std::string good(40, 'd');
  std::string one_lost = good;
  one_lost[7] = 'h';
  const GateVerdict verdict = judged(good, one_lost);
  EXPECT_TRUE(verdict.passed());
  EXPECT_EQ(verdict.comparison.lost.size(), 1U);
}

TEST(Gate, fails_when_it_could_never_fail) {
  const GateRules rate_only{0.05, 0.95, "nothing"};
  const GateVerdict few = judged("dd", "dd", rate_only);
  EXPECT_EQ(check(few, "enough throws").result, GateCheck::Result::kFailed);
  EXPECT_FALSE(judged("mmm", "mmm").passed()) << "nothing would have hit";
  EXPECT_TRUE(judged("dd", "dd").passed()) << "the bytes can fail";
}

TEST(Gate, says_how_many_losses_it_takes) {
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
}

TEST(Gate, fails_for_other_throws) {
  ThrowResult other = throw_that(0, 'd');
  other.bearing_deg = 10;
  const GateVerdict verdict =
      judge(baseline_of("d"), CsvTable(csv_of({other}), "t"), "one kind", {0.05, 0.95, "nothing"});
  EXPECT_FALSE(verdict.passed());
}

TEST(Gate, fails_when_a_throw_could_not_be_flown) {
  const GateVerdict verdict = judged("dd", "de");
  EXPECT_FALSE(verdict.passed());
  EXPECT_THAT(check(verdict, "every throw was flown").reason, HasSubstr("1 (flown: killed"));
}

TEST(Gate, holds_the_bytes_that_must_not_change) {
  std::vector<ThrowResult> flown;
  for (int i = 0; i < 20; ++i) flown.push_back(throw_that(i, 'd'));
  flown[1].events_hash = 5;
  const Baseline before = baseline_of(std::string(20, 'd'));
  const auto passed = [&](const char* must_equal) {
    return judge(before, CsvTable(csv_of(flown), "t"), "one kind", {0.05, 0.95, must_equal})
        .passed();
  };
  EXPECT_TRUE(passed("nothing"));
  EXPECT_TRUE(passed("physics")) << "what the sensor sees is no physics of the throw";
  EXPECT_FALSE(passed("all"));
  flown[1].none.clearance_m = 1e-9;
  EXPECT_TRUE(passed("nothing"));
  EXPECT_FALSE(passed("physics"));
}

TEST(Gate, does_not_compare_bytes_across_kinds_of_machines) {
  std::vector<ThrowResult> flown = {throw_that(0, 'd')};
  flown[0].none.clearance_m = 1e-9;
  const GateVerdict verdict =
      judge(baseline_of("d"), CsvTable(csv_of(flown), "t"), "another kind", GateRules{});
  EXPECT_TRUE(verdict.passed());
  EXPECT_EQ(check(verdict, "same bytes of the physics").result, GateCheck::Result::kLeftOut);
}

TEST(Gate, writes_junit_that_counts_its_failures) {
  const std::string xml = junit_xml(judged("dd", "de"), "a <b> & \"c\"", "x < y\x01");
  EXPECT_THAT(xml, HasSubstr("tests=\"4\" failures=\"1\" skipped=\"0\""));
  EXPECT_THAT(xml, HasSubstr("classname=\"a &lt;b&gt; &amp; &quot;c&quot;\""));
  EXPECT_THAT(xml, HasSubstr("x &lt; y?"));
  EXPECT_THAT(xml, HasSubstr("<failure message=\"throws that failed: 1 (flown: killed, &quot;by"));
}

}  // namespace
}  // namespace dodgesim

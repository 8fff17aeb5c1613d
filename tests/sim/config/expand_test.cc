#include "sim/config/expand.h"

#include <gtest/gtest.h>

#include <set>

#include "sim/config/resolve_throw.h"
#include "tests/sim/config/parse.h"

namespace dodgesim {
namespace {

double threshold_b(const Scenario& campaign, int throw_index) {
  return case_of(campaign, throw_index).scenario.dodger.time_image.threshold_b;
}

TEST(Expand, KeysOfTheDodgerHoldForAllPilotsThatStartFromOnePreset) {
  const Scenario campaign =
      parse("dodger: {time_image: {threshold_b: 0.9}}\nsweep: {pilot: [oracle, falanga2020]}\n");
  EXPECT_EQ(threshold_b(campaign, 0), 0.9);
  EXPECT_EQ(threshold_b(campaign, 1), 0.9);
}

TEST(Expand, OfPilotsWithPresetsOfTheirOwnASweptKeyHoldsForAll) {
  const std::string pilots = "sweep: {pilot: [falanga2020, dodgesim]";
  const Scenario own = parse(pilots + "}\n"),
                 same = parse(pilots + ", dodger.time_image.threshold_b: [0.9]}\n");
  for (const int i : {0, 1}) EXPECT_EQ(threshold_b(same, i), 0.9);
  EXPECT_EQ(threshold_b(own, 0), dodge::preset("falanga2020").time_image.threshold_b);
  EXPECT_EQ(threshold_b(own, 1), dodge::preset("dodgesim").time_image.threshold_b);
}

constexpr const char* kCampaign =
    "seed: 5\nrepeats: 3\n"
    "throw: {speed_mps: !uniform [4, 8], launch_s: 0.5}\n"
    "grid:\n  size_m: [0.1, 0.2]\n  throw.distance_m: [2, 3, !uniform [4, 5]]\n"
    "sweep:\n  delays.compute_us: [0, 3500]\n  pilot: [falanga2020, oracle]\n";

TEST(Expand, EveryCombinationComesUpOnceARepeatAndSweepValue) {
  const Scenario campaign = parse(kCampaign);
  EXPECT_EQ(cell_count(campaign), 6);
  EXPECT_EQ(sweep_count(campaign), 4);
  ASSERT_EQ(throw_count(campaign), 6 * 3 * 4);
  std::multiset<std::string> seen;
  for (int t = 0; t < throw_count(campaign); ++t) {
    const ThrowCase thrown = case_of(campaign, t);
    EXPECT_EQ(thrown.index, t);
    EXPECT_EQ(thrown.sweep, t / 18);
    EXPECT_EQ(thrown.stream, t % 18);
    EXPECT_EQ(thrown.cell, t % 18 % 6);
    seen.insert(label(thrown.cell_values) + "; " + label(thrown.sweep_values));
    EXPECT_TRUE(thrown.scenario.grid.empty() && thrown.scenario.sweep.empty());
  }
  EXPECT_EQ(std::set<std::string>(seen.begin(), seen.end()).size(), 24u);
  for (const std::string& each : seen) EXPECT_EQ(seen.count(each), 3u) << each;
  EXPECT_EQ(*seen.begin(),
            "throw.size_m 0.1, throw.distance_m !uniform [4, 5]; delays.compute_us 0, pilot "
            "falanga2020");
}

TEST(Expand, AThrowHasTheValuesOfItsCellAndSweep) {
  const Scenario campaign = parse(kCampaign);
  const ThrowCase thrown = case_of(campaign, 3 * 18 + 2 * 6 + 5);  // last sweep value, last cell
  EXPECT_EQ(thrown.scenario.throw_spec->size_m, Distribution::constant(0.2));
  EXPECT_EQ(thrown.scenario.throw_spec->distance_m, Distribution::uniform(4, 5));
  EXPECT_EQ(thrown.scenario.throw_spec->speed_mps, Distribution::uniform(4, 8)) << "as in throw:";
  EXPECT_EQ(thrown.scenario.delays.compute_us, 3500);
  EXPECT_EQ(thrown.scenario.pilot, "oracle");
  EXPECT_EQ(thrown.sweep_values,
            (std::vector<AxisValue>{{"delays.compute_us", "3500"}, {"pilot", "oracle"}}));
}

TEST(Expand, APilotAmongTheValuesBringsItsConfiguration) {
  const Scenario campaign = parse("throw: {}\nsweep: {pilot: [falanga2020, dodgesim, oracle]}\n");
  for (const int i : {0, 1, 2}) {
    EXPECT_EQ(case_of(campaign, i).scenario.dodger.escape.law,
              dodge::preset(i == 1 ? "dodgesim" : "falanga2020").escape.law);
  }
}

TEST(Expand, NamesThePilotsThatFly) {
  EXPECT_EQ(pilots_of(parse("throw: {}\npilot: dodgesim\n")), "pilot dodgesim");
  EXPECT_EQ(pilots_of(parse("throw: {}\nsweep: {pilot: [none, oracle]}\n")), "pilots none, oracle");
}

double speed(const Scenario& campaign, int t) {
  const ThrowCase thrown = case_of(campaign, t);
  return resolve_throws(thrown.scenario, thrown.stream).front().speed_mps;
}

TEST(Expand, SweepValuesShareTheirThrowsAndNothingElseDoes) {
  const Scenario campaign = parse(kCampaign);
  std::set<double> speeds;
  for (int i = 0; i < 18; ++i) {
    speeds.insert(speed(campaign, i));
    for (int sweep = 1; sweep < 4; ++sweep) {
      EXPECT_EQ(speed(campaign, sweep * 18 + i), speed(campaign, i));
    }
  }
  EXPECT_EQ(speeds.size(), 18u);
}

TEST(Expand, MoreRepeatsOnlyAddThrows) {
  const Scenario campaign = parse(kCampaign);
  Scenario more = campaign;
  more.repeats = 7;
  for (int i = 0; i < 18; ++i) {
    EXPECT_EQ(speed(more, i), speed(campaign, i));
    EXPECT_EQ(case_of(more, i).cell, case_of(campaign, i).cell);
    EXPECT_EQ(speed(more, 42 + i), speed(campaign, 18 + i)) << "of the next sweep value";
  }
}

TEST(Expand, WithoutGridAndSweepAThrowIsTheScenario) {
  const Scenario scenario = parse("repeats: 4\nthrow: {}\n");
  ASSERT_EQ(throw_count(scenario), 4);
  const ThrowCase thrown = case_of(scenario, 3);
  EXPECT_EQ(to_yaml(thrown.scenario), to_yaml(scenario));
  EXPECT_EQ(thrown.stream, 3);
  EXPECT_EQ(label(thrown.cell_values), "");
}

TEST(Expand, TheResolvedScenarioExpandsAlike) {
  const Scenario campaign = parse(std::string(kCampaign) +
                                  "  sensors.events.preset: [ideal, sees1]\n"
                                  "  sensors.events.leak_hz: [3]\n"
                                  "mission: {heading_deg: 3}\n");
  const Scenario again = parse(to_yaml(campaign));
  EXPECT_EQ(to_yaml(again), to_yaml(campaign));
  for (const int t : {0, 17, 18, 100, 143}) {
    EXPECT_EQ(to_yaml(case_of(again, t).scenario), to_yaml(case_of(campaign, t).scenario)) << t;
  }
  EXPECT_EQ(case_of(campaign, 0).scenario.sensors.events.latency_us, 0) << "the preset ideal";
}

TEST(Expand, AGridOfThrowKeysCountsForEveryObject) {
  const Scenario campaign = parse(
      "throws: [{size_m: 0.3}, {launch_s: 2}]\ngrid: {size_m: [0.1, 0.2], bearing_deg: [5]}\n");
  const Scenario second = case_of(campaign, 1).scenario;
  ASSERT_EQ(second.throws.size(), 2u);
  for (const ThrowSpec& spec : second.throws) {
    EXPECT_EQ(spec.size_m, Distribution::constant(0.2));
    EXPECT_EQ(spec.bearing_deg, Distribution::constant(5));
  }
  EXPECT_EQ(second.throws[1].launch_s, Distribution::constant(2));
  EXPECT_FALSE(second.throw_spec.has_value());
}

}  // namespace
}  // namespace dodgesim

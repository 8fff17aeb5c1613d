// Selection, medians and reports with made-up cases; what the emulator's films hold.
#include "sim/bench/bench.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <set>

#include "sim/base/error.h"
#include "sim/bench/timed_emulation.h"
#include "sim/files/json.h"
#include "tests/complaint.h"

namespace dodgesim {
namespace {

using ::testing::ElementsAre;
using ::testing::MatchesRegex;

// Quantities whose values are 1, 2, 3, ... from run to run.
BenchCase counting(const std::vector<std::string>& names, int runs = 5) {
  BenchCase bench;
  for (const std::string& name : names) bench.quantities.push_back({name, "s", "what it is"});
  bench.runs = runs;
  bench.prepare = [n = names.size()](const BenchOptions&) -> BenchRun {
    return [n, run = 0.0]() mutable {
      ++run;
      return std::vector<double>(n, run);
    };
  };
  return bench;
}

std::vector<BenchCase> three_cases() {
  return {counting({"a.one", "a.two"}), counting({"a.three.x"}), counting({"b.one"}, 2)};
}

std::vector<std::string> wanted(const std::vector<BenchCase>& cases) {
  std::vector<std::string> names;
  for (const BenchCase& bench : cases) {
    for (const Quantity& quantity : bench.quantities) {
      if (quantity.wanted) names.push_back(quantity.name);
    }
  }
  return names;
}

TEST(Bench, SelectsNamesAndTheirFirstParts) {
  EXPECT_THAT(wanted(select(three_cases(), {})),
              ElementsAre("a.one", "a.two", "a.three.x", "b.one"));
  EXPECT_THAT(wanted(select(three_cases(), {"a"})), ElementsAre("a.one", "a.two", "a.three.x"));
  EXPECT_THAT(wanted(select(three_cases(), {"a.two", "b"})), ElementsAre("a.two", "b.one"));
  EXPECT_EQ(select(three_cases(), {"a.three"}).size(), 1u) << "only what is needed is measured";
}

TEST(Bench, RefusesUnknownNamesWithTheClosestOne) {
  const auto refusal = [](const std::string& name) -> std::string {
    return testing::complaint<ScenarioError>([&] { select(three_cases(), {"a", name}); });
  };
  EXPECT_EQ(refusal("a.thre"), "There is no benchmark case \"a.thre\"; did you mean a.three?");
  EXPECT_EQ(refusal("three"), "There is no benchmark case \"three\"; did you mean a.three?");
  EXPECT_EQ(refusal("something else"),
            "There is no benchmark case \"something else\"; --list names them all.");
}

TEST(Bench, ReportsTheMedianOfTheRuns) {
  BenchOptions options;
  std::vector<std::string> lines;
  const auto measurements = measure(select(three_cases(), {"a.two", "b"}), options,
                                    [&](const Measurement& m) { lines.push_back(line(m)); });
  EXPECT_THAT(lines, ElementsAre("a.two 3.000 s", "b.one 1.500 s"));
  ASSERT_EQ(measurements.size(), 2u);
  EXPECT_THAT(measurements[0].runs, ElementsAre(1, 2, 3, 4, 5));
  EXPECT_THAT(measurements[1].runs, ElementsAre(1, 2));
  options.runs = 3;
  EXPECT_THAT(measure(three_cases(), options, [](const Measurement&) {}).back().runs,
              ElementsAre(1, 2, 3));
  EXPECT_EQ((Measurement{{}, {9, 1, 5}}.median()), 5);
}

TEST(Bench, WritesNumbersWithFiveDigitsAndNoExponent) {
  const auto text = [](double value) { return line({{"n", "u", ""}, {value}}); };
  EXPECT_EQ(text(0), "n 0.0000 u");
  EXPECT_EQ(text(0.01234567), "n 0.0123 u");
  EXPECT_EQ(text(1.234567), "n 1.235 u");
  EXPECT_EQ(text(123.4567), "n 123.5 u");
  EXPECT_EQ(text(1234567.8), "n 1234568 u");
}

TEST(Bench, TheJsonHoldsAllRunsAndWhatTheyWereMadeOn) {
  BenchOptions options;
  const auto measurements = measure(three_cases(), options, [](const Measurement&) {});
  const auto json = parse_json(bench_json(measurements, "dodgesim bench", "softpipe"));
  ASSERT_EQ(json["cases"].size(), 4u);
  EXPECT_EQ(json["cases"][0], (Json{{"case", "a.one"},
                                    {"unit", "s"},
                                    {"meaning", "what it is"},
                                    {"median", 3.0},
                                    {"runs", {1.0, 2.0, 3.0, 4.0, 5.0}}}));
  EXPECT_EQ(json["libraries"]["gl_renderer"], "softpipe");
  EXPECT_EQ(json["bench"]["command_line"], "dodgesim bench");
  for (const auto& [group, key] :
       {std::pair{"machine", "cpu"}, {"program", "compiler"}, {"program", "commit"}}) {
    EXPECT_FALSE(json[group][key].get<std::string>().empty()) << key;
  }
}

TEST(Bench, TheCasesOfTheProgramHaveNamesOfTheirOwnWithoutSpaces) {
  std::set<std::string> names;
  for (const BenchCase& bench : all_bench_cases()) {
    for (const Quantity& quantity : bench.quantities) {
      EXPECT_THAT(quantity.name + " " + quantity.unit, MatchesRegex("[a-z0-9_.]+ [^ ]+"));
      EXPECT_TRUE(names.insert(quantity.name).second) << quantity.name;
    }
  }
}

double rate_of(const std::string& name) {
  const auto cases = select(emulator_cases(), {name + ".rate"});
  BenchOptions options;
  options.runs = 2;
  return measure(cases, options, [](const Measurement&) {}).at(0).median();
}

TEST(EmulatorCases, FilmsMakeAsManyEventsAsTheyAreMeantTo) {
  EXPECT_NEAR(rate_of("emulator.textured.ideal"), 3, 0.3);
  EXPECT_NEAR(rate_of("emulator.drifting.ideal"), 0.3, 0.05);
  EXPECT_EQ(rate_of("emulator.quiet.ideal"), 0);
}

TEST(TimedEmulation, PassesOnTheEventsOfTheCamera) {
  const EventCameraSpec spec = event_camera_preset("ideal");
  EventCamera camera(spec, 2, 1, 1, 0, "timed");
  camera.reset(0, std::vector<float>{1, 1}.data());
  TimedEmulation timed(camera, spec.log_epsilon);
  std::vector<Event> events = {{}};
  timed.update(1000, {1, 2}, events);
  timed.update(2000, {1, 1}, events);
  EXPECT_EQ(events.size(), 1u + 3 + 3) << "ln 2 / 0.2 is 3.5; the last crossing is half way back";
  EXPECT_EQ(timed.events(), 6);
  EXPECT_EQ(timed.frames(), 2);
  EXPECT_GT(timed.emulation_s(), 0);
  EXPECT_GT(timed.log_s(), 0);
}

}  // namespace
}  // namespace dodgesim

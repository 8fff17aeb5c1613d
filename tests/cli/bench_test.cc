// dodgesim bench: what it prints and writes. No number of a speed is judged.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <sstream>
#include <vector>

#include "sim/files/json.h"
#include "tests/cli/program.h"
#include "tests/sim/files/temporary_directory.h"

namespace {

using dodgesim::testing::contents;
using dodgesim::testing::dodgesim;
using dodgesim::testing::Outcome;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

struct Line {
  std::string name, unit;
  double value = 0;
};

// Every line is "case value unit".
std::vector<Line> parse(const std::string& output) {
  std::vector<Line> lines;
  std::istringstream text(output);
  for (std::string row; std::getline(text, row);) {
    std::istringstream words(row);
    Line line;
    std::string rest;
    EXPECT_TRUE(words >> line.name >> line.value >> line.unit) << row;
    EXPECT_FALSE(words >> rest) << row;
    lines.push_back(line);
  }
  return lines;
}

std::vector<std::string> names(const std::vector<Line>& lines) {
  std::vector<std::string> names;
  for (const Line& line : lines) names.push_back(line.name);
  return names;
}

TEST(BenchCommand, PrintsALineForEachCase) {
  const Outcome outcome = dodgesim("bench emulator.quiet log renderer.region16 --runs 1");
  ASSERT_EQ(outcome.exit_code, 0) << outcome.output;
  const std::vector<Line> lines = parse(outcome.output);
  EXPECT_THAT(names(lines),
              ElementsAre("log.float", "log.double", "emulator.quiet.ideal.speed",
                          "emulator.quiet.ideal.throughput", "emulator.quiet.ideal.rate",
                          "emulator.quiet.ideal.time_to_log", "emulator.quiet.sees1.speed",
                          "emulator.quiet.sees1.throughput", "emulator.quiet.sees1.rate",
                          "emulator.quiet.sees1.time_to_log", "renderer.region16"));
  EXPECT_EQ(lines.front().unit, "ns/px");
  EXPECT_EQ(lines.back().unit, "ms");
  EXPECT_GT(lines.back().value, 0);
}

TEST(BenchCommand, FliesScenarios) {
  const Outcome outcome = dodgesim("bench loop.ci --runs 1 --throws 1");
  ASSERT_EQ(outcome.exit_code, 0) << outcome.output;
  const std::vector<Line> lines = parse(outcome.output);
  ASSERT_THAT(names(lines), ElementsAre("loop.ci.real_time_factor", "loop.ci.render",
                                        "loop.ci.emulate", "loop.ci.pilot", "loop.ci.rest",
                                        "loop.ci.keys", "loop.ci.pictures", "loop.ci.regions"));
  double shares = 0;
  for (const Line& line : lines) {
    if (line.unit == "share") shares += line.value;
  }
  EXPECT_NEAR(shares, 1, 1e-3);
  EXPECT_GT(lines[5].value, 0) << "pictures are drawn";
}

TEST(BenchCommand, ListsAllCasesWithUnitAndMeaning) {
  const Outcome outcome = dodgesim("bench --list");
  ASSERT_EQ(outcome.exit_code, 0);
  for (const char* line :
       {"emulator.textured.ideal.speed frames/s: ", "emulator.drifting.sees1.time_to_log ratio: ",
        "renderer.whole ms: ", "loop.hover.real_time_factor ratio: "}) {
    EXPECT_THAT(outcome.output, HasSubstr(line));
  }
  const Outcome some = dodgesim("bench --list renderer.whole");
  EXPECT_EQ(std::count(some.output.begin(), some.output.end(), '\n'), 1);
}

TEST(BenchCommand, WritesAllRunsAndTheMachineAsJson) {
  const dodgesim::testing::TemporaryDirectory root;
  const std::string file = (root / "bench.json").string();
  const Outcome outcome = dodgesim("bench log --runs 3 --json " + file);
  ASSERT_EQ(outcome.exit_code, 0) << outcome.output;
  const auto json = dodgesim::parse_json(contents(file));
  ASSERT_EQ(json["cases"].size(), 2u);
  for (const auto& item : json["cases"]) EXPECT_EQ(item["runs"].size(), 3u);
  EXPECT_EQ(json["cases"][1]["case"], "log.double");
  EXPECT_EQ(json["cases"][1]["unit"], "ns/px");
  EXPECT_THAT(json["libraries"]["gl_renderer"].get<std::string>(), HasSubstr("pipe"));
  EXPECT_FALSE(json["machine"]["cpu"].get<std::string>().empty());
  EXPECT_EQ(json["bench"]["command_line"], "dodgesim bench log --runs 3 --json " + file);
}

TEST(BenchCommand, RefusesUnknownCasesAndFilesItCannotWrite) {
  const Outcome unknown = dodgesim("bench emulator.texture");
  EXPECT_EQ(unknown.exit_code, 2);
  EXPECT_EQ(unknown.output,
            "There is no benchmark case \"emulator.texture\"; did you mean "
            "emulator.textured?\n");
  const Outcome nowhere = dodgesim("bench log --runs 1 --json /no/such/dir/bench.json");
  EXPECT_EQ(nowhere.exit_code, 4);
  EXPECT_EQ(nowhere.output,
            "/no/such/dir/bench.json could not be created: No such file or directory.\n");
  EXPECT_EQ(dodgesim("bench log --runs 0").exit_code, 2);
  const Outcome undrawn = dodgesim("bench log --runs 1 --plots plots");
  EXPECT_EQ(undrawn.exit_code, 2);
  EXPECT_EQ(undrawn.output, "--plots draws the times of the pilot: name a case of it, or none.\n");
}

}  // namespace

// The program as its users meet it: exit codes and what it prints.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdint>
#include <cstring>
#include <filesystem>
#include <map>
#include <regex>
#include <sstream>
#include <utility>

#include "tests/cli/command_test.h"

namespace {

namespace fs = std::filesystem;
using dodgesim::testing::CommandTest;
using dodgesim::testing::dodgesim;
using dodgesim::testing::Outcome;
using dodgesim::testing::shell;
using ::testing::AnyOf;
using ::testing::ContainsRegex;
using ::testing::HasSubstr;
using ::testing::Not;
using ::testing::StartsWith;

const fs::path kSource = DODGESIM_SOURCE_DIR;

// Where the records of a results.bin begin: behind its mark and the campaign's identity.
std::size_t records_at(const std::string& results) {
  constexpr std::size_t kMark = 8, kHeader = 16;
  std::uint32_t size = 0;
  std::memcpy(&size, results.data() + kMark, sizeof size);
  return kMark + kHeader + size;
}

// Drawn in an eighth of the time.
constexpr const char* kSmallPictures = "sensors: {camera: {width: 160, height: 120}}\n";

class DodgesimTest : public CommandTest {
 protected:
  std::string file(const std::string& text) const {
    write("scenario.yaml", text);
    return path("scenario.yaml");
  }

  void expect_refused(const std::string& yaml, const std::string& message) const {
    const std::string path = file(yaml);
    for (const std::string& command :
         {"validate " + path, "run " + path + " --out " + (root_ / "out").string()}) {
      const Outcome outcome = dodgesim(command);
      EXPECT_EQ(outcome.exit_code, 2) << command;
      EXPECT_EQ(outcome.output.substr(0, path.size() + message.size()), path + message) << command;
      EXPECT_EQ(std::count(outcome.output.begin(), outcome.output.end(), '\n'), 1) << command;
    }
    EXPECT_FALSE(fs::exists(root_ / "out"));
  }
};

TEST_F(DodgesimTest, RefusesBadScenariosWithOneSentenceAndExitCode2) {
  expect_refused("sed: 1\n", ":1:1: sed is not a known key; did you mean seed?\n");
  expect_refused("seed: one\n", ":1:7: seed is \"one\", but must be a whole number between 0 and");
  expect_refused("seed: 1\nseed: 1\n", ":2:1: seed is given twice; it is already in line 1.\n");
  expect_refused("throw: {size_m: -1}\n",
                 ":1:17: throw.size_m is -1, but must be between 0.01 and 1.\n");
  expect_refused("throw: {size_m: .nan}\n", ":1:17: throw.size_m is .nan, but must be a number");
  expect_refused("throw: {object: anvil}\n",
                 ":1:17: throw.object is \"anvil\", but there is no model file ");
  expect_refused("", ": The file is empty.\n");
}

TEST_F(DodgesimTest, RefusesBadCommandLinesWithExitCode2) {
  for (const char* arguments :
       {"", "fly", "run", "run x.yaml", "run x.yaml --out", "run x.yaml --out d -j 0",
        "run x.yaml --out d --throws many", "replay d", "replay d --throw -1", "validate",
        "validate a.yaml b.yaml", "explain no_such_key_at_all", "validate /no/such/file.yaml"}) {
    const Outcome outcome = dodgesim(arguments);
    EXPECT_EQ(outcome.exit_code, 2) << arguments;
    EXPECT_FALSE(outcome.output.empty()) << arguments;
  }
}

TEST_F(DodgesimTest, SaysWhatIsWrongWithACommandLine) {
  const std::pair<const char*, const char*> cases[] = {
      {"fly s.yaml", "dodgesim has no command fly; it has run, sweep, "},
      {"run " DODGESIM_SOURCE_DIR "/scenarios/demo.yaml --out ''", "--out: nothing was given"},
      {"bench --json ''", "--json: nothing was given"},
      {"run s.yaml --out= --force", "--out: nothing was given"},
      {"merge '' --out d", "merge: nothing was given"},
      {"sweep s.yaml --over ''", "--over: nothing was given"},
      {"run --bogus", "not expected: --bogus"},
      {"replay d --trow 3", "--trow"},
      {"explain throw --markdown", "key excludes --markdown"},
      {"replay d --throw 0 --video v.avi", "v.avi must be the name of a file that ends in .mp4"},
      {"replay d --throw 0 --mcap v.bag", "v.bag must be the name of a file that ends in .mcap"},
  };
  for (const auto& [arguments, sentence] : cases) {
    const Outcome outcome = dodgesim(arguments);
    EXPECT_NE(outcome.exit_code, 0) << arguments;
    EXPECT_THAT(outcome.output, HasSubstr(sentence)) << arguments;
  }
}

TEST_F(DodgesimTest, RefusesNumbersOutOfAnOptionsRangeWithTheRange) {
  for (const char* margin : {"nan", "1", "-0.1", "0.5x"}) {
    EXPECT_THAT(dodgesim("gate s.yaml --baseline b --out d --margin " + std::string(margin)).output,
                HasSubstr("--margin: " + std::string(margin) +
                          " was given, but must be a number between 0 and 0.99\n"));
  }
  EXPECT_THAT(dodgesim("replay d --throw -1").output,
              HasSubstr("-1 was given, but must be a whole number between 0 and 2147483647\n"));
}

TEST_F(DodgesimTest, HelpTeachesWithExamples) {
  const Outcome help = dodgesim("--help");
  EXPECT_EQ(help.exit_code, 0);
  EXPECT_THAT(help.output, HasSubstr("dodgesim run scenarios/demo.yaml --out out/demo"));
  EXPECT_THAT(help.output, HasSubstr("Exit codes"));
  EXPECT_EQ(dodgesim("run --help").exit_code, 0);
  const Outcome version = dodgesim("--version");
  EXPECT_EQ(version.exit_code, 0);
  EXPECT_THAT(version.output, ::testing::ContainsRegex("^[0-9.]+ ([0-9a-f]{40}|unknown)"));
}

TEST_F(DodgesimTest, ValidatesTheScenariosOfTheProject) {
  for (const char* name : {"demo", "ci", "goal_flight", "mono"}) {
    const std::string path = kSource / "scenarios" / (std::string(name) + ".yaml");
    const Outcome outcome = dodgesim("validate " + path);
    EXPECT_EQ(outcome.exit_code, 0) << outcome.output;
    EXPECT_THAT(outcome.output, HasSubstr(": a valid scenario of "));
  }
}

TEST_F(DodgesimTest, ResolvingAResolvedScenarioChangesNothing) {
  const Outcome once =
      dodgesim("validate --resolved " + (kSource / "scenarios/mono.yaml").string());
  ASSERT_EQ(once.exit_code, 0);
  const Outcome twice = dodgesim("validate --resolved " + file(once.output));
  EXPECT_EQ(twice.output, once.output);
}

TEST_F(DodgesimTest, TheDocumentationOfTheKeysIsUpToDate) {
  const std::string readme = contents(kSource / "scenarios/README.md");
  const std::size_t tables = readme.find("### Top level\n");
  ASSERT_NE(tables, std::string::npos);
  EXPECT_TRUE(readme.substr(tables) == dodgesim("explain --markdown").output)
      << "Put what this prints in place of the tables at its end: build/dodgesim explain "
         "--markdown";
}

// Physics only, which costs next to nothing; the closed loop has tests of its own.
TEST_F(DodgesimTest, FliesACampaignAndReplaysAThrowOfIt) {
  const std::string scenario = file(
      "pilot: none\nfly_oracle: false\nafter_s: 0.1\n"
      "throw: {distance_m: !uniform [2, 3], launch_s: 0.1}\n");
  const std::string one = (root_ / "one").string();
  const Outcome run = dodgesim("run " + scenario + " --out " + one + " --throws 3 --seed 9 -j 1");
  ASSERT_EQ(run.exit_code, 0) << run.output;
  EXPECT_THAT(run.output, HasSubstr("# scenario\n\n3 throws, pilot none."));
  EXPECT_THAT(run.output, HasSubstr("real-time factor"));

  const std::string two = (root_ / "two").string();
  ASSERT_EQ(dodgesim("run " + scenario + " --out " + two + " --throws 3 --seed 9 -j 2").exit_code,
            0);
  EXPECT_EQ(contents(one + "/throws.csv"), contents(two + "/throws.csv"));

  const Outcome ten =
      dodgesim("run " + scenario + " --out " + one + " --throws 3 --seed 10 --resume");
  EXPECT_EQ(ten.exit_code, 2);
  EXPECT_THAT(ten.output, HasSubstr("holds results of another scenario (seed is 9, not 10);"));

  const Outcome replay = dodgesim("replay " + one + " --throw 2");
  EXPECT_EQ(replay.exit_code, 0) << replay.output;
  EXPECT_EQ(dodgesim("replay " + one + " --throw 3").exit_code, 2) << "there are three throws";

  // Results of another seed are of other throws.
  const std::string eight = (root_ / "eight").string();
  ASSERT_EQ(dodgesim("run " + scenario + " --out " + eight + " --throws 3 --seed 8").exit_code, 0);
  const std::string results = contents("one/results.bin"), other = contents("eight/results.bin");
  write("one/results.bin",
        results.substr(0, records_at(results)) + other.substr(records_at(other)));
  const Outcome changed = dodgesim("replay " + one + " --throw 2");
  EXPECT_EQ(changed.exit_code, 1) << changed.output;
  EXPECT_THAT(changed.output, HasSubstr("Throw 2 did not fly as recorded"));
  EXPECT_THAT(changed.output, ContainsRegex("\n  distance_m: recorded [0-9.]+, flown [0-9.]+\n"));
  EXPECT_THAT(changed.output, Not(HasSubstr("  throw: ")));
}

TEST_F(DodgesimTest, ReplaysNoScenarioThatWasChangedAfterTheFlight) {
  const std::string out = path("out"), resolved = "out/scenario.resolved.yaml";
  ASSERT_EQ(
      dodgesim("run " + file("pilot: none\nseed: 9\nthrow: {}\n") + " --out " + out).exit_code, 0);
  const std::string kept = contents(resolved);
  write(resolved, std::regex_replace(kept, std::regex("seed: 9"), "seed: 8"));
  const Outcome changed = dodgesim("replay " + out + " --throw 0");
  EXPECT_EQ(changed.exit_code, 2);
  EXPECT_EQ(changed.output, path(resolved) + " is not the scenario that " + out +
                                " was flown with (seed is 8, not 9); to fly another one, "
                                "`dodgesim run` it.\n");
  write(resolved, "# a remark\n" + kept);
  EXPECT_EQ(dodgesim("replay " + out + " --throw 0").exit_code, 0);
}

TEST_F(DodgesimTest, TellsTheTruthAboutEventsOfEachValueOfASweep) {
  const std::string scenario = file(
      std::string(kSmallPictures) +
      "fly_oracle: false\nafter_s: 0.1\nthrow: {distance_m: 1.5, speed_mps: 6, launch_s: 0.1}\n");
  const std::string out = (root_ / "out").string();
  const Outcome sweep = dodgesim("sweep " + scenario + " --out " + out +
                                 " --throws 1 -j 1 --truth --over pilot=none,falanga2020");
  ASSERT_EQ(sweep.exit_code, 0) << sweep.output;
  EXPECT_THAT(sweep.output, HasSubstr("pilot none:\nThe pilot none sees no events.\n"));
  EXPECT_THAT(sweep.output,
              HasSubstr("pilot falanga2020:\nEvents before the vehicle evades: precision 0."));
}

TEST_F(DodgesimTest, WritesTheTruthAboutEvents) {
  const std::string scenario =
      file(std::string(kSmallPictures) +
           "fly_oracle: false\nafter_s: 0.1\n"
           "throw: {distance_m: 1.5, speed_mps: 6, size_m: 0.2, launch_s: 0.1}\n");
  const std::string out = (root_ / "out").string();
  const Outcome run = dodgesim("run " + scenario + " --out " + out + " --throws 1 --truth");
  ASSERT_EQ(run.exit_code, 0) << run.output;
  EXPECT_THAT(run.output, HasSubstr("Events before the vehicle evades: precision "));
  EXPECT_THAT(contents(out + "/truth.csv"), HasSubstr("event_precision,event_recall\n0,"));

  const std::string events = (root_ / "events.txt").string();
  const std::string mcap = (root_ / "throw.mcap").string();
  const Outcome replay = dodgesim("replay " + out + " --throw 0 --camera bottom --events " +
                                  events + " --mcap " + mcap);
  ASSERT_EQ(replay.exit_code, 0) << replay.output;
  EXPECT_THAT(replay.output, HasSubstr("events of the bottom camera: " + events));
  EXPECT_THAT(replay.output, HasSubstr("Events before the vehicle evades: precision "));
  EXPECT_THAT(replay.output, HasSubstr("flew as recorded, bit for bit"));
  EXPECT_THAT(replay.output, HasSubstr("Recording for Foxglove or Lichtblick: " + mcap));
  EXPECT_EQ(contents(mcap).substr(1, 4), "MCAP");
  std::istringstream lines(contents(events));
  std::map<int, int> causes;
  long long t_us = 0, last_us = 0;
  for (int x = 0, y = 0, p = 0, cause = 0; lines >> t_us >> x >> y >> p >> cause; ++causes[cause]) {
    ASSERT_GE(t_us, last_us);
    last_us = t_us;
  }
  EXPECT_GT(causes[1], 100);    // the ball
  EXPECT_GT(causes[254], 100);  // shot noise
  EXPECT_EQ(dodgesim("replay " + out + " --throw 0 --events e.csv").exit_code, 2);
  EXPECT_THAT(dodgesim("replay " + out + " --throw 0 --stages " + out).output,
              HasSubstr("--stages " + out + " holds a campaign"));
}

// It brings LLVM, which takes a tenth of a second to load.
TEST_F(DodgesimTest, DoesNotStartWithOsmesa) {
  const std::string libraries =
      shell("LD_TRACE_LOADED_OBJECTS=1 " DODGESIM_BINARY_DIR "/dodgesim").output;
  EXPECT_THAT(libraries, HasSubstr("libmujoco"));
  EXPECT_THAT(libraries, Not(AnyOf(HasSubstr("OSMesa"), HasSubstr("LLVM"))));
}

TEST_F(DodgesimTest, ReportsOutputThatCannotBeWritten) {
  const Outcome full = dodgesim("explain >/dev/full");
  EXPECT_EQ(full.exit_code, 4);
  const Outcome no_directory =
      dodgesim("run " + (kSource / "scenarios/ci.yaml").string() + " --out /dev/null/x");
  EXPECT_EQ(no_directory.exit_code, 4) << no_directory.output;
  EXPECT_THAT(no_directory.output, HasSubstr("/dev/null/x could not be created"));
}

TEST_F(DodgesimTest, WhatReadsACampaignSaysWhatNamesOne) {
  const std::string nothing = root_.string();
  for (const std::string& command : {"replay " + nothing + " --throw 0", "table " + nothing,
                                     "compare " + nothing + " " + nothing}) {
    const Outcome outcome = dodgesim(command);
    EXPECT_EQ(outcome.exit_code, 4) << command;
    EXPECT_THAT(outcome.output, HasSubstr("a campaign is named by the directory that "
                                          "`dodgesim run --out DIR` wrote."));
  }
}

TEST_F(DodgesimTest, WhatReadsACampaignSaysThatAFileIsNone) {
  const std::string scenario = file("pilot: none\n");
  for (const std::string& command :
       {"replay " + scenario + " --throw 0", "table " + scenario, "report " + scenario,
        "merge --check " + scenario, "compare " + scenario + " " + scenario}) {
    const Outcome outcome = dodgesim(command);
    EXPECT_EQ(outcome.exit_code, 4) << command;
    EXPECT_EQ(outcome.output, scenario +
                                  " is a file; a campaign is named by the directory that "
                                  "`dodgesim run --out DIR` wrote.\n");
  }
  const Outcome out = dodgesim("run " + scenario + " --out " + scenario);
  EXPECT_EQ(out.exit_code, 4);
  EXPECT_EQ(out.output, scenario + " could not be created: a file of that name exists.\n");
}

TEST_F(DodgesimTest, SaysWhyAScenarioCannotBeRead) {
  const Outcome folder = dodgesim("validate " + root_.string());
  EXPECT_EQ(folder.exit_code, 2);
  EXPECT_EQ(folder.output, root_.string() + ": This is a directory; a YAML file is needed.\n");
  const Outcome memory = dodgesim("validate /proc/self/mem");
  EXPECT_EQ(memory.exit_code, 4);
  EXPECT_EQ(memory.output, "/proc/self/mem could not be read: Input/output error.\n");
}

TEST_F(DodgesimTest, ReportsPathsThatCannotBeUsed) {
  const std::string loop = (root_ / "loop").string();
  fs::create_symlink(loop, loop);
  const std::string scenario = file("pilot: none\n");
  for (const std::string& command :
       {"compare " + loop + " " + loop,
        "gate " + scenario + " --baseline " + loop + " --out " + (root_ / "out").string()}) {
    const Outcome outcome = dodgesim(command);
    EXPECT_EQ(outcome.exit_code, 4) << command << "\n" << outcome.output;
    EXPECT_THAT(outcome.output, StartsWith(loop)) << command;
    EXPECT_THAT(outcome.output, HasSubstr("could not be used: Too many levels of symbolic links."));
  }
}

}  // namespace

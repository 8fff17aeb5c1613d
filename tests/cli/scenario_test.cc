// Grids, sweeps, settings and several objects, from the command line.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <vector>

#include "tests/cli/command_test.h"

namespace {

namespace fs = std::filesystem;
using dodgesim::testing::dodgesim;
using dodgesim::testing::Outcome;
using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;

class ScenarioCommandTest : public dodgesim::testing::CommandTest {
 protected:
  ScenarioCommandTest() {
    write("s.yaml",
          "seed: 3\nrepeats: 2\npilot: none\nfly_oracle: false\nafter_s: 0.1\n"
          "throw: {speed_mps: !uniform [5, 8], launch_s: 0.1}\n");
  }
};

TEST_F(ScenarioCommandTest, SettingsChangeTheFileAndAreResolved) {
  const Outcome run = dodgesim("run " + path("s.yaml") + " --out " + path("set") +
                               " --set 'throw.size_m=!choice [0.3]' --set repeats=3 --throws 1");
  EXPECT_EQ(run.exit_code, 0) << run.output;
  EXPECT_EQ(column("set/throws.csv", "size_m"), std::vector<std::string>{"0.3"});
  EXPECT_THAT(contents("set/scenario.resolved.yaml"),
              AllOf(HasSubstr("size_m: !choice [0.3]"), HasSubstr("repeats: 1\n")));
}

TEST_F(ScenarioCommandTest, WhatOnlyTheModelsRefuseHasAPlaceToo) {
  write("start.yaml", "pilot: none\nmission:\n  start_m: [50, 0, 2]\n");
  const Outcome start = dodgesim("validate " + path("start.yaml"));
  EXPECT_EQ(start.exit_code, 2);
  EXPECT_THAT(start.output, ::testing::StartsWith(path("start.yaml") +
                                                  ":3:12: The vehicle cannot be at (50, 0, 2) m"));
  write("goal.yaml",
        "pilot: none\nmission: {type: goal, goal_m: [3, 0, 9]}\n");  // above the ceiling
  EXPECT_THAT(
      dodgesim("validate " + path("goal.yaml")).output,
      AllOf(::testing::StartsWith(path("goal.yaml") + ":2:"),
            HasSubstr("The vehicle cannot be at (3, 0, 9) m"), HasSubstr("move mission.goal_m.")));
  const Outcome weak =
      dodgesim("validate " + path("s.yaml") + " --set vehicle_overrides.max_thrust_n=1");
  EXPECT_EQ(weak.exit_code, 2);
  EXPECT_THAT(weak.output, AllOf(::testing::StartsWith("--set vehicle_overrides.max_thrust_n=1: "),
                                 HasSubstr("lift only 0.4")));
  // One of several worlds.
  const Outcome near = dodgesim("validate " + path("s.yaml") + " --set pilot=dodgesim --set " +
                                "'grid={vehicle_overrides.stereo_baseline_m: [0.15, 0.0005]}'");
  EXPECT_EQ(near.exit_code, 2);
  EXPECT_THAT(near.output, HasSubstr("Stereo needs two cameras at least 0.001 m apart"));
}

TEST_F(ScenarioCommandTest, ThrowsThatAreImpossibleAreFoundBeforeTheyAreFlown) {
  write("far.yaml",
        "pilot: none\nrepeats: 2\nthrow:\n  launch_height_m: 1.5\n  distance_m: 20\n  launch_s: "
        "0.1\n");
  const Outcome far = dodgesim("validate " + path("far.yaml"));
  EXPECT_EQ(far.exit_code, 2);
  EXPECT_THAT(far.output,
              ::testing::StartsWith(path("far.yaml") + ":5:15: In throw 0: The throw starts at ("));
  const std::string uniform = "validate " + path("far.yaml") + " --set ";
  EXPECT_EQ(dodgesim(uniform + "repeats=20 --set 'throw.distance_m=!uniform [2, 4]'").exit_code, 0);
  const Outcome some = dodgesim(uniform + "repeats=20 --set 'throw.distance_m=!uniform [2, 10]'");
  EXPECT_EQ(some.exit_code, 2) << "no draw of twenty is near the room's wall";
  EXPECT_THAT(some.output, HasSubstr("behind the room's \"wall_front\""));
  EXPECT_THAT(
      dodgesim(uniform + "throw.distance_m=2 --set repeats=20 --set throw.launch_s=20").output,
      ::testing::ContainsRegex("of 20 throws \\([0-9]+ of which were solved\\)"));
  const Outcome slow = dodgesim(
      uniform +
      "throw.distance_m=15 --set throw.speed_mps=0.5 --set throw.size_m=1 --set room=field");
  EXPECT_THAT(slow.output, AllOf(::testing::StartsWith("--set throw.speed_mps=0.5: In throw 0: "),
                                 HasSubstr("the air drag of the object is too strong")));
}

TEST_F(ScenarioCommandTest, KeysWithoutEffectAreNotedButNoMistake) {
  const Outcome idle = dodgesim("validate " + path("s.yaml") + " --set oracle.range_cap_m=2");
  EXPECT_EQ(idle.exit_code, 0);
  EXPECT_THAT(idle.output,
              ::testing::StartsWith("--set oracle.range_cap_m=2: oracle.range_cap_m has no "
                                    "effect: the pilot oracle does not fly.\n" +
                                    path("s.yaml") + ": a valid scenario of 2 throws"));
}

TEST_F(ScenarioCommandTest, AThrowThatTakesLongToSolveIsNotTriedToItsEnd) {
  const Outcome late =
      dodgesim("validate " + path("s.yaml") + " --set throw.launch_s=600 --set room=field");
  EXPECT_EQ(late.exit_code, 0) << late.output;
  EXPECT_THAT(late.output, HasSubstr("of 2 throws (not solved: that takes too long), pilot none"));
}

TEST_F(ScenarioCommandTest, ThrowsThatStartInsideSomethingAreFound) {
  const std::string keys = "{distance_m: 2, size_m: 0.3, launch_height_m: ";
  write("floor.yaml", "pilot: none\nthrow: " + keys + "0.1}\n");
  const Outcome floor = dodgesim("validate " + path("floor.yaml"));
  EXPECT_EQ(floor.exit_code, 2);
  EXPECT_THAT(floor.output, AllOf(::testing::StartsWith(path("floor.yaml") + ":2:"),
                                  HasSubstr("m inside the room's \"floor\"")));
  write("two.yaml", "pilot: none\nthrows:\n  - " + keys + "1.5}\n  - " + keys + "1.5}\n");
  EXPECT_THAT(dodgesim("validate " + path("two.yaml")).output, HasSubstr("m inside object 0"));
  // Also what comes after an object that hits.
  write("later.yaml",
        "pilot: none\nthrows:\n  - {distance_m: 2, speed_mps: 8, launch_s: 0.1}\n  - " + keys +
            "0.1, launch_s: 1}\n");
  EXPECT_THAT(dodgesim("validate " + path("later.yaml")).output,
              AllOf(HasSubstr("Object 1 would be launched at 1 s"), HasSubstr("\"floor\"")));
  write("apart.yaml", "pilot: none\nthrows:\n  - " + keys + "1.5, count: 2, interval_s: 0.2}\n");
  EXPECT_EQ(dodgesim("validate " + path("apart.yaml")).exit_code, 0);
  // Also what is thrown before the object ahead of it has made way.
  write("close.yaml", "pilot: none\nthrows:\n  - " + keys + "1.5, count: 2, interval_s: 0.02}\n");
  const Outcome close = dodgesim("validate " + path("close.yaml"));
  EXPECT_EQ(close.exit_code, 2);
  EXPECT_THAT(close.output, AllOf(HasSubstr("Object 1 would be launched at 1.02 s"),
                                  HasSubstr("m inside object 0")));
}

TEST_F(ScenarioCommandTest, ImpossibleThrowsAreFoundInEveryCell) {
  write("cells.yaml",
        "pilot: none\nrepeats: 200\n"
        "sweep: {delays.compute_us: [3500, 60000]}\n"
        "grid: {throw.size_m: [0.1, 0.2],\n"
        "       throw.distance_m: [3, 20]}\n"
        "throw: {launch_s: 5}\n");
  const Outcome cells = dodgesim("validate " + path("cells.yaml"));
  EXPECT_EQ(cells.exit_code, 2);
  EXPECT_THAT(cells.output, AllOf(::testing::StartsWith(path("cells.yaml") + ":5:"),
                                  HasSubstr("throw.distance_m 20, delays.compute_us")));
  write("two.yaml", "pilot: none\nthrows:\n- {launch_s: 0.1}\n- {launch_s: 0.1, distance_m: 20}\n");
  EXPECT_THAT(dodgesim("validate " + path("two.yaml")).output,
              AllOf(::testing::StartsWith(path("two.yaml") + ":3:"),
                    HasSubstr("In throw 0: Object 1: The throw starts at")));
}

TEST_F(ScenarioCommandTest, BadSettingsAreUsageErrors) {
  const std::string validate = "validate " + path("s.yaml");
  const Outcome typo = dodgesim(validate + " --set throw.spede_mps=3");
  EXPECT_EQ(typo.exit_code, 2);
  EXPECT_EQ(typo.output,
            "--set throw.spede_mps=3: throw.spede_mps is not a known key; did you mean "
            "throw.speed_mps?\n");
  EXPECT_EQ(dodgesim(validate + " --set nonsense").exit_code, 2);
  EXPECT_EQ(dodgesim(validate + " --set 'throw.speed_mps=[1'").exit_code, 2);
  const Outcome empty = dodgesim(validate + " --set throw.speed_mps=");
  EXPECT_EQ(empty.exit_code, 2);
  EXPECT_THAT(empty.output, HasSubstr("--set throw.speed_mps=: A value is needed behind ="));
  EXPECT_EQ(dodgesim(validate + " --set 'throw.speed_mps= '").exit_code, 2);
  EXPECT_EQ(dodgesim(validate + " --set throw.speed_mps=~").exit_code, 0);
  EXPECT_EQ(dodgesim("sweep " + path("s.yaml") + " --out x").exit_code, 2) << "over nothing";
  const Outcome twice = dodgesim("sweep " + path("s.yaml") +
                                 " --out x --over throw.size_m=0.1 --over throw.size_m=0.2");
  EXPECT_EQ(twice.exit_code, 2);
  EXPECT_THAT(twice.output, HasSubstr("--over throw.size_m=0.2: throw.size_m is swept already"));
  const Outcome by_two_names =
      dodgesim("sweep " + path("s.yaml") + " --out x --over throw.size_m=0.1 --over size_m=0.2");
  EXPECT_EQ(by_two_names.exit_code, 2);
  EXPECT_THAT(by_two_names.output, HasSubstr("--over size_m=0.2: size_m is swept already"));
  const Outcome places =
      dodgesim("sweep " + path("s.yaml") + " --out x --over 'mission.start_m=[0,0,1],[0,0,-1]'");
  EXPECT_EQ(places.exit_code, 2);
  EXPECT_THAT(places.output, HasSubstr("cannot be at (0, 0, -1) m"));
  const Outcome over = dodgesim("sweep " + path("s.yaml") + " --out x --over delays.compute_us=-1");
  EXPECT_EQ(over.exit_code, 2);
  EXPECT_THAT(over.output, HasSubstr("--over delays.compute_us=-1: delays.compute_us is -1, but"));
  std::string many = "!uniform [1, 8]";
  for (int i = 1; i < 1640; ++i) many += ", !uniform [1, 8." + std::to_string(1000 + i) + "]";
  const Outcome values =
      dodgesim("sweep " + path("s.yaml") + " --out x --over 'throw.speed_mps=" + many + "'");
  EXPECT_EQ(values.exit_code, 2);
  EXPECT_THAT(values.output,
              AllOf(::testing::StartsWith("--over throw.speed_mps=!uniform [1, 8], "),
                    HasSubstr("...: There are more than 5000 values, which no such file needs.")));
}

TEST_F(ScenarioCommandTest, ASweepFliesTheSameThrowsAndItsTablesStayApart) {
  const Outcome run =
      dodgesim("sweep " + path("s.yaml") + " -j 2 --out " + path("swept") +
               " --set grid.size_m=[0.1,0.2] --over controller.velocity_gain_xy_1ps=2,4");
  ASSERT_EQ(run.exit_code, 0) << run.output;
  EXPECT_THAT(run.output, AllOf(HasSubstr("\n| 2 | 0.1 | "), HasSubstr("\n| 4 | all | "),
                                HasSubstr("table.md has more")));
  EXPECT_THAT(contents("swept/table.md"),
              AllOf(HasSubstr("# controller.velocity_gain_xy_1ps 2\n"),
                    HasSubstr("# controller.velocity_gain_xy_1ps 4\n")));
  const auto sweep = column("swept/throws.csv", "sweep");
  EXPECT_EQ(sweep, (std::vector<std::string>{"0", "0", "0", "0", "1", "1", "1", "1"}));
  EXPECT_EQ(column("swept/throws.csv", "cell"),
            (std::vector<std::string>{"0", "1", "0", "1", "0", "1", "0", "1"}));
  const auto speeds = column("swept/throws.csv", "speed_mps");
  for (std::size_t i = 0; i < 4; ++i) EXPECT_EQ(speeds[i], speeds[i + 4]);
  EXPECT_NE(speeds[0], speeds[1]);
  const auto gains = column("swept/throws.csv", "controller.velocity_gain_xy_1ps");
  EXPECT_EQ(gains.front() + gains.back(), "24");

  const Outcome replay = dodgesim("replay " + path("swept") + " --throw 7");
  EXPECT_EQ(replay.exit_code, 0) << replay.output;
  EXPECT_EQ(dodgesim("replay " + path("swept") + " --throw 8").exit_code, 2);

  for (const char* part : {"0", "1", "2"}) {
    dodgesim("sweep " + path("s.yaml") + " --out " + path(std::string("part") + part) +
             " --set grid.size_m=[0.1,0.2] --over controller.velocity_gain_xy_1ps=2,4 --shard " +
             part + "/3");
  }
  const Outcome merged = dodgesim("merge " + path("part0") + " " + path("part1") + " " +
                                  path("part2") + " --out " + path("merged"));
  EXPECT_EQ(merged.exit_code, 0) << merged.output;
  for (const char* file : {"/throws.csv", "/objects.csv", "/table.md", "/table.csv"}) {
    EXPECT_EQ(contents(std::string("merged") + file), contents(std::string("swept") + file));
  }
}

TEST_F(ScenarioCommandTest, EveryObjectHasARow) {
  write("two.yaml",
        "extends: s.yaml\nthrow: ~\nthrows: [{launch_s: 0.1}, {count: 2, interval_s: 0.2}]\n");
  const Outcome run = dodgesim("run " + path("two.yaml") + " --out " + path("two"));
  ASSERT_EQ(run.exit_code, 0) << run.output;
  EXPECT_EQ(column("two/throws.csv", "objects"), (std::vector<std::string>{"3", "3"}));
  EXPECT_EQ(column("two/objects.csv", "throw"),
            (std::vector<std::string>{"0", "0", "0", "1", "1", "1"}));
  EXPECT_EQ(column("two/objects.csv", "object"),
            (std::vector<std::string>{"0", "1", "2", "0", "1", "2"}));
}

TEST_F(ScenarioCommandTest, AMissionTooFastToEndIsNamed) {
  const auto validate = [&](const std::string& speed) {
    return dodgesim("validate " + path("s.yaml") + " --set mission.type=goal --set " +
                    "'mission.goal_m=[2, 0, 2]' --set mission.speed_mps=" + speed);
  };
  const Outcome fast = validate("5");
  EXPECT_EQ(fast.exit_code, 0);
  EXPECT_THAT(fast.output, HasSubstr("mission.speed_mps is 5, but dodger.attractive.e_0_m is 0.2: "
                                     "below 1 m the nominal vehicle swings"));
  EXPECT_THAT(validate("2").output, Not(HasSubstr("swings")));
}

}  // namespace

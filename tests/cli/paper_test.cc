// The experiments of the paper, as their users fly them.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "tests/cli/command_test.h"

namespace {

using dodgesim::testing::dodgesim;
using dodgesim::testing::Outcome;
using dodgesim::testing::shell;
using ::testing::HasSubstr;

// One speed, two sizes, and the end soon after.
constexpr const char* kQuick =
    " --set 'grid.speed_mps=[6]' --set 'grid.size_m=[0.1,0.2]' --set after_s=0.1";

class PaperCommandTest : public dodgesim::testing::CommandTest {};

TEST_F(PaperCommandTest, NamesTheExperimentsThereAre) {
  const Outcome outcome = dodgesim("paper table9 --out " + path("out"));
  EXPECT_EQ(outcome.exit_code, 2);
  EXPECT_THAT(outcome.output, HasSubstr("There is no experiment \"table9\"; there are table1, "));
  EXPECT_THAT(dodgesim("paper --help").output, HasSubstr("table2    Table 2: success rate"));
}

TEST_F(PaperCommandTest, MakesTheSameTablesAgain) {
  const auto fly = [&](const std::string& out, const std::string& options) {
    return dodgesim(
        "paper table2 --throws 1 --seed 3 --set sensors.camera.width=160 "
        "--set sensors.camera.height=120 --out " +
        path(out) + " " + options);
  };
  const Outcome made = fly("a", "-j 2");
  EXPECT_EQ(made.exit_code, 0) << made.output;
  EXPECT_THAT(made.output, HasSubstr("| size | <= 0.5 m | paper |"));
  EXPECT_EQ(fly("b", "-j 1").exit_code, 0);
  EXPECT_EQ(fly("b", "--resume").exit_code, 0);
  for (const char* file : {"table2.md", "table2.csv", "README.md"}) {
    EXPECT_EQ(contents(std::string("a/") + file), contents(std::string("b/") + file)) << file;
  }
  EXPECT_THAT(contents("a/table2.md"),
              HasSubstr("`dodgesim paper table2 --set sensors.camera.width=160 "
                        "--set sensors.camera.height=120 --throws 1 --seed 3`"));
  EXPECT_EQ(fly("b", "").exit_code, 2) << "without --force or --resume";
}

TEST_F(PaperCommandTest, DoesNotMeasureOverATable) {
  std::filesystem::create_directory(path("out"));
  std::ofstream(path("out/table3.md")) << "mine";
  const Outcome outcome = dodgesim("paper table3 --out " + path("out"));
  EXPECT_EQ(outcome.exit_code, 2);
  EXPECT_THAT(outcome.output, HasSubstr("table3.md was measured before; choose another"));
  EXPECT_EQ(contents("out/table3.md"), "mine");
}

TEST_F(PaperCommandTest, WithoutASeedFliesThatOfEveryScenario) {
  ASSERT_EQ(dodgesim("paper physics --throws 1 --out " + path("own") + kQuick).exit_code, 0);
  EXPECT_THAT(contents("own/physics.md"), HasSubstr("- 2 throws, seed 4007: "));
  const Outcome bad = dodgesim("paper physics --seed x --out " + path("bad"));
  EXPECT_EQ(bad.exit_code, 2);
  EXPECT_THAT(bad.output, HasSubstr("--seed x: seed is \"x\", but must be a whole number"));
}

// Eleven campaigns in the same workers.
TEST_F(PaperCommandTest, GivesTheSameFilesForAnyNumberOfWorkersAndAfterAStop) {
  const auto fly = [&](const std::string& out, const std::string& options) {
    return "paper physics --throws 1 --seed 3 --out " + path(out) + kQuick + " " + options;
  };
  ASSERT_EQ(dodgesim(fly("one", "-j 1")).exit_code, 0);
  EXPECT_THAT(contents("one/physics.md"),
              ::testing::AllOf(HasSubstr("- 2 throws, seed 3004007: "),
                               HasSubstr("--set seed=3004007`"), HasSubstr("--seed 3`")))
      << "out of reach of the seeds of the other scenarios";
  ASSERT_EQ(dodgesim(fly("three", "-j 3")).exit_code, 0);
  const Outcome stopped =
      shell("(" + std::string(DODGESIM_BINARY_DIR) + "/dodgesim " + fly("stopped", "-j 2 & ") +
            "while kill -0 $! && ! [ -e " + path("stopped/flights/physics_1_5m/manifest.json") +
            " ]; do sleep 0.02; done; kill -TERM $!; wait $!)");
  EXPECT_EQ(stopped.exit_code, 3);
  EXPECT_THAT(stopped.output, HasSubstr("of 11 campaigns; the same command with --resume"));
  ASSERT_EQ(dodgesim(fly("stopped", "--resume")).exit_code, 0);
  for (const char* file : {"physics.csv", "flights/physics_1_5m/throws.csv",
                           "flights/physics_middle/throws.csv", "flights/physics_slow/table.md"}) {
    const std::string whole = contents(std::string("one/") + file);
    EXPECT_EQ(contents(std::string("three/") + file), whole) << file;
    EXPECT_EQ(contents(std::string("stopped/") + file), whole) << file;
  }
}

TEST_F(PaperCommandTest, RefusesCampaignsThatEndEarly) {
  const Outcome outcome =
      dodgesim("paper shapes --out " + path("out") + " --set 'stop={half_width: 0.1}'");
  EXPECT_EQ(outcome.exit_code, 2);
  EXPECT_EQ(outcome.output, "The paper's tables need every throw: no key stop.\n");
}

// The oracle's campaign, over the open field, would be flown first.
TEST_F(PaperCommandTest, TriesAllModelsBeforeTheFirstFlight) {
  const Outcome outcome = dodgesim("paper latency --throws 1 --out " + path("out") +
                                   " --set 'mission.start_m=[5.95, 0, 2]'");
  EXPECT_EQ(outcome.exit_code, 2);
  EXPECT_THAT(outcome.output, ::testing::AllOf(HasSubstr("The vehicle cannot be at (5.95, 0, 2)"),
                                               ::testing::Not(HasSubstr("Flying"))));
}

}  // namespace

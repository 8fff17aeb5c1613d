// Campaigns in parts, from the command line.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "tests/cli/command_test.h"

namespace {

namespace fs = std::filesystem;
using dodgesim::testing::CommandTest;
using dodgesim::testing::dodgesim;
using dodgesim::testing::Outcome;
using ::testing::HasSubstr;

class CampaignCommandTest : public CommandTest {
 protected:
  CampaignCommandTest() {
    write("s.yaml", "seed: 3\nrepeats: 6\npilot: oracle\nafter_s: 0.1\nthrow: {launch_s: 0.1}\n");
  }

  Outcome run(const std::string& out, const std::string& options = "") const {
    return dodgesim("run " + (root_ / "s.yaml").string() + " -j 2 --out " + path(out) + " " +
                    options);
  }
};

TEST_F(CampaignCommandTest, PartsMergeToTheWhole) {
  EXPECT_EQ(run("whole").exit_code, 0);
  EXPECT_EQ(run("a", "--shard 0/2").exit_code, 0);
  const Outcome early = dodgesim("merge " + path("a") + " --out " + path("early"));
  EXPECT_EQ(early.exit_code, 3);
  EXPECT_THAT(early.output, HasSubstr("3 of 6 throws are missing: 1, 3, 5."));
  EXPECT_FALSE(fs::exists(root_ / "early"));
  EXPECT_EQ(run("b", "--shard 1/2").exit_code, 0);
  const Outcome merged =
      dodgesim("merge " + path("b") + " " + path("a") + " " + path("b") + " --out " + path("all"));
  EXPECT_EQ(merged.exit_code, 0) << merged.output;
  expect_same("whole", "all");
}

TEST_F(CampaignCommandTest, ResultsAreNeitherLostNorFlownTwice) {
  EXPECT_EQ(run("out").exit_code, 0);
  const std::string before = contents("out/throws.csv");
  const Outcome again = run("out");
  EXPECT_EQ(again.exit_code, 2);
  EXPECT_THAT(again.output, HasSubstr("holds results of 6 throws; run it with --resume"));
  EXPECT_EQ(contents("out/throws.csv"), before);
  EXPECT_EQ(run("out", "--resume").exit_code, 0);
  EXPECT_EQ(contents("out/throws.csv"), before);
  EXPECT_EQ(run("out", "--resume --throws 7").exit_code, 2);
  EXPECT_EQ(run("out", "--force --throws 7").exit_code, 0);
  EXPECT_NE(contents("out/throws.csv"), before);
}

TEST_F(CampaignCommandTest, RefusesPartsThatAreNone) {
  const Outcome outcome = run("out", "--shard 2/2");
  EXPECT_EQ(outcome.exit_code, 2);
  EXPECT_THAT(outcome.output, HasSubstr("there is no shard 2 of 2"));
}

}  // namespace

// The regression gate and the comparison, as their users run them, with throws that nobody dodges.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>

#include "tests/cli/command_test.h"
#include "tests/models.h"

namespace {

namespace fs = std::filesystem;
using dodgesim::testing::copy_models;
using dodgesim::testing::dodgesim;
using dodgesim::testing::Outcome;
using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;

class GateCommandTest : public dodgesim::testing::CommandTest {
 protected:
  GateCommandTest() {
    write("s.yaml",
          "seed: 3\nrepeats: 3\npilot: none\nfly_oracle: false\nafter_s: 0.1\n"
          "throws: [{launch_s: 0.1}, {launch_s: 0.2, count: 2, interval_s: 0.2, "
          "speed_mps: !uniform [5, 8]}]\n");
  }

  Outcome gate(const std::string& options = "", int workers = 1) const {
    return dodgesim("gate " + path("s.yaml") + " --baseline " + path("b") + " --out " +
                    path("out") + " --force -j " + std::to_string(workers) + " " + options);
  }
  // The text of `file` with `from` replaced.
  void edit(const std::string& file, const std::string& from, const std::string& to) const {
    std::string text = contents(file);
    const std::size_t at = text.find(from);
    ASSERT_NE(at, std::string::npos) << from;
    write(file, text.replace(at, from.size(), to));
  }
};

TEST_F(GateCommandTest, PassesWhatItHasMade) {
  EXPECT_THAT(gate().output, HasSubstr("There is no baseline in " + path("b")));
  const Outcome made = gate("--update --must-equal all");
  EXPECT_EQ(made.exit_code, 0) << made.output;
  EXPECT_THAT(made.output, HasSubstr("(margin 0.05, confidence 0.95, must equal: all)"));
  const Outcome again = gate("", 2);
  EXPECT_EQ(again.exit_code, 0) << again.output;
  EXPECT_THAT(again.output,
              AllOf(HasSubstr("passed: same throws\n"), HasSubstr("passed: same bytes\n")));
}

TEST_F(GateCommandTest, NamesTheKeyThatMakesOtherThrows) {
  ASSERT_EQ(gate("--update").exit_code, 0);
  const Outcome seed = gate("--set seed=4");
  EXPECT_EQ(seed.exit_code, 2);
  EXPECT_THAT(seed.output,
              HasSubstr("Throw 0 is another one than in " + path("b") + " (seed is 4, not 3); "));
  EXPECT_THAT(gate("--set repeats=4").output,
              HasSubstr("4 throws, " + path("b") + " has 3 (repeats is 4, not 3)"));
  EXPECT_THAT(gate("--set stop.half_width=0.2").output,
              HasSubstr("a gate's scenario has no key stop"));
  EXPECT_EQ(gate("--set stop.half_width=0.2 --set stop=~").exit_code, 0);
}

TEST_F(GateCommandTest, NoticesThrowsOfOtherCells) {
  const std::string grid = "--set repeats=6 --set 'grid={delays.compute_us: [0, 3500]}'";
  ASSERT_EQ(gate("--update " + grid).exit_code, 0);
  const Outcome other = gate("--set repeats=4 --set 'grid={delays.compute_us: [0, 3500, 9000]}'");
  EXPECT_EQ(other.exit_code, 2);
  EXPECT_THAT(other.output, HasSubstr("Throw 2 is another one than in " + path("b")));
}

TEST_F(GateCommandTest, NoticesAnotherSecondObject) {
  ASSERT_EQ(gate("--update").exit_code, 0);
  edit("b/objects.csv", "\n0,2,ball,0.2,", "\n0,2,ball,0.21,");
  EXPECT_THAT(gate().output, HasSubstr("Throw 0 is another one than in " + path("b") +
                                       " (the scenario is the same"));
  fs::remove(root_ / "b/objects.csv");
  EXPECT_THAT(gate().output, HasSubstr("objects.csv is missing"));
}

TEST_F(GateCommandTest, LeavesNoEarlierVerdictBehindWhenItEndsWithoutOne) {
  ASSERT_EQ(gate("--update").exit_code, 0);
  ASSERT_EQ(gate().exit_code, 0);
  ASSERT_TRUE(fs::exists(root_ / "out/junit.xml"));
  EXPECT_EQ(gate("--set seed=9").exit_code, 2);
  EXPECT_FALSE(fs::exists(root_ / "out/junit.xml"));
}

// As if another libm had rounded a throw's speed; the baseline is of another machine, then.
TEST_F(GateCommandTest, PairsThrowsOfAnotherLibm) {
  ASSERT_EQ(gate("--update").exit_code, 0);
  edit("b/throws.csv", ",6,3,", ",6.0000000000000009,2.9999999999999996,");
  edit("b/manifest.json", "\"compiler\": \"", "\"compiler\": \"other ");
  const Outcome outcome = gate();
  EXPECT_THAT(outcome.output, AllOf(HasSubstr("passed: same throws\n"),
                                    HasSubstr("left out: same bytes of the physics")));
  EXPECT_EQ(outcome.exit_code, 1) << "nothing of three throws without a pilot can fail elsewhere";
}

TEST_F(GateCommandTest, UpdateReplacesABrokenBaseline) {
  ASSERT_EQ(gate("--update --margin 0.1").exit_code, 0);
  write("b/notes.txt", "why");
  fs::resize_file(root_ / "b/throws.csv", fs::file_size(root_ / "b/throws.csv") - 40);
  const Outcome broken = gate();
  EXPECT_EQ(broken.exit_code, 4);
  EXPECT_THAT(broken.output, AllOf(HasSubstr("throws.csv:4: There are"),
                                   HasSubstr("To make the baseline anew, add --update.")));
  const Outcome repaired = gate("--update");
  EXPECT_EQ(repaired.exit_code, 0) << repaired.output;
  EXPECT_THAT(repaired.output, AllOf(HasSubstr(path("b") + " is broken and will be replaced: "),
                                     HasSubstr("(margin 0.1, ")));
  EXPECT_EQ(gate().exit_code, 0);
  EXPECT_EQ(contents("b/notes.txt"), "why");

  const std::string whole = contents("b/throws.csv");
  write("b/throws.csv", whole.substr(0, whole.rfind('\n', whole.size() - 2) + 1));
  const Outcome cut = gate();
  EXPECT_EQ(cut.exit_code, 4);
  EXPECT_THAT(cut.output, HasSubstr("throws.csv has 2 of the 3 throws of its scenario"));
  EXPECT_EQ(gate("--update").exit_code, 0);
  EXPECT_EQ(contents("b/throws.csv"), whole);

  edit("b/manifest.json", "\"commit\"", "\"comet\"");
  EXPECT_EQ(gate().exit_code, 4);
  EXPECT_EQ(gate("--update").exit_code, 0);
  EXPECT_EQ(gate().exit_code, 0);
}

TEST_F(GateCommandTest, UpdateNeverWritesOverWhatIsNoBaseline) {
  ASSERT_EQ(gate("--update").exit_code, 0);
  fs::rename(root_ / "out", root_ / "campaign");
  const std::string manifest = contents("campaign/manifest.json");
  fs::remove_all(root_ / "b");
  fs::rename(root_ / "campaign", root_ / "b");
  const Outcome refused = gate("--update");
  EXPECT_EQ(refused.exit_code, 4);
  EXPECT_THAT(refused.output, HasSubstr(path("b") + " is not empty, but no baseline: "));
  EXPECT_EQ(contents("b/manifest.json"), manifest);
  EXPECT_FALSE(fs::exists(root_ / "out")) << "nothing is flown in vain";
}

TEST_F(GateCommandTest, UpdateFliesNothingForABaselineThatCannotBeWritten) {
  fs::remove_all(root_ / "b");
  const std::string gate_into =
      "gate " + path("s.yaml") + " --out " + path("out") + " --update --baseline ";
  const Outcome nameless = dodgesim(gate_into + "''");
  EXPECT_EQ(nameless.exit_code, 2);
  EXPECT_THAT(nameless.output, HasSubstr("--baseline: nothing was given"));
  write("file", "");
  const Outcome below_a_file = dodgesim(gate_into + path("file/b"));
  EXPECT_EQ(below_a_file.exit_code, 4);
  EXPECT_THAT(below_a_file.output,
              HasSubstr("--baseline " + path("file/b") + " cannot be written"));
  EXPECT_FALSE(fs::exists(root_ / "out"));
}

TEST_F(GateCommandTest, FliesNothingForAVerdictThatCannotBeWritten) {
  ASSERT_EQ(gate("--update").exit_code, 0);
  fs::remove_all(path("out"));
  const Outcome outcome = gate("--junit " + path("s.yaml") + "/x.xml");
  EXPECT_EQ(outcome.exit_code, 4);
  EXPECT_THAT(outcome.output, HasSubstr("--junit " + path("s.yaml") + "/x.xml cannot be written"));
  EXPECT_FALSE(fs::exists(path("out")));
}

TEST_F(GateCommandTest, ReplacesNothingButAnEarlierVerdict) {
  ASSERT_EQ(gate("--update").exit_code, 0);
  fs::remove_all(path("out"));
  write("other.xml", "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<mujoco/>\n");
  write("empty.xml", "");
  EXPECT_THAT(gate("--junit " + path("none/x.xml")).output, HasSubstr("there is no such folder"));
  for (const std::string name : {"s.yaml", "b/throws.csv", "b", "other.xml"}) {
    const bool file = fs::is_regular_file(path(name));
    const std::string before = file ? contents(path(name)) : "";
    const Outcome outcome = gate("--junit " + path(name));
    EXPECT_EQ(outcome.exit_code, 4);
    EXPECT_THAT(outcome.output, HasSubstr("--junit " + path(name) + " exists, and is no JUnit"));
    EXPECT_EQ(file ? contents(path(name)) : "", before);
  }
  EXPECT_FALSE(fs::exists(path("out")));
  fs::create_directory(path("out"));
  write("out/junit.xml", "<report of=\"somebody else\"/>\n");
  const Outcome by_default = gate();
  EXPECT_EQ(by_default.exit_code, 4);
  EXPECT_THAT(by_default.output, HasSubstr("junit.xml exists, and is no JUnit report"));
  EXPECT_EQ(contents("out/junit.xml"), "<report of=\"somebody else\"/>\n");
  fs::remove_all(path("out"));
  EXPECT_EQ(gate("--junit " + path("empty.xml")).exit_code, 0);
  fs::remove_all(path("out"));
  EXPECT_EQ(gate("--junit " + path("empty.xml")).exit_code, 0) << "an earlier verdict";
}

TEST_F(GateCommandTest, DoesNotWaitForPipes) {
  ASSERT_EQ(::mkfifo(path("b").c_str(), 0600), 0);
  EXPECT_THAT(gate("--update").output, HasSubstr(path("b") + " is not a directory."));
  fs::remove(root_ / "b");
  ASSERT_EQ(gate("--update").exit_code, 0);
  fs::remove(root_ / "b/throws.csv");
  ASSERT_EQ(::mkfifo(path("b/throws.csv").c_str(), 0600), 0);
  EXPECT_THAT(gate().output, HasSubstr("b/throws.csv is not a regular file."));
  EXPECT_THAT(gate("--update").output, HasSubstr("b/throws.csv is not a regular file."));
  fs::remove(root_ / "b/throws.csv");
  EXPECT_EQ(gate("--update").exit_code, 0);
  EXPECT_EQ(gate().exit_code, 0);
  fs::remove(root_ / "s.yaml");
  ASSERT_EQ(::mkfifo(path("s.yaml").c_str(), 0600), 0);
  const Outcome outcome = gate();
  EXPECT_EQ(outcome.exit_code, 2);
  EXPECT_THAT(outcome.output, HasSubstr("s.yaml: This is not a regular file"));
}

TEST_F(GateCommandTest, CompareSaysWhichThrowsItLeavesOut) {
  const std::string run = "run " + path("s.yaml") + " -j 1 --out ";
  ASSERT_EQ(dodgesim(run + path("three")).exit_code, 0);
  ASSERT_EQ(dodgesim(run + path("two") + " --throws 2").exit_code, 0);
  const Outcome outcome = dodgesim("compare " + path("three") + " " + path("two"));
  EXPECT_EQ(outcome.exit_code, 0) << outcome.output;
  EXPECT_THAT(outcome.output,
              AllOf(HasSubstr("of the same throws"),
                    HasSubstr("because only " + path("three") + " has them: throws 2\n")));
  fs::remove(path("two") + "/throws.csv");  // as long as it is flown
  const Outcome unfinished = dodgesim("compare " + path("three") + " " + path("two"));
  EXPECT_EQ(unfinished.exit_code, 3);
  EXPECT_THAT(unfinished.output, HasSubstr(path("two") + " is not finished, "));
}

TEST_F(GateCommandTest, CompareBeginsWithThePilotOnWhichOtherKeysDepend) {
  const std::string run = "run " + path("s.yaml") + " -j 1 --throws 1 --out ";
  ASSERT_EQ(dodgesim(run + path("a") + " --set pilot=none").exit_code, 0);
  ASSERT_EQ(
      dodgesim(run + path("b") + " --set pilot=oracle --set delays.compute_us=2000").exit_code, 0);
  const std::string text = dodgesim("compare " + path("a") + " " + path("b")).output;
  const std::size_t pilot = text.find("  pilot: none, then oracle\n");
  EXPECT_LT(pilot, text.find("  delays.compute_us: ")) << text;
}

TEST_F(GateCommandTest, ComparePairsTheThrowsOfASweepWhateverTheRepeats) {
  const std::string sweep =
      "sweep " + path("s.yaml") + " -j 1 --over delays.compute_us=0,3500 --out ";
  ASSERT_EQ(dodgesim(sweep + path("three")).exit_code, 0);
  ASSERT_EQ(dodgesim(sweep + path("four") + " --throws 4").exit_code, 0);
  const std::string text = dodgesim("compare " + path("three") + " " + path("four")).output;
  EXPECT_THAT(text, Not(HasSubstr("of different throws")));
  EXPECT_THAT(text, HasSubstr("because only " + path("four") + " has them: throws 3\n"));
  EXPECT_THAT(text, HasSubstr("because only " + path("four") + " has them: throws 7\n"));
  EXPECT_THAT(text, HasSubstr("These are 2 tests: where nothing differs, the smallest p is below "
                              "0.025 (0.05 / 2) in at most\n5 %"));
  ASSERT_EQ(dodgesim("run " + path("s.yaml") + " --out " + path("plain")).exit_code, 0);
  const Outcome plain = dodgesim("compare " + path("plain") + " " + path("three"));
  EXPECT_EQ(plain.exit_code, 2);
  EXPECT_EQ(plain.output,
            path("plain") + " has no sweep, or only its first value; " + path("three") +
                " has 2 sweep values (number 0, 1). Campaigns can be compared if they have the "
                "same sweep.\n");
}

TEST_F(GateCommandTest, ComparesTheValuesOfASweepThrowByThrow) {
  write("field.yaml",
        "seed: 3\nrepeats: 3\nroom: field\nfly_oracle: false\nafter_s: 0.1\n"
        "throw: {launch_s: 0.1}\n");
  const std::string scenario = path("field.yaml") + " --out ";
  ASSERT_EQ(dodgesim("sweep " + scenario + path("both") + " --over pilot=none,oracle").exit_code,
            0);
  const Outcome both = dodgesim("compare " + path("both"));
  EXPECT_EQ(both.exit_code, 0) << both.output;
  EXPECT_THAT(both.output,
              AllOf(HasSubstr("Sweep value 0 (pilot none): 0 of 3 succeeded"),
                    HasSubstr("Sweep value 1 (pilot oracle): 3 of 3 succeeded"),
                    HasSubstr("of the same throws: 0 lost, 3 gained"),
                    HasSubstr("throw 0, then 3 (0.2 m ball, 6 m/s from 3 m): hit, then dodged")));
  EXPECT_THAT(dodgesim("compare " + path("both") + " --against 1").output,
              HasSubstr("3 lost, 0 gained"));

  // The same as of two campaigns.
  for (const std::string pilot : {"none", "oracle"}) {
    ASSERT_EQ(dodgesim("run " + scenario + path(pilot) + " --set pilot=" + pilot).exit_code, 0);
  }
  const std::string apart = dodgesim("compare " + path("none") + " " + path("oracle")).output;
  const std::size_t difference = both.output.find("Difference: ");
  ASSERT_NE(difference, std::string::npos);
  EXPECT_THAT(apart, HasSubstr(both.output.substr(
                         difference, both.output.find('\n', difference) - difference)));
}

TEST_F(GateCommandTest, CompareOfOneCampaignNeedsTwoSweepValues) {
  ASSERT_EQ(dodgesim("run " + path("s.yaml") + " --out " + path("plain")).exit_code, 0);
  const Outcome plain = dodgesim("compare " + path("plain"));
  EXPECT_EQ(plain.exit_code, 2);
  EXPECT_EQ(plain.output, path("plain") +
                              " has no sweep, or only its first value: name a second campaign to "
                              "compare it with.\n");
  ASSERT_EQ(dodgesim("sweep " + path("s.yaml") + " --over delays.compute_us=0,3500 --out " +
                     path("swept"))
                .exit_code,
            0);
  EXPECT_EQ(dodgesim("compare " + path("swept") + " --against 2").output,
            "--against 2: " + path("swept") + " has 2 sweep values (number 0, 1).\n");
}

TEST_F(GateCommandTest, ComparePairsThrowsOfOneSeedAndSaysWhatDiffers) {
  write("one.yaml",
        "seed: 3\nrepeats: 3\npilot: none\nfly_oracle: false\nafter_s: 0.1\n"
        "throw: {launch_s: 0.1, speed_mps: !uniform [5, 8]}\n");
  const std::string run = "run " + path("one.yaml") + " --out ";
  ASSERT_EQ(dodgesim(run + path("small")).exit_code, 0);
  ASSERT_EQ(dodgesim(run + path("large") + " --set throw.size_m=0.3").exit_code, 0);
  EXPECT_THAT(dodgesim("compare " + path("small") + " " + path("large")).output,
              AllOf(HasSubstr("of throws with the same random numbers (size_m differs): 0 lost"),
                    Not(HasSubstr("These are"))));
}

TEST_F(GateCommandTest, CompareRefusesDifferentThrowsOfDifferentCells) {
  const std::string run = "run " + path("s.yaml") + " -j 1 --set grid.size_m=[0.1,0.2] --out ";
  ASSERT_EQ(dodgesim(run + path("whole")).exit_code, 0);
  ASSERT_EQ(dodgesim(run + path("part") + " --shard 0/2").exit_code, 0);
  ASSERT_EQ(dodgesim(run + path("other") + " --shard 0/2 --seed 4").exit_code, 0);
  EXPECT_EQ(dodgesim("compare " + path("whole") + " " + path("part")).exit_code, 0) << "pairs";
  const Outcome outcome = dodgesim("compare " + path("whole") + " " + path("other"));
  EXPECT_EQ(outcome.exit_code, 2);
  EXPECT_THAT(outcome.output, HasSubstr(path("whole") + " has throws of throw.size_m 0.2, " +
                                        path("other") + " has none; "));
}

TEST_F(GateCommandTest, CompareSaysWhichCampaignEndedByItsResults) {
  write("one.yaml",
        "repeats: 30\npilot: none\nfly_oracle: false\nafter_s: 0.1\nthrow: {launch_s: 0.1}\n");
  const std::string run = "run " + path("one.yaml") + " -j 1 --out ";
  ASSERT_EQ(dodgesim(run + path("all")).exit_code, 0);
  ASSERT_EQ(dodgesim(run + path("stopped") + " --set stop.half_width=0.3").exit_code, 0);
  const Outcome outcome = dodgesim("compare " + path("all") + " " + path("stopped"));
  EXPECT_EQ(outcome.exit_code, 0) << outcome.output;
  EXPECT_THAT(outcome.output, AllOf(HasSubstr(path("stopped") + " has "),
                                    HasSubstr("Its own rate ended it (stop)")));
}

TEST_F(GateCommandTest, CompareDoesNotPairFlightsOfDifferentSeeds) {
  write("quiet.yaml", "pilot: none\nfly_oracle: false\nduration_s: 0.1\nrepeats: 2\n");
  const std::string run = "run " + path("quiet.yaml") + " --out ";
  ASSERT_EQ(dodgesim(run + path("one")).exit_code, 0);
  ASSERT_EQ(dodgesim(run + path("other") + " --seed 2").exit_code, 0);
  EXPECT_THAT(dodgesim("compare " + path("one") + " " + path("one")).output,
              AllOf(HasSubstr("of the same throws"), Not(HasSubstr("differ:"))));
  EXPECT_THAT(dodgesim("compare " + path("one") + " " + path("other")).output,
              AllOf(::testing::StartsWith("The scenarios differ:\n  seed: 1, then 2\n"),
                    HasSubstr("of different throws")));
}

TEST_F(GateCommandTest, CompareSaysThatTheModelsDiffer) {
  const fs::path models = copy_models(root_);
  write("one.yaml", "pilot: none\nfly_oracle: false\nafter_s: 0.1\nthrow: {launch_s: 0.1}\n");
  const std::string run = "run " + path("one.yaml") + " --models " + models.string() + " --out ";
  ASSERT_EQ(dodgesim(run + path("light")).exit_code, 0);
  std::string ball = contents(models / "objects/ball.xml");
  ball.insert(ball.find("mass=\"") + 6, "1");
  write("models/objects/ball.xml", ball);
  ASSERT_EQ(dodgesim(run + path("heavy")).exit_code, 0);
  EXPECT_THAT(dodgesim("compare " + path("light") + " " + path("heavy")).output,
              AllOf(::testing::StartsWith("The models differ (room, vehicle or objects).\n"),
                    HasSubstr("of throws with the same random numbers (a model differs): 0 lost")));
  EXPECT_THAT(dodgesim("compare " + path("light") + " " + path("light")).output,
              AllOf(Not(HasSubstr("models")), HasSubstr("of the same throws")));
}

TEST_F(GateCommandTest, CompareSaysWhatCouldNotBeFlown) {
  write("floor.yaml",
        "pilot: none\nfly_oracle: false\nrepeats: 2\n"
        "throw: {distance_m: 2, size_m: 0.3, launch_height_m: 0.1, launch_s: 0.1}\n");
  dodgesim("run " + path("floor.yaml") + " --out " + path("floor"));
  EXPECT_THAT(dodgesim("compare " + path("floor") + " " + path("floor")).output,
              HasSubstr("In " + path("floor") + " 2 throws could not be flown, whoever the pilot"));
}

}  // namespace

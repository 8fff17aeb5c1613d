// Campaigns that a user's own pilot flies.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/cli/command_test.h"

namespace dodgesim::testing {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

class PluginTest : public CommandTest {
 protected:
  const std::string small_pictures_ = "sensors: {camera: {width: 64, height: 48}}\n";

  PluginTest() {
    write("s.yaml", small_pictures_ + "pilot: plugin\nduration_s: 0.1\nrepeats: 2\n");
  }

  // The same in all but its bytes.
  std::string another() const {
    std::filesystem::copy_file(library("obedient"), path("another.so"));
    std::ofstream(path("another.so"), std::ios::app) << "x";
    return path("another.so");
  }
  static std::string library(const std::string& name) {
    return DODGESIM_BINARY_DIR "/tests/plugins/lib" + name + ".so";
  }
  Outcome run(const std::string& options) const {
    return dodgesim("run " + path("s.yaml") + " -j 1 --out " + path("out") + " " + options);
  }
};

TEST_F(PluginTest, FliesACampaignThatCanBeReplayed) {
  const std::string plugin = " --plugin " + library("obedient");
  const Outcome flown = run(plugin);
  EXPECT_EQ(flown.exit_code, 0) << flown.output;
  EXPECT_THAT(contents("out/table.md"), HasSubstr("plugin"));
  const std::string replay = "replay " + path("out") + " --throw 1 --mcap " + path("1.mcap");
  const Outcome again = dodgesim(replay + plugin);
  EXPECT_EQ(again.exit_code, 0) << again.output;
  const Outcome with_another = dodgesim(replay + " --plugin " + another());
  EXPECT_EQ(with_another.exit_code, 2);
  EXPECT_THAT(with_another.output, HasSubstr("of another plug-in"));
}

TEST_F(PluginTest, AnotherLibraryIsAnotherCampaign) {
  ASSERT_EQ(run("--plugin " + library("obedient")).exit_code, 0);
  const Outcome resumed = run("--resume --plugin " + another());
  EXPECT_EQ(resumed.exit_code, 2);
  EXPECT_THAT(resumed.output, HasSubstr("of another plug-in"));
}

TEST_F(PluginTest, ThatFailsCostsTheFlightAndCanBeReplayed) {
  const std::string plugin = " --plugin " + library("obedient");
  write("s.yaml",
        small_pictures_ + "pilot: plugin\nrepeats: 1\nthrow: {launch_s: 0.1, distance_m: 2}\n");
  const Outcome outcome = run("--set plugin_parameters=throw" + plugin);
  EXPECT_EQ(outcome.exit_code, 3);
  EXPECT_THAT(outcome.output, HasSubstr("1 throw had a flight that failed"));
  EXPECT_THAT(outcome.output, HasSubstr("Throw 0: The pilot failed: I have lost my way, and"));
  EXPECT_THAT(contents("out/table.md"), HasSubstr("1 / 1"));  // none was hit
  const Outcome again = dodgesim("replay " + path("out") + " --throw 0" + plugin);
  EXPECT_EQ(again.exit_code, 0);
  EXPECT_THAT(again.output, HasSubstr("fails as recorded"));
}

TEST_F(PluginTest, ThatDiesCostsTheThrowAndCanBeWatched) {
  const std::string plugin = " --plugin " + library("obedient");
  EXPECT_EQ(run("--set plugin_parameters=die" + plugin).exit_code, 3);
  EXPECT_THAT(contents("out/table.md"), HasSubstr("killed by signal 6"));
  const Outcome again = dodgesim("replay " + path("out") + " --throw 0" + plugin);
  EXPECT_THAT(again.output, HasSubstr("there is nothing to compare with"));
  EXPECT_NE(again.exit_code, 0);
}

TEST_F(PluginTest, ThatCallsExitDoesNotEndTheProgramAsIfAllWereWell) {
  const std::string exits = "--set plugin_parameters=exit --plugin " + library("obedient");
  EXPECT_EQ(run(exits).exit_code, 3);
  const Outcome again =
      dodgesim("replay " + path("out") + " --throw 0 --plugin " + library("obedient"));
  EXPECT_EQ(again.exit_code, 3);
  EXPECT_THAT(again.output, HasSubstr("The pilot ended the program by exit()."));
}

TEST_F(PluginTest, WhoseMemoryIsShortCostsTheThrow) {
  const std::string plugin = " --plugin " + library("obedient");
  const std::string order = "--set 'plugin_parameters=take all memory'";
  EXPECT_EQ(run(order + plugin).exit_code, 3);
  EXPECT_THAT(contents("out/table.md"), HasSubstr("The pilot threw std::bad_alloc, as when"));
}

TEST_F(PluginTest, DoesNotPrintAmongTheTables) {
  const std::string plugin = " --plugin " + library("obedient");
  const std::string print = "--set plugin_parameters=print" + plugin;
  const Outcome quiet = shell("( " DODGESIM_BINARY_DIR "/dodgesim run " + path("s.yaml") +
                              " -j 1 --out " + path("out") + " " + print + " 2>/dev/null )");
  EXPECT_EQ(quiet.exit_code, 0) << quiet.output;
  EXPECT_THAT(quiet.output, ::testing::StartsWith("# s\n"));
  EXPECT_THAT(quiet.output, Not(HasSubstr("Here I am.")));
  EXPECT_THAT(run("--force " + print).output, HasSubstr("Here I am."));  // on standard error
  const std::string dies = "--set 'plugin_parameters=print, then die'";
  EXPECT_THAT(run("--force " + dies + plugin).output, HasSubstr("I am dying"));
  const Outcome resolved = dodgesim("validate --resolved " + path("s.yaml") + " " + print);
  EXPECT_THAT(resolved.output, Not(HasSubstr("I am made.")));
}

TEST_F(PluginTest, IsNeededForItsOwnThrowsOnly) {
  write("s.yaml", small_pictures_ + "duration_s: 0.1\nsweep: {pilot: [none, plugin]}\n");
  const std::string plugin = " --plugin " + library("obedient");
  ASSERT_EQ(run(plugin).exit_code, 0);
  const std::string replay = "replay " + path("out") + " --throw ";
  EXPECT_EQ(dodgesim(replay + "0").exit_code, 0);
  const Outcome without = dodgesim(replay + "1");
  EXPECT_EQ(without.exit_code, 2);
  EXPECT_THAT(without.output, HasSubstr("add --plugin FILE.so"));
  EXPECT_EQ(dodgesim(replay + "1" + plugin).exit_code, 0);
}

TEST_F(PluginTest, IsRefusedBeforeTheFirstThrow) {
  const struct {
    std::string options, sentence;
  } refused[] = {
      {"", "s.yaml:2:8: pilot is plugin, but no library is given: add --plugin FILE.so."},
      {"--set pilot=none --plugin " + library("obedient"), "--set pilot=plugin makes it fly"},
      {"--set 'plugin_parameters=die at once' --plugin " + library("obedient"),
       "crashes while it is loaded, makes a pilot or deletes it"},
      {"--set plugin_parameters=refuse --plugin " + library("obedient"),
       "libobedient.so makes no pilot: I take no such parameters."},
      {"--set 'plugin_parameters=take all memory at once' --plugin " + library("obedient"),
       "libobedient.so makes no pilot: it threw std::bad_alloc"},
      {"--plugin " + library("with_a_missing_part"), "link the library that has it"},
      {"--plugin " + library("without_a_pilot"), "has no dodge_plugin_interface()"}};
  for (const auto& [options, sentence] : refused) {
    const Outcome outcome = run(options);
    EXPECT_EQ(outcome.exit_code, 2) << options;
    EXPECT_THAT(outcome.output, HasSubstr(sentence));
    EXPECT_FALSE(std::filesystem::exists(path("out"))) << options;
  }
  EXPECT_EQ(run("--plugin missing.so").exit_code, 4);
}

}  // namespace
}  // namespace dodgesim::testing

#include "sim/config/scenario_tree.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>

#include "sim/base/error.h"
#include "sim/config/expand.h"
#include "sim/config/scenario.h"
#include "tests/complaint.h"
#include "tests/sim/files/temporary_directory.h"

namespace dodgesim {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;
using ::testing::StartsWith;

class ScenarioTree : public ::testing::Test {
 protected:
  ScenarioTree() { fs::create_directories(root_ / "a/b/c"); }

  void write(const std::string& file, const std::string& text) const {
    std::ofstream(root_ / file) << text;
  }
  Scenario load(const std::string& file, const std::vector<Setting>& settings = {}) const {
    return load_scenario((root_ / file).string(), "", settings);
  }
  // The message without the folder's name.
  std::string error_of(const std::string& file, const std::vector<Setting>& settings = {}) const {
    std::string text = testing::complaint<ScenarioError>([&] { load(file, settings); });
    const std::string folder = root_.string() + "/";
    for (std::size_t at = 0; (at = text.find(folder)) != std::string::npos;) {
      text.erase(at, folder.size());
    }
    return text;
  }
  static Setting set(const std::string& key, const std::string& value) {
    return {key, value, "--set " + key + "=" + value};
  }

  const testing::TemporaryDirectory directory_;
  const fs::path root_ = fs::canonical(directory_.path());
};

TEST_F(ScenarioTree, KeysOfTheFileCountMoreThanThoseOfItsBase) {
  write("base.yaml",
        "name: base\ndescription: of the base\nseed: 3\nrepeats: 9\n"
        "throw: {size_m: 0.3, speed_mps: !normal {mean: 5, sd: 1}, aim_offset_m: [0.1, 0.2]}\n");
  write("mine.yaml",
        "extends: base.yaml\nrepeats: 2\n"
        "throw: {speed_mps: !normal {mean: 6, sd: 2}, aim_offset_m: 0}\n");
  const Scenario scenario = load("mine.yaml");
  EXPECT_EQ(scenario.name, "mine");
  EXPECT_EQ(scenario.description, "");
  EXPECT_EQ(scenario.seed, 3u);
  EXPECT_EQ(scenario.repeats, 2);
  EXPECT_EQ(scenario.throw_spec->size_m, Distribution::constant(0.3));
  EXPECT_EQ(scenario.throw_spec->speed_mps, Distribution::normal(6, 2, 0.5, 30)) << "not merged";
  EXPECT_EQ(scenario.throw_spec->aim_offset_m.parts.size(), 1u);
  EXPECT_THAT(to_yaml(scenario), ::testing::Not(HasSubstr("extends")));
  EXPECT_EQ(to_yaml(parse_scenario(to_yaml(scenario), "mine.yaml", "")), to_yaml(scenario));
}

TEST_F(ScenarioTree, ATildeTakesTheBasesValueAway) {
  write("base.yaml",
        "throw: {size_m: 0.3, spin_radps: 3}\nafter_s: 3\ngrid: {speed_mps: [3, 5]}\n");
  write("quiet.yaml", "extends: base.yaml\nthrow: ~\ngrid: ~\n");
  EXPECT_FALSE(load("quiet.yaml").anyone_throws());
  write("two.yaml", "extends: base.yaml\nthrow: null  # none\nthrows: [{}, {}]\n");
  EXPECT_EQ(load("two.yaml").throws.size(), 2u);
  write("one.yaml", "\xef\xbb\xbf# B\xc3\xa4lle\nextends: base.yaml\ngrid: {speed_mps: ~}\n");
  EXPECT_EQ(cell_count(load("one.yaml")), 1);
  EXPECT_EQ(load("base.yaml", {set("throw.size_m", "~")}).throw_spec->size_m, ThrowSpec{}.size_m);
}

TEST_F(ScenarioTree, AForgottenValueDoesNot) {
  write("base.yaml", "throw: {size_m: 0.3}\ngrid: {speed_mps: [3, 5]}\n");
  write("size.yaml", "extends: base.yaml\nthrow:\n  size_m:\n  spin_radps: 3\n");
  EXPECT_THAT(error_of("size.yaml"), HasSubstr("size.yaml:3:3: throw.size_m is empty, but must"));
  write("grid.yaml", "extends: base.yaml\ngrid:\n");
  EXPECT_THAT(error_of("grid.yaml"), HasSubstr("grid.yaml:2:1: grid is empty, but must be a map"));
  for (const char* nothing : {"!uniform", "!foo", "# 6", "---", "...", "!uniform # [8, 10]", ""}) {
    EXPECT_THAT(error_of("base.yaml", {set("throw.size_m", nothing)}),
                HasSubstr("throw.size_m is empty, but must be"))
        << nothing;
  }
  EXPECT_THAT(error_of("base.yaml", {set("throw", "!choice")}), HasSubstr("throw is empty, but"));
  // Nor is an element of a list a key, nor one of a distribution's that may go.
  EXPECT_THAT(error_of("base.yaml", {set("grid.speed_mps", "[~, 3]")}), HasSubstr("is empty, but"));
  EXPECT_THAT(error_of("base.yaml", {set("sweep.pilot", "[~, oracle]")}),
              HasSubstr("is empty, but"));
  EXPECT_THAT(error_of("base.yaml", {set("throw.size_m", "!normal {mean: ~, sd: 1}")}),
              HasSubstr("throw.size_m.mean is empty, but"));
  EXPECT_EQ(error_of("base.yaml", {set("delays.compute_us", "")}),
            "--set delays.compute_us=: delays.compute_us is empty, but must be a whole number "
            "between 0 and 1000000.");
}

TEST_F(ScenarioTree, ProblemsNameTheFileInWhichTheyStand) {
  write("base.yaml", "seed: -1\nthrow: {sise_m: 3}\n");
  write("a/mine.yaml", "extends: ../base.yaml\nrepeats: 0\nthrow:\n  speed_mps: 99\n");
  EXPECT_EQ(error_of("a/mine.yaml", {set("throw.spede_mps", "3"), set("after_s", "[1}")}),
            "--set after_s=[1}: This is not valid YAML (illegal flow end).");
  EXPECT_EQ(
      error_of("a/mine.yaml", {set("after_s", "[1")}),
      "--set after_s=[1: A key must be a plain word, not a list or a map; or a bracket is not "
      "closed.");
  EXPECT_EQ(error_of("a/mine.yaml", {set("throw.spede_mps", "3"), set("after_s", "1000")}),
            "a/mine.yaml:2:10: repeats is 0, but must be between 1 and 1000000.\n"
            "a/mine.yaml:4:14: throw.speed_mps is 99, but must be between 0.5 and 30.\n"
            "base.yaml:1:7: seed is -1, but must be between 0 and 18446744073709551615.\n"
            "base.yaml:2:9: throw.sise_m is not a known key; did you mean throw.size_m?\n"
            "--set throw.spede_mps=3: throw.spede_mps is not a known key; did you mean "
            "throw.speed_mps?\n"
            "--set after_s=1000: after_s is 1000, but must be between 0.1 and 60.");
}

TEST_F(ScenarioTree, BasesMayHaveBasesButNotWithoutEnd) {
  write("0.yaml", "seed: 10\n");
  for (int i = 1; i <= 9; ++i) {
    write(std::to_string(i) + ".yaml", "extends: " + std::to_string(i - 1) + ".yaml\n");
  }
  EXPECT_EQ(load("8.yaml").seed, 10u);
  EXPECT_THAT(error_of("9.yaml"),
              StartsWith("1.yaml:1:10: extends is \"0.yaml\", but this is base "));
  write("x.yaml", "extends: y.yaml\n");
  write("y.yaml", "extends: ./a/../x.yaml\n");
  EXPECT_EQ(error_of("x.yaml"),
            "y.yaml:1:10: extends is \"./a/../x.yaml\", but leads back to where it came from.");
  write("self.yaml", "extends: self.yaml\n");
  EXPECT_THAT(error_of("self.yaml"), HasSubstr("leads back"));
}

TEST_F(ScenarioTree, BasesLieNearby) {
  write("base.yaml", "seed: 2\n");
  write("a/b/near.yaml", "extends: ../../base.yaml\n");
  EXPECT_EQ(load("a/b/near.yaml").seed, 2u);
  write("a/b/c/far.yaml", "extends: ../../../base.yaml\n");
  EXPECT_EQ(error_of("a/b/c/far.yaml"),
            "a/b/c/far.yaml:1:10: extends is \"../../../base.yaml\", but leads more than 2 folders "
            "up from the scenario.");
  fs::create_symlink(root_ / "base.yaml", root_ / "a/b/c/link.yaml");
  write("a/b/c/linked.yaml", "extends: link.yaml\n");
  EXPECT_THAT(error_of("a/b/c/linked.yaml"), HasSubstr("leads more than 2 folders up"));
}

TEST_F(ScenarioTree, BasesAreOrdinaryFiles) {
  const auto refusal = [&](const std::string& value) {
    write("bad.yaml", "extends: " + value + "\n");
    return error_of("bad.yaml");
  };
  EXPECT_THAT(refusal("/etc/hosts.yaml"), HasSubstr("must be relative"));
  EXPECT_THAT(refusal("../../../../../../../etc/passwd"), HasSubstr("must end in .yaml"));
  EXPECT_THAT(refusal("none.yaml"), HasSubstr("there is no such file"));
  EXPECT_THAT(refusal("[a.yaml, b.yaml]"), HasSubstr("must be the name of a scenario's file"));
  EXPECT_THAT(refusal(""), HasSubstr("must be the name of a scenario's file"));
  fs::create_directories(root_ / "folder.yaml");
  EXPECT_THAT(refusal("folder.yaml"), HasSubstr("there is no such file"));
  fs::create_symlink("/dev/zero", root_ / "zero.yaml");
  EXPECT_THAT(refusal("zero.yaml"), HasSubstr("there is no such file"));
  write("huge.yaml", "name: " + std::string(300000, 'x'));
  EXPECT_THAT(refusal("huge.yaml"), HasSubstr("more than 262144 bytes"));
  write("list.yaml", "- 1\n");
  EXPECT_THAT(refusal("list.yaml"), HasSubstr("list.yaml:1:1: The file must be a map"));
}

TEST_F(ScenarioTree, SettingsTakeAnyYamlValueInTheirOrder) {
  write("s.yaml", "throw: {size_m: 0.3}\n");
  const Scenario scenario =
      load("s.yaml", {set("throw.speed_mps", "!uniform [4, 6]"), set("seed", "1"), set("seed", "2"),
                      set("throw", "{bearing_deg: 5}"), set("delays.compute_us", "7"),
                      set("sweep.delays.command_us", "[1, 2]"), set("grid.size_m", "[0.1]")});
  EXPECT_EQ(scenario.throw_spec->speed_mps, Distribution::uniform(4, 6));
  EXPECT_EQ(scenario.throw_spec->size_m, Distribution::constant(0.3));
  EXPECT_EQ(scenario.throw_spec->bearing_deg, Distribution::constant(5));
  EXPECT_EQ(scenario.seed, 2u);
  EXPECT_EQ(scenario.delays.compute_us, 7);
  EXPECT_EQ(sweep_count(scenario), 2);
  EXPECT_EQ(cell_count(scenario), 1);
}

TEST_F(ScenarioTree, APilotInNameOnlyIsRefused) {
  write("mine.yaml", "pilot: falanga2020\n");
  write("resolved.yaml", to_yaml(load("mine.yaml")));
  EXPECT_EQ(load("mine.yaml", {set("pilot", "dodgesim")}).dodger.position.max_range_m, 5);
  EXPECT_EQ(
      error_of("resolved.yaml", {set("pilot", "dodgesim")}),
      "--set pilot=dodgesim: pilot is dodgesim instead of falanga2020 by its name only: the "
      "file sets all keys of dodger itself. Put --set 'dodger=~' in front to take them away.");
  EXPECT_EQ(error_of("resolved.yaml", {set("sensors.events.preset", "noisy")}),
            "--set sensors.events.preset=noisy: sensors.events.preset is noisy instead of sees1 by "
            "its name only: the file sets all keys of sensors.events itself. Put --set '"
            "sensors.events=~' in front to take them away.");
  write("noisy.yaml", to_yaml(load("mine.yaml", {set("pilot", "dodgesim"),
                                                 set("sensors.events.preset", "noisy")})));
  EXPECT_THAT(
      error_of("noisy.yaml", {set("sensors.events.preset", "~")}),
      ::testing::HasSubstr("sensors.events.preset is left out instead of noisy by its name"));
  EXPECT_THAT(error_of("noisy.yaml", {set("pilot", "~")}),
              ::testing::HasSubstr("pilot is left out instead of dodgesim by its name only"));
  EXPECT_EQ(load("resolved.yaml", {set("dodger", "~"), set("pilot", "dodgesim")})
                .dodger.position.max_range_m,
            5);
  EXPECT_EQ(load("resolved.yaml", {set("pilot", "oracle")}).pilot, "oracle");
}

TEST_F(ScenarioTree, AKeyMayBeTakenAwayThatIsNotThere) {
  write("base.yaml", "seed: 3\n");
  const Scenario scenario = load("base.yaml", {set("stop", "~"), set("dodger", "~"),
                                               set("sensors.imu", "~"), set("throw", "~")});
  EXPECT_FALSE(scenario.stop.has_value());
  EXPECT_FALSE(scenario.anyone_throws());
  const Scenario quiet = load("base.yaml", {set("stop.confidence", "~"), set("throw.size_m", "~")});
  EXPECT_FALSE(quiet.stop.has_value());
  EXPECT_FALSE(quiet.anyone_throws());
  EXPECT_TRUE(
      load("base.yaml", {set("throw.size_m", "~"), set("throw.speed_mps", "4")}).anyone_throws());
  EXPECT_THAT(error_of("base.yaml", {set("throw.sise_m", "~")}),
              ::testing::HasSubstr("throw.sise_m is not a known"));
  EXPECT_THAT(error_of("base.yaml", {set("stpo", "~")}),
              ::testing::HasSubstr("stpo is not a known"));
  EXPECT_THAT(error_of("base.yaml", {set("grid.spede_mps", "~")}),
              HasSubstr("grid.spede_mps is not a key that can take several values"));
  write("none.yaml", "seed: 3\nstop: ~\nthrow: ~\ngrid: {size_m: ~}\n");
  EXPECT_FALSE(load("none.yaml").anyone_throws());
  write("default.yaml", "throw: {size_m: ~}\n");
  EXPECT_TRUE(load("default.yaml").anyone_throws());
  write("empty.yaml", "seed: 3\nstop:\n");
  EXPECT_THAT(error_of("empty.yaml", {}), ::testing::HasSubstr("stop is empty"));
}

TEST_F(ScenarioTree, AKeyOfTheGridIsTheSameUnderBothOfItsNames) {
  write("base.yaml", "throw: {size_m: 1}\ngrid: {size_m: [0.1, 0.2], throw.speed_mps: [4, 5]}\n");
  write("over.yaml", "extends: base.yaml\ngrid: {throw.size_m: [0.3], speed_mps: [6]}\n");
  const Scenario over = load("over.yaml");
  ASSERT_EQ(over.grid.size(), 2u);
  EXPECT_EQ(over.grid[0].key, "throw.size_m");
  EXPECT_EQ(over.grid[0].values.size(), 1u);
  EXPECT_EQ(over.grid[1].key, "throw.speed_mps");
  EXPECT_EQ(over.grid[1].values.size(), 1u);
  const Scenario away =
      load("base.yaml", {set("grid.throw.size_m", "~"), set("grid.speed_mps", "[4, 5, 6]")});
  ASSERT_EQ(away.grid.size(), 1u);
  EXPECT_EQ(away.grid[0].values.size(), 3u);
  for (const char* both :
       {"{size_m: [1], throw.size_m: [1]}", "{throw.size_m: [1], size_m: [1]}"}) {
    write("both.yaml", std::string("extends: base.yaml\ngrid: ") + both + "\n");
    EXPECT_THAT(error_of("both.yaml", {}), HasSubstr("size_m is given twice"));
  }
}

TEST_F(ScenarioTree, BadSettingsAreRefused) {
  write("s.yaml", "seed: 1\n");
  EXPECT_THAT(error_of("s.yaml", {set("", "1")}), StartsWith("--set =1: A key is needed"));
  EXPECT_THAT(error_of("s.yaml", {set("seed.x", "1")}), HasSubstr("--set seed.x=1: seed is a map"));
  EXPECT_THAT(error_of("s.yaml", {set("extends", "b.yaml")}), HasSubstr("in a file only"));
  EXPECT_THAT(error_of("s.yaml", {set(std::string(100000, '.'), "1")}),
              HasSubstr("A key is needed"));
  EXPECT_THAT(error_of("s.yaml", {set("name", "[&a 1, *a]")}),
              HasSubstr("Aliases (*name) are not"));
  EXPECT_THAT(error_of("s.yaml", {set("name", std::string(100000, '['))}), HasSubstr("A key must"));
  EXPECT_THAT(error_of("s.yaml", {set("name", "\xff")}), HasSubstr("not UTF-8"));
  EXPECT_THAT(error_of("s.yaml", {set("seed", "1\n---\n2")}), HasSubstr("more than one YAML"));
}

}  // namespace
}  // namespace dodgesim

#include "sim/campaign/campaign.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <chrono>
#include <csignal>
#include <thread>

#include "sim/base/error.h"
#include "sim/base/input_file.h"
#include "sim/files/json.h"
#include "sim/files/output_file.h"
#include "sim/outcome/blank_result.h"
#include "tests/sim/campaign/campaign_fixture.h"

namespace dodgesim {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;

TEST_F(CampaignTest, WritesTheTruthOnRequestOnly) {
  scenario_.repeats = 3;
  const auto fly_one = [&](int index) {
    ThrowResult result = fly(index);
    result.truth_rows = {{index, 500000, index == 2, {100, 40, 20, 10}}};
    return result;
  };
  CampaignOptions with = options("with");
  with.truth = true;
  const CampaignSummary summary = run_campaign(scenario_, with, fly_one);
  EXPECT_EQ(read_file(root_ / "with/truth.csv"),
            "throw,cycle_us,evading,events,object_events,found_events,found_object_events,"
            "event_precision,event_recall\n"
            "0,500000,0,100,40,20,10,0.5,0.25\n"
            "1,500000,0,100,40,20,10,0.5,0.25\n"
            "2,500000,1,100,40,20,10,0.5,0.25\n");
  ASSERT_EQ(summary.truth.size(), 1u);
  EXPECT_EQ(summary.truth[0].before.object_events, 80);
  EXPECT_EQ(summary.truth[0].after.object_events, 40);
  run_campaign(scenario_, options("without"), fly_one);
  EXPECT_FALSE(fs::exists(root_ / "without/truth.csv"));
  for (const char* name : {"throws.csv", "detections.csv", "table.md"}) {
    EXPECT_EQ(read_file(root_ / "with" / name), read_file(root_ / "without" / name));
  }
  // What an earlier run left is not taken for this one's.
  CampaignOptions again = options("with");
  again.force = true;
  run_campaign(scenario_, again, fly_one);
  EXPECT_FALSE(fs::exists(root_ / "with/truth.csv"));
}

TEST_F(CampaignTest, ResultsAreByteIdenticalForAnyNumberOfWorkers) {
  const auto fly_one = [&](int index) { return fly(index); };
  run_campaign(scenario_, options("one", 1), fly_one);
  for (const int jobs : {2, 5, 40}) {
    const std::string name = std::to_string(jobs);
    run_campaign(scenario_, options(name, jobs), fly_one);
    for (const char* file :
         {"scenario.resolved.yaml", "throws.csv", "detections.csv", "table.md", "table.csv"}) {
      EXPECT_EQ(read_file(root_ / "one" / file), read_file(root_ / name / file)) << file;
    }
  }
  const std::string throws = read_file(root_ / "one" / "throws.csv");
  EXPECT_EQ(std::count(throws.begin(), throws.end(), '\n'), 13);
  const std::string detections = read_file(root_ / "one" / "detections.csv");
  EXPECT_EQ(std::count(detections.begin(), detections.end(), '\n'), 1 + 66);
}

TEST_F(CampaignTest, ACrashCostsItsThrowOnlyAndIsRecorded) {
  const CampaignSummary summary = run_campaign(scenario_, options("crash", 2), [&](int index) {
    if (index == 4) ::raise(SIGKILL);
    if (index == 7) ::_exit(9);
    return fly(index);
  });
  EXPECT_EQ(summary.errors, 2);
  ASSERT_EQ(summary.results.size(), 12u);
  for (int i = 0; i < 12; ++i) {
    const ThrowResult& result = summary.results[static_cast<std::size_t>(i)];
    EXPECT_EQ(result.index, i);
    EXPECT_EQ(result.flown.failed(), i == 4 || i == 7) << i;
    EXPECT_EQ(result.size_m, blank_result(case_of(scenario_, i)).size_m) << i;
  }
  EXPECT_EQ(summary.results[4].flown.error, "The worker process was killed by signal 9 (Killed).");
  EXPECT_EQ(summary.results[7].flown.error, "The worker process ended with exit code 9.");
  EXPECT_THAT(summary.table,
              HasSubstr("- throw 4, pilot falanga2020: The worker process was killed"));
}

// Sanitizers end the process in their own way.
TEST_F(CampaignTest, AccessToMemoryThatIsNotThereCostsItsThrowOnly) {
  const CampaignSummary summary = run_campaign(scenario_, options("segv", 2), [&](int index) {
    if (index == 6) ::raise(SIGSEGV);
    return fly(index);
  });
  EXPECT_EQ(summary.errors, 1);
  EXPECT_FALSE(summary.results[6].flown.unharmed());
  EXPECT_THAT(summary.results[6].flown.error, HasSubstr("The worker process "));
}

TEST_F(CampaignTest, AThrowThatForksIsFlownOnce) {
  const CampaignSummary alone =
      run_campaign(scenario_, options("alone"), [&](int i) { return fly(i); });
  const CampaignSummary forked = run_campaign(scenario_, options("forked"), [&](int index) {
    if (index == 2 || index == 5) ::fork();
    return fly(index);
  });
  EXPECT_EQ(forked.results.size(), 12u);
  EXPECT_EQ(forked.errors, 0);
  EXPECT_EQ(forked.table, alone.table);
}

TEST_F(CampaignTest, EvenWhenEveryThrowCrashesTheCampaignEnds) {
  const CampaignSummary summary =
      run_campaign(scenario_, options("all", 2), [&](int) -> ThrowResult { ::_exit(1); });
  EXPECT_EQ(summary.errors, 12);
}

TEST_F(CampaignTest, AnExceptionCostsItsThrow) {
  const CampaignSummary summary = run_campaign(scenario_, options("throwing", 2), [&](int index) {
    if (index == 2) throw SimulationError("The state diverged.");
    return fly(index);
  });
  EXPECT_EQ(summary.errors, 1);
  EXPECT_EQ(summary.results[2].flown.error, "The state diverged.");
}

TEST_F(CampaignTest, AScenarioErrorEndsTheCampaignAndNoWorkerSurvives) {
  EXPECT_THROW(run_campaign(scenario_, options("bad", 3),
                            [&](int index) -> ThrowResult {
                              if (index == 1) throw ScenarioError("The room is broken.");
                              std::this_thread::sleep_for(std::chrono::hours(1));
                              return {};
                            }),
               ScenarioError);
  EXPECT_FALSE(fs::exists(root_ / "bad" / "throws.csv"));
  EXPECT_FALSE(fs::exists(root_ / "bad" / "throws.csv.partial"));
  EXPECT_FALSE(fs::exists(root_ / "bad" / "manifest.json"));
}

TEST_F(CampaignTest, AFullDiskIsReportedAndNothingIsClaimed) {
  const fs::path out = root_ / "full";
  run_campaign(scenario_, options("full"), [&](int index) { return fly(index); });
  for (const char* name : {"throws.csv", "objects.csv", "detections.csv", "timing.csv", "table.md",
                           "table.csv", "manifest.json", "scenario.resolved.yaml"}) {
    fs::remove(out / "manifest.json");
    fs::remove(out / name);  // what the campaign or the case before left
    const fs::path link = out / (std::string(name) + ".partial");
    fs::create_symlink("/dev/full", link);
    CampaignOptions full = options("full");
    full.force = true;
    try {
      run_campaign(scenario_, full, [&](int index) { return fly(index); });
      FAIL() << name;
    } catch (const IoError& error) {
      EXPECT_EQ(error.what(),
                (out / name).string() + " could not be written: No space left on device.");
    }
    EXPECT_FALSE(fs::exists(out / name)) << name;
    EXPECT_FALSE(fs::exists(out / "manifest.json")) << name;
    fs::remove(link);
  }
}

TEST_F(CampaignTest, AnotherScenarioIsNotOverwrittenUnlessForced) {
  const auto fly_one = [&](int index) { return fly(index); };
  run_campaign(scenario_, options("a"), fly_one);
  EXPECT_THROW(run_campaign(scenario_, options("a"), fly_one), ScenarioError) << "the same again";
  const std::string before = read_file(root_ / "a" / "throws.csv");

  Scenario other = scenario_;
  other.seed = 5;
  EXPECT_THROW(run_campaign(other, options("a"), fly_one), ScenarioError);
  EXPECT_EQ(read_file(root_ / "a" / "throws.csv"), before);
  CampaignOptions forced = options("a");
  forced.force = true;
  EXPECT_NO_THROW(run_campaign(other, forced, fly_one));
}

TEST_F(CampaignTest, ADirectoryOfSomethingElseIsLeftAlone) {
  fs::create_directories(root_ / "home");
  testing::put(root_ / "home" / "precious.txt", "x");
  const auto fly_home = [&](bool force) {
    CampaignOptions home = options("home");
    home.force = force;
    run_campaign(scenario_, home, [&](int i) { return fly(i); });
  };
  EXPECT_THROW(fly_home(false), ScenarioError);
  testing::put(root_ / "home" / "throws.csv", "precious, too");
  EXPECT_THROW(fly_home(false), ScenarioError);
  EXPECT_THROW(fly_home(true), ScenarioError);
  EXPECT_EQ(read_file(root_ / "home" / "throws.csv"), "precious, too");
  fs::remove(root_ / "home" / "throws.csv");
  EXPECT_NO_THROW(fly_home(true)) << "beside other files, as shards are";
  EXPECT_EQ(read_file(root_ / "home" / "precious.txt"), "x");
  EXPECT_THROW(run_campaign(scenario_, options("home/precious.txt"), [&](int i) { return fly(i); }),
               IoError);
}

TEST_F(CampaignTest, ADirectoryThatCannotBeIsRefusedInOneSentence) {
  EXPECT_THAT([&] { run_campaign(scenario_, options(std::string(300, 'a')), {}); },
              ::testing::ThrowsMessage<IoError>(
                  ::testing::HasSubstr("aaa could not be created: File name too long.")));
}

TEST_F(CampaignTest, TheResolvedScenarioIsTheScenario) {
  run_campaign(scenario_, options("out"), [&](int index) { return fly(index); });
  const Scenario again = load_scenario(root_ / "out" / "scenario.resolved.yaml", "");
  EXPECT_EQ(to_yaml(again), to_yaml(scenario_));
}

TEST_F(CampaignTest, TheManifestSaysWhatFlewAndWhere) {
  CampaignOptions with_facts = options("out", 2);
  with_facts.command_line = "dodgesim run fake.yaml \xff";
  with_facts.gl_renderer = [] { return std::string("llvmpipe"); };
  run_campaign(scenario_, with_facts, [&](int index) { return fly(index); });
  const auto manifest = parse_json(read_file(root_ / "out" / "manifest.json"));
  EXPECT_GE(manifest["program"]["commit"].get<std::string>().size(), 7u);
  EXPECT_THAT(manifest["program"]["compiler"].get<std::string>(), HasSubstr("g++ "));
  for (const char* library : {"mujoco", "opencv", "eigen", "yaml_cpp", "gl_renderer"}) {
    EXPECT_NE(manifest["libraries"][library], "") << library;
  }
  EXPECT_NE(manifest["machine"]["cpu_flags"], "");
  EXPECT_EQ(manifest["campaign"]["throws"], 12);
  EXPECT_EQ(manifest["campaign"]["jobs"], 2);
  EXPECT_GT(manifest["time"]["wall_s"].get<double>(), 0);
}

TEST_F(CampaignTest, AFileIsAbsentUntilItIsWhole) {
  const fs::path path = root_ / "file.txt";
  {
    OutputFile file(path);
    file.write(std::string(1000000, 'x'));
    EXPECT_FALSE(fs::exists(path));
  }
  EXPECT_FALSE(fs::exists(root_ / "file.txt.partial")) << "dropped without commit()";
  write_file(path, "whole");
  EXPECT_EQ(read_file(path), "whole");
}

}  // namespace
}  // namespace dodgesim

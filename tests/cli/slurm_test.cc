// The scripts in tools/slurm without a Slurm: a stand-in for sbatch notes what is submitted, and
// the jobs are run as Slurm would run them. tests/slurm has the real thing.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>

#include "tests/cli/command_test.h"

namespace {

namespace fs = std::filesystem;
using dodgesim::testing::dodgesim;
using dodgesim::testing::Outcome;
using dodgesim::testing::shell;
using ::testing::HasSubstr;

class SlurmTest : public dodgesim::testing::CommandTest {
 protected:
  SlurmTest() : CommandTest("with a blank") {
    fs::create_directories(root_ / "bin");
    // Prints a job's number; the queue is what the test says.
    write("bin/sbatch", "#!/bin/sh\necho \"$@\" >>'" + path("sbatch.log") + "'\nwc -l <'" +
                            path("sbatch.log") + "'\n");
    write("bin/squeue", "#!/bin/sh\ncat '" + path("queue") + "'\n");
    for (const char* name : {"bin/sbatch", "bin/squeue"}) {
      fs::permissions(root_ / name, fs::perms::owner_all);
    }
    write("queue", "");
    write("s.yaml",
          "seed: 3\npilot: none\nfly_oracle: false\nafter_s: 0.1\nthrow: {launch_s: 0.1}\n");
  }

  std::string quoted(const std::string& name) const { return "'" + path(name) + "' "; }
  Outcome script(const std::string& name, const std::string& arguments) const {
    return shell("PATH='" + path("bin") + "':$PATH DODGESIM=" + kProgram + " " + kScripts + name +
                 " " + arguments);
  }
  Outcome submit(const std::string& options = "--shards 2 --throws 6") const {
    return script("submit", quoted("s.yaml") + quoted("out") + options);
  }
  Outcome fly_shard(int shard) const {
    return shell("SLURM_ARRAY_TASK_ID=" + std::to_string(shard) + " " + kScripts + "shard.sh " +
                 kProgram + " " + quoted("s.yaml") + quoted("out") + "2 --throws 6");
  }
  Outcome merge() const { return script("merge.sh", kProgram + " " + quoted("out") + kScripts); }

  const std::string kScripts = std::string(DODGESIM_SOURCE_DIR) + "/tools/slurm/";
  const std::string kProgram = std::string(DODGESIM_BINARY_DIR) + "/dodgesim";
};

TEST_F(SlurmTest, SubmitsAnArrayAndAMergeThatWaitsForIt) {
  const Outcome outcome = submit("--shards 3 --throws 6 --truth -- --partition=fast");
  EXPECT_EQ(outcome.exit_code, 0) << outcome.output;
  const std::string common = "--parsable --requeue --open-mode=append --job-name=dodgesim";
  EXPECT_EQ(contents("sbatch.log"),
            common + " --array=0-2 --output=" + path("out/logs/shard%a.log") +
                " --partition=fast " + kScripts + "shard.sh " + kProgram + " " + path("s.yaml") +
                " " + path("out") + " 3 --throws=6 --truth\n" + common +
                "-merge --dependency=afterany:1 --output=" + path("out/logs/merge.log") +
                " --partition=fast " + kScripts + "merge.sh " + kProgram + " " + path("out") + " " +
                kScripts.substr(0, kScripts.size() - 1) + "\n");
}

TEST_F(SlurmTest, TakesOptionsInAnyOrder) {
  const Outcome outcome =
      script("submit", "--throws 6 --set 'throw.speed_mps=!uniform [5, 7]' " + quoted("s.yaml") +
                           "--truth --seed=4 " + quoted("out") + "--time-limit 60 --shards 2");
  EXPECT_EQ(outcome.exit_code, 0) << outcome.output;
  const std::string options =
      "--throws=6 --set=throw.speed_mps=!uniform [5, 7] --truth --seed=4 --time-limit=60\n";
  EXPECT_THAT(contents("sbatch.log"), HasSubstr(path("out") + " 2 " + options));
  // The line that status prints does the same.
  const std::string status = script("status", quoted("out")).output;
  const std::string again = status.substr(status.find("  " + kScripts));
  const Outcome repeated = shell("PATH='" + path("bin") + "':$PATH DODGESIM=" + kProgram + again);
  EXPECT_EQ(repeated.exit_code, 0) << again << repeated.output;
}

TEST_F(SlurmTest, RefusesBeforeAnythingIsSubmitted) {
  EXPECT_THAT(submit("").output, HasSubstr("--shards must be a number from 1, not ''"));
  EXPECT_EQ(submit("--shards 0").exit_code, 2);
  EXPECT_THAT(submit("--shards 2 --resume").output, HasSubstr("--resume is set for each task"));
  EXPECT_EQ(script("submit", quoted("s.yaml") + "--shards 2").exit_code, 2);
  EXPECT_EQ(submit("third --shards 2").exit_code, 2);
  EXPECT_THAT(submit("--shards").output, HasSubstr("--shards needs a value"));
  EXPECT_THAT(submit("--shards 2 --trows 3").output, HasSubstr("--trows is no option"));
  EXPECT_THAT(submit("--shards 2 --set sede=3").output, HasSubstr("sede is not a known key"));
  EXPECT_THAT(submit("--shards 2 --set throw.size_m=0.2 --set stop.half_width=0.1").output,
              HasSubstr("has the key stop, and so no shards"));
  fs::create_directories(root_ / "out");
  write("out/thesis.tex", "precious");
  EXPECT_THAT(submit().output, HasSubstr("is not empty and was not made by this script"));
  fs::remove(root_ / "out/thesis.tex");
  write("s.yaml", "sede: 3\n");
  const Outcome outcome = submit();
  EXPECT_EQ(outcome.exit_code, 2);
  EXPECT_THAT(outcome.output, HasSubstr("sede"));
  EXPECT_FALSE(fs::exists(root_ / "sbatch.log"));
}

TEST_F(SlurmTest, WhatTheJobsMergeIsWhatOneProcessWrites) {
  ASSERT_EQ(submit().exit_code, 0);
  EXPECT_EQ(submit().exit_code, 0);  // nothing of it is in the queue
  write("queue", "1\n");
  EXPECT_THAT(submit().output, HasSubstr("is still being flown; first wait, or: scancel 1"));
  write("queue", "");
  EXPECT_THAT(submit("--shards 2 --throws 7").output, HasSubstr("with other options"));

  EXPECT_EQ(fly_shard(0).exit_code, 0);
  EXPECT_EQ(fly_shard(1).exit_code, 0);
  EXPECT_THAT(fly_shard(1).output, HasSubstr("shard 1 is complete"));
  // As if its node had been lost just before the end.
  fs::remove(root_ / "out/shards/1.0/manifest.json");
  fs::resize_file(root_ / "out/shards/1.0/results.bin",
                  fs::file_size(root_ / "out/shards/1.0/results.bin") - 5);
  const Outcome early = merge();
  EXPECT_EQ(early.exit_code, 3);
  EXPECT_THAT(early.output, HasSubstr("1 of 6 throws are missing: 5; results.bin of"));
  EXPECT_THAT(early.output, HasSubstr("unfinished of 2 shards: 1\n"));
  EXPECT_EQ(script("status", quoted("out")).exit_code, 3);

  ASSERT_EQ(submit().exit_code, 0);
  EXPECT_THAT(contents("sbatch.log"), HasSubstr(" --array=1 "));
  const Outcome again = fly_shard(1);
  EXPECT_THAT(again.output, HasSubstr("goes on with " + path("out/shards/1.0/results.bin")));
  EXPECT_THAT(again.output, HasSubstr("shard 1 of 2, attempt 1 on "));
  const Outcome merged = merge();
  EXPECT_EQ(merged.exit_code, 0) << merged.output;
  EXPECT_EQ(script("status", quoted("out")).exit_code, 0);
  EXPECT_THAT(submit().output, HasSubstr("is complete"));

  EXPECT_EQ(dodgesim("run " + quoted("s.yaml") + "--throws 6 --out " + quoted("whole")).exit_code,
            0);
  for (const char* file : {"/throws.csv", "/detections.csv", "/table.md", "/table.csv"}) {
    EXPECT_EQ(contents(std::string("whole") + file), contents(std::string("out") + file)) << file;
  }
}

TEST_F(SlurmTest, ExplainsItself) {
  for (const char* name : {"submit", "status"}) {
    const Outcome outcome = script(name, "--help");
    EXPECT_EQ(outcome.exit_code, 0);
    EXPECT_THAT(outcome.output, HasSubstr(std::string("Usage: tools/slurm/") + name));
  }
  EXPECT_EQ(script("status", quoted("nothing")).exit_code, 2);
}

}  // namespace

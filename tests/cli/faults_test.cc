// What goes wrong on real machines, done to the program; results/faults.md lists it.
#include <fcntl.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <thread>

#include "tests/cli/command_test.h"
#include "tests/models.h"

namespace {

namespace fs = std::filesystem;
using dodgesim::testing::CommandTest;
using dodgesim::testing::copy_models;
using dodgesim::testing::dodgesim;
using dodgesim::testing::make_diverging;
using dodgesim::testing::Outcome;
using ::testing::HasSubstr;

// Short flights without a throw or eyes, some 20 ms each.
class FaultsTest : public CommandTest {
 protected:
  FaultsTest() { write("s.yaml", "seed: 5\nrepeats: 60\npilot: none\nduration_s: 0.1\n"); }

  std::string run_arguments(const std::string& out, const std::string& options = "") const {
    return "run " + path("s.yaml") + " --out " + path(out) + " " + options;
  }
};

// Starts the program; the caller waits for it.
pid_t start(const std::string& arguments, const std::string& output) {
  const pid_t child = ::fork();
  if (child != 0) return child;
  const int fd = ::open(output.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0644);
  ::dup2(fd, STDOUT_FILENO);
  ::dup2(fd, STDERR_FILENO);
  const std::string command =
      "exec " + std::string(DODGESIM_BINARY_DIR) + "/dodgesim " + arguments + " </dev/null";
  ::execl("/bin/sh", "sh", "-c", command.c_str(), nullptr);
  ::_exit(127);
}

TEST_F(FaultsTest, InterruptAndTerminationStopCleanlyAndResumably) {
  ASSERT_EQ(dodgesim(run_arguments("whole")).exit_code, 0);
  for (const int signal : {SIGINT, SIGTERM}) {
    const std::string out = "stopped" + std::to_string(signal);
    const pid_t child = start(run_arguments(out, "-j 1"), path("output.txt"));
    // Until a throw is recorded: the journal grows.
    std::error_code none_yet;
    std::uintmax_t first = 0;
    for (int i = 0; i < 5000; ++i) {
      const auto size = fs::file_size(root_ / out / "results.bin", none_yet);
      if (!none_yet && first == 0) first = size;
      if (!none_yet && size > first) break;
      std::this_thread::sleep_for(std::chrono::milliseconds(2));
    }
    ::kill(child, signal);
    int status = 0;
    ::waitpid(child, &status, 0);
    ASSERT_TRUE(WIFEXITED(status)) << signal;
    EXPECT_EQ(WEXITSTATUS(status), 3) << signal;
    EXPECT_THAT(contents(path("output.txt")), HasSubstr("of 60 throws; the same command with"));
    EXPECT_FALSE(fs::exists(root_ / out / "throws.csv"));
    EXPECT_EQ(dodgesim(run_arguments(out, "--resume")).exit_code, 0);
    expect_same("whole", out);
  }
}

// As timeout(1) sends them: one to the program, one to its process group.
TEST_F(FaultsTest, TwoSignalsAtOnceCountAsOne) {
  const pid_t child = start(run_arguments("stopped", "-j 1"), path("output.txt"));
  for (int i = 0; i < 5000 && !fs::exists(root_ / "stopped" / "results.bin"); ++i) {
    std::this_thread::sleep_for(std::chrono::milliseconds(2));
  }
  for (int i = 0; i < 2; ++i) {
    ::kill(child, SIGTERM);
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  }
  int status = 0;
  ::waitpid(child, &status, 0);
  ASSERT_TRUE(WIFEXITED(status));
  EXPECT_EQ(WEXITSTATUS(status), 3);
}

TEST_F(FaultsTest, AStoppedReplayLeavesNothingBehind) {
  std::ofstream(path("long.yaml")) << "pilot: none\nduration_s: 20\n";
  ASSERT_EQ(dodgesim("run " + path("long.yaml") + " --out " + path("long")).exit_code, 0);
  const pid_t child = start("replay " + path("long") + " --throw 0 --slow 1 --video " +
                                path("a.mp4") + " --mcap " + path("a.mcap"),
                            path("output.txt"));
  for (int i = 0; i < 5000 && !fs::exists(path("a.mcap.partial")); ++i) {
    std::this_thread::sleep_for(std::chrono::milliseconds(2));
  }
  ::kill(child, SIGINT);
  int status = 0;
  ::waitpid(child, &status, 0);
  ASSERT_TRUE(WIFEXITED(status));
  EXPECT_EQ(WEXITSTATUS(status), 3);
  EXPECT_THAT(contents(path("output.txt")), HasSubstr("Stopped; nothing is written."));
  for (const auto& entry : fs::directory_iterator(root_)) {
    EXPECT_THAT(entry.path().filename().string(), ::testing::Not(::testing::StartsWith("a.mp4")));
    EXPECT_THAT(entry.path().filename().string(), ::testing::Not(::testing::StartsWith("a.mcap")));
  }
}

// As some daemons start programs.
TEST_F(FaultsTest, FliesWithoutStandardFiles) {
  const std::string program = std::string(DODGESIM_BINARY_DIR) + "/dodgesim ";
  const auto outcome = dodgesim::testing::shell(
      "sh -c '" + program + run_arguments("closed", "--throws 2 -j 2") + " <&- >&- 2>&-'");
  EXPECT_EQ(outcome.exit_code, 4);  // the table is not printed
  EXPECT_TRUE(fs::exists(root_ / "closed" / "throws.csv"));
}

// Runs shell commands as root of a mount namespace of their own, where file systems can be mounted
// that end with it. False where that is not permitted.
bool in_own_namespace(const std::string& script) {
  return std::system(("unshare -m sh -c '" + script + "'").c_str()) == 0;
}

TEST_F(FaultsTest, AFullDiskIsReportedAndTheRunResumesOnceThereIsSpace) {
  if (!in_own_namespace("mount -t tmpfs tmpfs " + root_.string() + " 2>/dev/null")) {
    GTEST_SKIP() << "A file system cannot be mounted here.";
  }
  ASSERT_EQ(dodgesim(run_arguments("whole")).exit_code, 0);
  fs::create_directories(root_ / "disk");
  const std::string program = std::string(DODGESIM_BINARY_DIR) + "/dodgesim ";
  const std::string run = program + run_arguments("disk/out");
  // 1 MB, of which 20 kB are left: the scenario and the results of about twenty throws.
  ASSERT_TRUE(in_own_namespace(
      "mount -t tmpfs -o size=1m tmpfs " + path("disk") + " && head -c 1028096 /dev/zero >" +
      path("disk/ballast") + " && { " + run + " >" + path("full.txt") + " 2>&1; echo $? >" +
      path("full_code") + "; ls " + path("disk/out") + " >" + path("left") + "; rm " +
      path("disk/ballast") + "; " + run + " --resume >" + path("resumed.txt") + " 2>&1; echo $? >" +
      path("resumed_code") + "; cp -r " + path("disk/out") + " " + path("resumed") + "; }"));
  EXPECT_EQ(contents(path("full_code")), "4\n");
  EXPECT_THAT(contents(path("full.txt")),
              HasSubstr("results.bin could not be written: No space left on device."));
  EXPECT_THAT(contents(path("left")), ::testing::Not(HasSubstr("throws.csv")));
  EXPECT_THAT(contents(path("left")), ::testing::Not(HasSubstr("manifest.json")));
  EXPECT_EQ(contents(path("resumed_code")), "0\n") << contents(path("resumed.txt"));
  expect_same("whole", "resumed");
}

TEST_F(FaultsTest, AReadOnlyDirectoryIsReported) {
  fs::create_directories(root_ / "disk");
  const std::string program = std::string(DODGESIM_BINARY_DIR) + "/dodgesim ";
  if (!in_own_namespace("mount -t tmpfs -o ro tmpfs " + path("disk") + " 2>/dev/null && { " +
                        program + run_arguments("disk") + " >" + path("output.txt") +
                        " 2>&1; echo $? >" + path("code") + "; }")) {
    GTEST_SKIP() << "A file system cannot be mounted here.";
  }
  EXPECT_EQ(contents(path("code")), "4\n");
  EXPECT_THAT(contents(path("output.txt")),
              HasSubstr("could not be written: Read-only file system"));
}

TEST_F(FaultsTest, OutputThatNobodyCanStoreIsNoSuccess) {
  EXPECT_EQ(dodgesim(run_arguments("out", "--throws 1 >/dev/full")).exit_code, 4);
  const Outcome outcome = dodgesim("run " + path("s.yaml") + " --out /dev/full");
  EXPECT_EQ(outcome.exit_code, 4);
  EXPECT_THAT(outcome.output,
              HasSubstr("/dev/full could not be created: a file of that name exists."));
}

TEST_F(FaultsTest, AThrowThatLackedMemoryIsFlownAgain) {
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
  GTEST_SKIP() << "Sanitizers reserve more address space than any limit allows.";
#endif
  const std::string one = "--set pilot=falanga2020 --set repeats=1 ";
  ASSERT_EQ(dodgesim(run_arguments("whole", one)).exit_code, 0);
  EXPECT_EQ(dodgesim(run_arguments("short", one + "--memory-limit 256")).exit_code, 3);  // for Mesa
  EXPECT_THAT(column("short/throws.csv", "flown_status"), ::testing::ElementsAre("lost"));
  EXPECT_EQ(dodgesim(run_arguments("short", one + "--resume")).exit_code, 0);
  expect_same("whole", "short");
}

TEST_F(FaultsTest, ADivergedSimulationCountsAsNoSuccessAndReplays) {
  make_diverging(copy_models(root_));
  const std::string models = "--models " + path("models");
  const Outcome run = dodgesim(run_arguments("out", "--throws 2 " + models));
  EXPECT_EQ(run.exit_code, 3) << run.output;
  EXPECT_THAT(run.output, HasSubstr("- throw 1, pilot none: The simulation diverged: "));
  EXPECT_THAT(run.output, HasSubstr("2 throws had a flight that failed"));
  const Outcome replay =
      dodgesim("replay " + path("out") + " --throw 1 " + models + " --mcap " + path("a.mcap"));
  EXPECT_EQ(replay.exit_code, 0);
  EXPECT_THAT(replay.output, HasSubstr("Throw 1 fails: The simulation diverged: "));
  EXPECT_THAT(contents(path("a.mcap")), HasSubstr("The flight failed: The simulation diverged: "));
  std::ofstream(path("old.mp4")) << "old";
  const Outcome video =
      dodgesim("replay " + path("out") + " --throw 1 " + models + " --video " + path("old.mp4"));
  EXPECT_EQ(video.exit_code, 3);
  EXPECT_THAT(video.output, HasSubstr("Of a flight that fails --mcap alone shows something."));
  EXPECT_EQ(contents(path("old.mp4")), "old");
}

}  // namespace

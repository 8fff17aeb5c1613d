#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <vector>

#include "sim/base/error.h"
#include "sim/base/input_file.h"
#include "sim/base/random.h"
#include "sim/campaign/journal.h"
#include "sim/outcome/blank_result.h"
#include "tests/sim/campaign/campaign_fixture.h"

namespace dodgesim {
namespace {

namespace fs = std::filesystem;
using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;
using ::testing::ThrowsMessage;

[[noreturn]] void hang() {
  for (;;) std::this_thread::sleep_for(std::chrono::hours(1));
}

[[noreturn]] void fill_memory() {
  std::vector<std::vector<char>> hoard;
  for (;;) hoard.emplace_back().reserve(std::size_t{100} << 20);
}

class ResumeTest : public CampaignTest {
 protected:
  FlyFunction fly_one_ = [this](int index) { return fly(index); };

  CampaignOptions resuming(const std::string& name, int jobs = 1) const {
    CampaignOptions again = options(name, jobs);
    again.resume = true;
    return again;
  }
  void expect_same_files(const std::string& a, const std::string& b) const {
    for (const char* file : kReproducible) {
      EXPECT_EQ(read_file(root_ / a / file), read_file(root_ / b / file)) << file;
    }
  }
};

TEST_F(ResumeTest, AKillAtAnyMomentLosesNoFinishedThrow) {
  run_campaign(scenario_, options("whole"), fly_one_);
  RandomStream random(1, 0, "kills");
  int within = 0;             // kills between the first throw and the last
  double longest_us = 60000;  // that a campaign is left in peace: the more, the slower the machine
  for (int trial = 0; trial < 30; ++trial) {
    const std::string name = "killed" + std::to_string(trial);
    std::size_t before = 0;
    for (int kill = 0; kill < 3; ++kill) {
      const pid_t child = ::fork();
      if (child == 0) {
        try {
          run_campaign(scenario_, resuming(name, 1 + trial % 3), fly_one_);
        } catch (...) {  // this must not become a second process of tests
          ::_exit(1);
        }
        ::_exit(0);
      }
      std::this_thread::sleep_for(
          std::chrono::microseconds(static_cast<std::int64_t>(random.uniform(0, longest_us))));
      ::kill(child, SIGKILL);
      int status = 0;
      ASSERT_EQ(::waitpid(child, &status, 0), child);
      EXPECT_TRUE(WIFSIGNALED(status) || WEXITSTATUS(status) == 0) << status;
      const fs::path journal = root_ / name / "results.bin";
      const std::size_t now = fs::exists(journal) ? read_journal(journal).throws.size() : 0;
      EXPECT_GE(now, before);
      before = now;
      within += now > 0 && now < 12 ? 1 : 0;
      longest_us *= now == 0 ? 1.2 : now == 12 ? 0.8 : 1;
    }
    const CampaignSummary summary = run_campaign(scenario_, resuming(name), fly_one_);
    EXPECT_EQ(summary.flown, 12 - static_cast<int>(before));
    expect_same_files("whole", name);
  }
  EXPECT_GT(within, 0);
}

TEST_F(ResumeTest, AFinishedCampaignFliesNothingMore) {
  run_campaign(scenario_, options("a"), fly_one_);
  const CampaignSummary again =
      run_campaign(scenario_, resuming("a"), [](int) -> ThrowResult { ::_exit(1); });
  EXPECT_EQ(again.flown, 0);
  EXPECT_EQ(again.errors, 0);
  EXPECT_THAT(read_file(root_ / "a/manifest.json"),
              AllOf(HasSubstr("\"throws_flown\": 0"), Not(HasSubstr("throws_per_minute"))));
  EXPECT_EQ(again.results.size(), 12u);
}

TEST_F(ResumeTest, AStopIsCleanAndCanBeResumed) {
  run_campaign(scenario_, options("whole"), fly_one_);
  int asked = 0;
  CampaignOptions stopping = options("stopped", 2);
  stopping.stop = [&asked] { return ++asked > 4; };
  const CampaignSummary stopped = run_campaign(scenario_, stopping, fly_one_);
  EXPECT_FALSE(stopped.complete());
  EXPECT_FALSE(fs::exists(root_ / "stopped" / "throws.csv"));
  EXPECT_FALSE(fs::exists(root_ / "stopped" / "manifest.json"));
  EXPECT_TRUE(run_campaign(scenario_, resuming("stopped"), fly_one_).complete());
  expect_same_files("whole", "stopped");
}

TEST_F(ResumeTest, StoppedBeforeALostThrowIsFlownAgainItIsNotComplete) {
  run_campaign(scenario_, options("whole"), fly_one_);
  run_campaign(scenario_, options("lost"), [this](int index) {
    if (index == 7) ::raise(SIGKILL);
    return fly(index);
  });
  CampaignOptions stopping = resuming("lost");
  stopping.stop = [] { return true; };
  const CampaignSummary stopped = run_campaign(scenario_, stopping, fly_one_);
  EXPECT_FALSE(stopped.complete());
  EXPECT_EQ(stopped.missing, 1);
  EXPECT_FALSE(fs::exists(root_ / "lost" / "throws.csv"));
  EXPECT_TRUE(run_campaign(scenario_, resuming("lost"), fly_one_).complete());
  expect_same_files("whole", "lost");
}

// As a batch system ends a job: SIGTERM to all its processes, then SIGKILL to one after the other.
TEST_F(ResumeTest, WorkersThatAreKilledAlongWithTheCampaignLoseNoThrow) {
  const pid_t campaign = ::fork();
  if (campaign == 0) {
    const pid_t campaign_itself = ::getpid();
    run_campaign(scenario_, options("out"), [&](int index) {
      ::raise(SIGTERM);
      if (index != 4) return fly(index);
      if (::fork() == 0) {
        ::close_range(3, ~0U, 0);  // the worker's socket ends with the worker
        std::this_thread::sleep_for(std::chrono::milliseconds(50));
        ::kill(campaign_itself, SIGKILL);
        ::_exit(0);
      }
      ::raise(SIGKILL);
      return fly(index);
    });
    ::_exit(0);
  }
  int status = 0;
  ASSERT_EQ(::waitpid(campaign, &status, 0), campaign);
  ASSERT_TRUE(WIFSIGNALED(status));
  const JournalIndex index = read_journal(root_ / "out/results.bin");
  EXPECT_EQ(index.throws.size(), 4u);
  for (const auto& [number, record] : index.throws) EXPECT_FALSE(record.lost) << number;
}

// Its tables are all that is left of hours of flights: no stopped campaign has any.
TEST_F(ResumeTest, TablesWhoseJournalIsGoneAreNotFlownOver) {
  run_campaign(scenario_, options("a"), fly_one_);
  fs::remove(root_ / "a/results.bin");
  EXPECT_THAT([&] { run_campaign(scenario_, resuming("a"), fly_one_); },
              ThrowsMessage<ScenarioError>(HasSubstr("holds a campaign without results.bin")));
  EXPECT_TRUE(fs::exists(root_ / "a/throws.csv"));
}

TEST_F(ResumeTest, RefusesToGoOnWithAnotherCampaign) {
  run_campaign(scenario_, options("a"), fly_one_);
  Scenario other = scenario_;
  other.seed = 5;
  EXPECT_THROW(run_campaign(other, resuming("a"), fly_one_), ScenarioError);
  CampaignOptions truth = resuming("a");
  truth.truth = true;
  EXPECT_THROW(run_campaign(scenario_, truth, fly_one_), ScenarioError);
  CampaignOptions models = resuming("a");
  models.models = "12ab";
  EXPECT_THAT([&] { run_campaign(scenario_, models, fly_one_); },
              ThrowsMessage<ScenarioError>(HasSubstr("other models")));
}

TEST_F(ResumeTest, AnotherShardIsNotTakenForThisOne) {
  CampaignOptions first = options("a"), second = resuming("a");
  first.shard = {0, 2};
  second.shard = {1, 2};
  run_campaign(scenario_, first, fly_one_);
  EXPECT_THROW(run_campaign(scenario_, second, fly_one_), ScenarioError);
  EXPECT_EQ(run_campaign(scenario_, resuming("a"), fly_one_).flown,
            6);  // of the whole it is a part
}

TEST_F(ResumeTest, ASecondProcessIsRefused) {
  const CampaignSummary summary = run_campaign(scenario_, options("a"), [&](int index) {
    if (index == 0) {  // in the worker, while the campaign runs
      try {
        run_campaign(scenario_, resuming("a"), fly_one_);
      } catch (const ScenarioError& error) {
        throw SimulationError(error.what());
      }
    }
    return fly(index);
  });
  EXPECT_EQ(summary.errors, 1);
  EXPECT_THAT(summary.results[0].flown.error, HasSubstr("is being written to by another dodgesim"));
}

TEST_F(ResumeTest, AThrowThatHangsIsGivenUp) {
  CampaignOptions limited = options("hang", 2);
  limited.limits.wall_s = 2;
  const CampaignSummary summary = run_campaign(scenario_, limited, [&](int index) {
    if (index == 5) hang();
    return fly(index);
  });
  EXPECT_EQ(summary.errors, 1);
  EXPECT_THAT(summary.results[5].flown.error, HasSubstr("took longer than the limit of 2 s"));
  EXPECT_THAT(summary.table, HasSubstr("Dodged: 7 / 12")) << "11 flew, and the lost one counts";
}

// As by Ctrl-Z and fg: the clock on the wall goes on, the throw does not.
TEST_F(ResumeTest, APauseOfAllProcessesCostsNoThrow) {
  const pid_t campaign = ::fork();
  if (campaign == 0) {
    ::setpgid(0, 0);
    CampaignOptions limited = options("paused");
    limited.limits.wall_s = 1;
    const CampaignSummary summary = run_campaign(scenario_, limited, [&](int index) {
      if (index == 4) {
        ::kill(0, SIGSTOP);
        std::this_thread::sleep_for(std::chrono::milliseconds(300));
      }
      return fly(index);
    });
    ::_exit(summary.errors);
  }
  int status = 0;
  ASSERT_EQ(::waitpid(campaign, &status, WUNTRACED), campaign);
  ASSERT_TRUE(WIFSTOPPED(status));
  std::this_thread::sleep_for(std::chrono::milliseconds(1500));
  ::kill(-campaign, SIGCONT);
  ASSERT_EQ(::waitpid(campaign, &status, 0), campaign);
  ASSERT_TRUE(WIFEXITED(status));
  EXPECT_EQ(WEXITSTATUS(status), 0) << "throws that were given up";
}

TEST_F(ResumeTest, AThrowThatWasLostIsFlownAgain) {
  run_campaign(scenario_, options("whole"), fly_one_);
  CampaignOptions limited = options("hang", 2);
  limited.limits.wall_s = 2;
  run_campaign(scenario_, limited, [&](int index) {
    if (index == 5) hang();
    return fly(index);
  });
  const CampaignSummary again = run_campaign(scenario_, resuming("hang"), fly_one_);
  EXPECT_EQ(again.flown, 1);
  EXPECT_EQ(again.errors, 0);
  expect_same_files("whole", "hang");
}

TEST_F(ResumeTest, AThrowThatNeedsTooMuchMemoryFails) {
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
  GTEST_SKIP() << "Sanitizers reserve more address space than any limit allows.";
#endif
  CampaignOptions limited = options("memory", 2);
  limited.limits.memory_mb = 2048;
  const CampaignSummary summary = run_campaign(scenario_, limited, [&](int index) {
    if (index == 5) fill_memory();
    return fly(index);
  });
  EXPECT_EQ(summary.errors, 1);
  EXPECT_THAT(summary.results[5].flown.error, HasSubstr("not enough memory: the limit is 2048 MB"));
}

TEST_F(ResumeTest, ADamagedResultIsFlownAgain) {
  run_campaign(scenario_, options("whole"), fly_one_);
  run_campaign(scenario_, options("broken"), fly_one_);
  const fs::path journal = root_ / "broken" / "results.bin";
  const JournalIndex index = read_journal(journal);
  std::fstream file(journal, std::ios::in | std::ios::out | std::ios::binary);
  file.seekp(static_cast<std::streamoff>(index.throws.at(7).offset + 3));
  file.put('\x55');
  file.close();
  const CampaignSummary summary = run_campaign(scenario_, resuming("broken"), fly_one_);
  EXPECT_EQ(summary.flown, 1);
  expect_same_files("whole", "broken");
}

// Bit by bit and cut by cut: what is resumed is right, or refused.
TEST_F(ResumeTest, ADamagedJournalNeverMakesAWrongTable) {
  const auto fly_fast = [&](int index) {
    ThrowResult result = blank_result(case_of(scenario_, index));
    result.flown = flown(index % 3 == 0);
    result.none = flown(true);
    return result;
  };
  run_campaign(scenario_, options("whole"), fly_fast);
  const std::string whole = read_file(root_ / "whole" / "results.bin");
  RandomStream random(2, 0, "damage");
  int refused = 0;
  for (int trial = 0; trial < 60; ++trial) {
    const auto at = static_cast<std::size_t>(random.uniform(0, static_cast<double>(whole.size())));
    std::string damaged = trial % 3 == 0 ? whole.substr(0, at) : whole;
    if (trial % 3 != 0) damaged[at] = static_cast<char>(damaged[at] ^ (1 << trial % 8));
    fs::remove_all(root_ / "damaged");
    fs::copy(root_ / "whole", root_ / "damaged");
    testing::put(root_ / "damaged" / "results.bin", damaged);
    try {
      run_campaign(scenario_, resuming("damaged"), fly_fast);
      expect_same_files("whole", "damaged");
    } catch (const IoError& error) {
      EXPECT_THAT(error.what(), HasSubstr("results.bin"));
      ++refused;
    }
  }
  EXPECT_LT(refused, 60);
}

}  // namespace
}  // namespace dodgesim

// Several campaigns in the same workers.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <map>

#include "sim/base/error.h"
#include "sim/base/input_file.h"
#include "sim/campaign/journal.h"
#include "sim/outcome/blank_result.h"
#include "tests/sim/campaign/campaign_fixture.h"

namespace dodgesim {
namespace {

namespace fs = std::filesystem;
using ::testing::ElementsAre;
using ::testing::Pair;

class SeveralCampaignsTest : public CampaignTest {
 protected:
  PlannedCampaign plan(const std::string& name, int jobs) {
    return {&scenario_, options(name, jobs), [this](int index) { return fly(index); }};
  }
  // Notes who began and which summaries came.
  CampaignListener listener() {
    CampaignListener all;
    all.begun = [this](std::size_t i) { begun_.push_back(i); };
    all.ended = [this](std::size_t i, const CampaignSummary& summary) {
      ended_[i] = summary.complete();
    };
    return all;
  }
  // Waits until the file is there; false if it never comes.
  static bool comes(const fs::path& file) {
    for (int i = 0; i < 1000 && !fs::exists(file); ++i) {
      std::this_thread::sleep_for(std::chrono::milliseconds(10));
    }
    return fs::exists(file);
  }

  std::vector<std::size_t> begun_;
  std::map<std::size_t, bool> ended_;
};

TEST_F(SeveralCampaignsTest, GiveTheFilesOfEachOne) {
  Scenario other = scenario_;
  other.seed = 5;
  const FlyFunction fly_other = [&other](int index) {
    ThrowResult result = blank_result(case_of(other, index));
    result.flown = result.none = flown(true);
    return result;
  };
  run_campaign(scenario_, options("a"), plan("a", 1).fly);
  run_campaign(other, options("b"), fly_other);
  for (const int jobs : {1, 3, 20}) {
    const std::string both = std::to_string(jobs);
    run_campaigns({plan(both + "a", jobs), {&other, options(both + "b", jobs), fly_other}},
                  listener());
    EXPECT_THAT(begun_, ElementsAre(0, 1));
    EXPECT_THAT(ended_, ElementsAre(Pair(0, true), Pair(1, true)));
    for (const char* file : kReproducible) {
      EXPECT_EQ(read_file(root_ / (both + "a") / file), read_file(root_ / "a" / file)) << file;
      EXPECT_EQ(read_file(root_ / (both + "b") / file), read_file(root_ / "b" / file)) << file;
    }
    begun_.clear();
    ended_.clear();
  }
}

TEST_F(SeveralCampaignsTest, BeginTheNextWhileTheLastThrowOfOneIsInTheAir) {
  const fs::path sign = root_ / "sign";
  PlannedCampaign first = plan("first", 2), second = plan("second", 2);
  first.fly = [&](int index) {
    if (index == 11 && !comes(sign)) throw SimulationError("the next campaign did not begin");
    return fly(index);
  };
  second.fly = [&](int index) {
    testing::put(sign, std::to_string(index));
    return fly(index);
  };
  run_campaigns({first, second}, listener());
  EXPECT_THAT(read_file(root_ / "first/throws.csv"),
              ::testing::Not(::testing::HasSubstr("did not begin")));
  EXPECT_THAT(ended_, ElementsAre(Pair(0, true), Pair(1, true)));
}

TEST_F(SeveralCampaignsTest, AStopLeavesThoseThatHaveEndedWhole) {
  PlannedCampaign first = plan("first", 2);
  first.options.stop = [this] { return ended_.contains(1); };
  PlannedCampaign slow = plan("third", 2);
  slow.fly = [&](int index) {
    std::this_thread::sleep_for(std::chrono::seconds(10));
    return fly(index);
  };
  run_campaigns({first, plan("second", 2), slow, plan("fourth", 2)}, listener());
  EXPECT_THAT(ended_, ElementsAre(Pair(0, true), Pair(1, true), Pair(2, false)));
  EXPECT_TRUE(fs::exists(root_ / "second/manifest.json"));
  EXPECT_FALSE(fs::exists(root_ / "third/throws.csv"));
  EXPECT_FALSE(fs::exists(root_ / "fourth/throws.csv"));

  PlannedCampaign third = plan("third", 2), second = plan("second", 2);
  second.options.resume = third.options.resume = true;
  int flown = 0;
  CampaignListener counting;
  counting.ended = [&flown](std::size_t, const CampaignSummary& summary) {
    flown += summary.flown;
  };
  run_campaigns({second, third}, counting);
  EXPECT_EQ(flown, 12) << "nothing of the second is flown again";
}

TEST_F(SeveralCampaignsTest, ALostThrowCostsItsOwnCampaign) {
  PlannedCampaign first = plan("first", 2);
  first.fly = [](int) -> ThrowResult { ::_exit(3); };
  std::map<std::size_t, int> errors;
  CampaignListener counting;
  counting.ended = [&](std::size_t i, const CampaignSummary& summary) {
    errors[i] = summary.errors;
  };
  run_campaigns({first, plan("second", 2)}, counting);
  EXPECT_THAT(errors, ElementsAre(Pair(0, 12), Pair(1, 0)));
}

TEST_F(SeveralCampaignsTest, ThatEndEarlyMakeRoomForTheNext) {
  const Scenario stopping =
      parse_scenario("repeats: 1000\nthrow: {}\nstop: {half_width: 0.2}\n", "stopping.yaml", "");
  const FlyFunction always = [&](int index) {
    ThrowResult result = blank_result(case_of(stopping, index));
    result.flown = flown(false);
    result.none = flown(true);
    return result;
  };
  const int wanted = run_campaign(stopping, options("alone"), always).wanted;
  ASSERT_LT(wanted, 1000);
  std::map<std::size_t, int> counts;
  CampaignListener counting;
  counting.ended = [&](std::size_t i, const CampaignSummary& summary) {
    counts[i] = static_cast<int>(summary.results.size());
  };
  run_campaigns({{&stopping, options("first", 3), always}, plan("second", 3)}, counting);
  EXPECT_THAT(counts, ElementsAre(Pair(0, wanted), Pair(1, 12)));
}

TEST_F(SeveralCampaignsTest, GoOnWithAWholeOneWhileTheOneBeforeItIsInTheAir) {
  run_campaign(scenario_, options("second"), plan("second", 1).fly);
  const std::string table = read_file(root_ / "second/throws.csv");
  PlannedCampaign second = plan("second", 2);
  second.options.resume = true;
  second.fly = [](int) -> ThrowResult { ::_exit(3); };
  run_campaigns({plan("first", 2), second, plan("third", 2)}, listener());
  EXPECT_THAT(ended_, ElementsAre(Pair(0, true), Pair(1, true), Pair(2, true)));
  EXPECT_EQ(read_file(root_ / "second/throws.csv"), table);
}

TEST_F(SeveralCampaignsTest, AreAllLookedThroughBeforeTheFirstThrow) {
  fs::create_directories(root_ / "second");
  testing::put(root_ / "second/thesis.txt", "years of work");
  PlannedCampaign first = plan("first", 2);
  first.options.force = true;
  run_campaign(scenario_, first.options, first.fly);
  const std::string before = read_file(root_ / "first/results.bin");
  EXPECT_THROW(run_campaigns({first, plan("second", 2)}, listener()), ScenarioError);
  EXPECT_THAT(begun_, ::testing::IsEmpty());
  EXPECT_EQ(read_file(root_ / "first/results.bin"), before) << "nothing is overwritten for nothing";
}

TEST_F(SeveralCampaignsTest, NeverShareADirectory) {
  PlannedCampaign again = plan("first", 1);
  again.options.out = root_ / "elsewhere/../first";
  EXPECT_THAT(
      [&] {
        run_campaigns({plan("first", 1), again}, listener());
      },
      ::testing::ThrowsMessage<ScenarioError>(
          ::testing::HasSubstr("Two campaigns would write to")));
  EXPECT_FALSE(fs::exists(root_ / "first"));
}

TEST_F(SeveralCampaignsTest, StoppedAfterForceTheRestCanBeResumed) {
  Scenario old = scenario_;
  old.seed = 5;
  run_campaign(old, options("second"), plan("second", 1).fly);
  PlannedCampaign first = plan("first", 1), second = plan("second", 1);
  first.options.force = second.options.force = true;
  first.options.stop = [] { return true; };
  run_campaigns({first, second}, {});
  EXPECT_FALSE(fs::exists(root_ / "second/throws.csv"));
  for (PlannedCampaign* campaign : {&first, &second}) {
    campaign->options.force = false;
    campaign->options.resume = true;
  }
  first.options.stop = {};
  run_campaigns({first, second}, listener());
  EXPECT_THAT(ended_, ElementsAre(Pair(0, true), Pair(1, true)));
}

TEST_F(SeveralCampaignsTest, ThatCannotBeFlownTakeNothingFromThoseBefore) {
  PlannedCampaign second = plan("second", 1);
  second.fly = [](int) -> ThrowResult { throw ScenarioError("no such throw"); };
  EXPECT_THROW(run_campaigns({plan("first", 1), second}, listener()), ScenarioError);
  EXPECT_THAT(ended_, ElementsAre(Pair(0, true)));
  EXPECT_TRUE(fs::exists(root_ / "first/manifest.json"));
}

TEST_F(SeveralCampaignsTest, ThatCannotBeginLoseNoThrowOfThoseBefore) {
  CampaignListener refusing;
  refusing.begun = [](std::size_t i) {
    if (i == 1) throw IoError("the disk is full");
  };
  EXPECT_THROW(run_campaigns({plan("first", 1), plan("second", 1)}, refusing), IoError);
  EXPECT_EQ(read_journal(root_ / "first/results.bin").throws.size(), 12u);
}

// Its tables take longer than the limit; the other worker's throw ended long before that.
TEST_F(SeveralCampaignsTest, WhileTablesAreWrittenNoFinishedThrowIsGivenUp) {
  PlannedCampaign first = plan("first", 2);
  first.options.limits.wall_s = 0.5;
  int errors = 0;
  CampaignListener slow;
  slow.ended = [&](std::size_t i, const CampaignSummary& summary) {
    errors += summary.errors;
    if (i == 0) std::this_thread::sleep_for(std::chrono::seconds(1));
  };
  run_campaigns({first, plan("second", 2)}, slow);
  EXPECT_EQ(errors, 0);
}

TEST_F(SeveralCampaignsTest, OfNoneThereIsNothingToFly) {
  EXPECT_EQ(run_campaigns({}, listener()).first_mb, 0);
  EXPECT_THAT(begun_, ::testing::IsEmpty());
}

}  // namespace
}  // namespace dodgesim

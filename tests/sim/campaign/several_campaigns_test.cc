// Several campaigns in the same workers.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <map>

#include "sim/base/error.h"
#include "sim/campaign/journal.h"
#include "tests/sim/campaign/campaign_fixture.h"

namespace dodgesim {
namespace {

namespace fs = std::filesystem;
using testing::ElementsAre;
using testing::Pair;

class SeveralCampaignsTest : public CampaignTest {
 protected:
  CampaignRun run(const std::string& name, int jobs) {
    return {scenario_, options(name, jobs), [this](int index) { return fly(index); }};
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
  run_campaign(scenario_, options("a"), run("a", 1).fly);
  run_campaign(other, options("b"), fly_other);
  for (const int jobs : {1, 3, 20}) {
    const std::string both = std::to_string(jobs);
    run_campaigns({run(both + "a", jobs), {other, options(both + "b", jobs), fly_other}},
                  listener());
    EXPECT_THAT(begun_, ElementsAre(0, 1));
    EXPECT_THAT(ended_, ElementsAre(Pair(0, true), Pair(1, true)));
    for (const char* file : kReproducible) {
      EXPECT_EQ(read(root_ / (both + "a") / file), read(root_ / "a" / file)) << file;
      EXPECT_EQ(read(root_ / (both + "b") / file), read(root_ / "b" / file)) << file;
    }
    begun_.clear();
    ended_.clear();
  }
}

TEST_F(SeveralCampaignsTest, BeginTheNextWhileTheLastThrowOfOneIsInTheAir) {
  const fs::path sign = root_ / "sign";
  CampaignRun first = run("first", 2), second = run("second", 2);
  first.fly = [&](int index) {
    if (index == 11 && !comes(sign)) throw SimulationError("the next campaign did not begin");
    return fly(index);
  };
  second.fly = [&](int index) {
    std::ofstream(sign) << index;
    return fly(index);
  };
  run_campaigns({first, second}, listener());
  EXPECT_THAT(read(root_ / "first/throws.csv"), testing::Not(testing::HasSubstr("did not begin")));
  EXPECT_THAT(ended_, ElementsAre(Pair(0, true), Pair(1, true)));
}

TEST_F(SeveralCampaignsTest, AStopLeavesThoseThatHaveEndedWhole) {
  CampaignRun first = run("first", 2);
  first.options.stop = [this] { return ended_.contains(1); };
  CampaignRun slow = run("third", 2);
  slow.fly = [&](int index) {
    std::this_thread::sleep_for(std::chrono::seconds(10));
    return fly(index);
  };
  run_campaigns({first, run("second", 2), slow, run("fourth", 2)}, listener());
  EXPECT_THAT(ended_, ElementsAre(Pair(0, true), Pair(1, true), Pair(2, false)));
  EXPECT_TRUE(fs::exists(root_ / "second/manifest.json"));
  EXPECT_FALSE(fs::exists(root_ / "third/throws.csv"));
  EXPECT_FALSE(fs::exists(root_ / "fourth"));

  CampaignRun third = run("third", 2), second = run("second", 2);
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
  CampaignRun first = run("first", 2);
  first.fly = [](int) -> ThrowResult { ::_exit(3); };
  std::map<std::size_t, int> errors;
  CampaignListener counting;
  counting.ended = [&](std::size_t i, const CampaignSummary& summary) {
    errors[i] = summary.errors;
  };
  run_campaigns({first, run("second", 2)}, counting);
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
  run_campaigns({{stopping, options("first", 3), always}, run("second", 3)}, counting);
  EXPECT_THAT(counts, ElementsAre(Pair(0, wanted), Pair(1, 12)));
}

TEST_F(SeveralCampaignsTest, OfNoneThereIsNothingToFly) {
  EXPECT_EQ(run_campaigns({}, listener()).first_mb, 0);
  EXPECT_THAT(begun_, testing::IsEmpty());
}

}  // namespace
}  // namespace dodgesim

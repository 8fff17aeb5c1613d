// The key stop of a campaign that is flown, interrupted and read back.
#include <gmock/gmock.h>

#include <fstream>

#include "sim/base/error.h"
#include "sim/base/input_file.h"
#include "sim/campaign/journal.h"
#include "sim/campaign/load_campaign.h"
#include "sim/campaign/merge.h"
#include "sim/tables/report.h"
#include "sim/tables/statistics_table.h"
#include "tests/sim/campaign/campaign_fixture.h"
#include "tests/sim/tables/stopping.h"

namespace dodgesim {
namespace {

using ::testing::HasSubstr;
using ::testing::ThrowsMessage;

class EarlyStopCampaignTest : public CampaignTest {
 protected:
  EarlyStopCampaignTest() { scenario_ = stopping(0.2, 200); }
  FlyFunction fly_nth() const {
    return [](int index) { return nth_throw(index); };
  }
};

TEST_F(EarlyStopCampaignTest, FliesNoMoreThanItNeedsWhateverTheWorkers) {
  const CampaignSummary one = run_campaign(scenario_, options("one", 1), fly_nth());
  const CampaignSummary three = run_campaign(scenario_, options("three", 3), fly_nth());
  EXPECT_TRUE(one.complete());
  EXPECT_LT(one.wanted, 200);
  EXPECT_EQ(static_cast<int>(one.results.size()), one.wanted);
  EXPECT_EQ(one.wanted, three.wanted);
  for (const char* file : kReproducible) {
    EXPECT_EQ(read_file(root_ / "one" / file), read_file(root_ / "three" / file)) << file;
  }
}

TEST_F(EarlyStopCampaignTest, IsCompleteForWhoReadsItAndStatesTheIntervalThatHolds) {
  const int flown = run_campaign(scenario_, options("out"), fly_nth()).wanted;
  const LoadedCampaign campaign = load_campaign(root_ / "out");
  EXPECT_TRUE(campaign.complete());
  EXPECT_TRUE(campaign.ended_early());
  EXPECT_EQ(static_cast<int>(campaign.results.size()), flown);
  EXPECT_EQ(expect_complete({root_ / "out"}), flown);

  const Rate headline = statistics_of(parts_of(campaign).front()).flown().tally.success();
  EXPECT_EQ(headline.interval_name(), "sequential 95 %");
  EXPECT_NEAR(headline.interval().half_width(), 0.2, 1e-3) << "as asked for, where it is not cut";
  EXPECT_NE(headline.interval().lo, wilson(headline.count, headline.of).lo);
  const std::string table = read_file(root_ / "out/table.md");
  EXPECT_THAT(table, HasSubstr("Ended by stop after " + std::to_string(flown) + " throws"));
  EXPECT_THAT(table, HasSubstr("Dodged: " + rate_text(headline)));
  EXPECT_THAT(rate_text(headline), ::testing::EndsWith(", sequential 95 %)"));
  EXPECT_THAT(read_file(root_ / "out/table.csv"), HasSubstr(",sequential 95 %,"));
  // The pilot's hits are what it did not dodge: Wilson's interval would not hold for them either.
  const Rate collisions = statistics_of(parts_of(campaign).front()).flown().tally.collisions;
  EXPECT_EQ(collisions.interval_name(), "none");
  EXPECT_THAT(table, HasSubstr("| all | " + rate_text(collisions) + " |"));
  EXPECT_THAT(rate_text(collisions), ::testing::MatchesRegex("[0-9]+ / [0-9]+ [(]0[.][0-9]+[)]"));
  const StatisticsTable grouped = group_by(parts_of(campaign), {});
  EXPECT_THAT(to_json(grouped), HasSubstr("\"interval\": \"sequential 95 %\""));
  EXPECT_THAT(to_latex(grouped), HasSubstr("sequential 95 \\%)"));
  EXPECT_THAT(report_html(campaign, "out"), HasSubstr("\"sequential 95 %\""));
  const StatisticsTable alike = group_by(parts_of(campaign), {Axis("object", campaign.results)});
  ASSERT_EQ(alike.rows.size(), 2u);
  EXPECT_EQ(alike.rows[0].statistics.flown().tally.success().interval_name(), "sequential 95 %")
      << "a group of all throws is the whole";
}

TEST_F(EarlyStopCampaignTest, LacksThrowsUntilItHasEnded) {
  CampaignOptions part = options("part");
  int flown_so_far = 0;
  part.stop = [&flown_so_far] { return ++flown_so_far > 3; };
  run_campaign(scenario_, part, fly_nth());
  const LoadedCampaign campaign = load_campaign(root_ / "part");
  EXPECT_FALSE(campaign.complete());
  EXPECT_FALSE(campaign.ended_early());
  EXPECT_THROW(expect_complete({root_ / "part"}), MissingThrows);
  const int flown = run_campaign(scenario_, options("whole"), fly_nth()).wanted;
  EXPECT_EQ(expect_complete({root_ / "part", root_ / "whole"}), flown)
      << "one that is whole will do";
}

TEST_F(EarlyStopCampaignTest, GoesOnWhereItWasInterrupted) {
  run_campaign(scenario_, options("whole"), fly_nth());
  CampaignOptions part = options("part");
  int flown_so_far = 0;
  part.stop = [&flown_so_far] { return ++flown_so_far > 3; };
  run_campaign(scenario_, part, fly_nth());
  part.stop = nullptr;
  part.resume = true;
  EXPECT_TRUE(run_campaign(scenario_, part, fly_nth()).complete());
  for (const char* file : kReproducible) {
    EXPECT_EQ(read_file(root_ / "whole" / file), read_file(root_ / "part" / file)) << file;
  }
  const CampaignSummary again = run_campaign(scenario_, part, fly_nth());
  EXPECT_EQ(again.flown, 0) << "nothing is left to fly";
}

TEST_F(EarlyStopCampaignTest, WithADamagedRecordStatesTheIntervalOfTheThrowsThatAreThere) {
  run_campaign(scenario_, options("out", 1), fly_nth());
  const auto journal = root_ / "out/results.bin";
  const JournalRecord record = read_journal(journal).throws.at(2);
  std::fstream file(journal, std::ios::in | std::ios::out | std::ios::binary);
  file.seekp(static_cast<std::streamoff>(record.offset));
  file.put('\xff').put('\xff');
  file.close();
  const LoadedCampaign campaign = load_campaign(root_ / "out");
  EXPECT_TRUE(campaign.damaged);
  const Rate rate = statistics_of(parts_of(campaign).front()).flown().tally.success();
  const Interval expected = confidence_sequence(rate.count, rate.of);
  EXPECT_GT(rate.of, 2);
  EXPECT_EQ(rate.interval().lo, expected.lo);
  EXPECT_EQ(rate.interval().hi, expected.hi);
  EXPECT_THAT(campaign.stop->text(), HasSubstr("after " + std::to_string(campaign.results.size()) +
                                               " throws: " + std::to_string(rate.count) + " of " +
                                               std::to_string(rate.of)));
}

TEST_F(EarlyStopCampaignTest, HasNoShards) {
  CampaignOptions shard = options("shard");
  shard.shard = {0, 2};
  EXPECT_THAT([&] { run_campaign(scenario_, shard, fly_nth()); },
              ThrowsMessage<ScenarioError>(HasSubstr("stop and --shard exclude each other")));
  run_campaign(scenario_, options("whole"), fly_nth());
  EXPECT_THROW(merge_campaigns({root_ / "whole"}, options("merged")), ScenarioError);
}

}  // namespace
}  // namespace dodgesim

#include "sim/paper/rate_grid.h"

#include <gtest/gtest.h>

#include "sim/base/error.h"
#include "tests/sim/paper/synthetic_campaign.h"

namespace dodgesim {
namespace {

TEST(RateGrid, CountsTheDodgesOfEachValue) {
  // Even throws have 4 m/s, odd ones 8 m/s.
  const LoadedCampaign flown =
      campaign({thrown(0, true, false), thrown(1, true, true), thrown(2, true, true),
                thrown(3, true, true), thrown(4, false, false)});
  const Axis speeds("speed_mps", flown.results);
  const std::vector<Rate> rates = success_by(speeds, parts_of(flown).front().results);
  ASSERT_EQ(rates.size(), 2u);
  EXPECT_EQ(rates[0].count, 1);
  EXPECT_EQ(rates[0].of, 2);  // a throw that would have missed does not count
  EXPECT_EQ(rates[1].count, 0);
  EXPECT_EQ(rates[1].of, 2);
}

TEST(RateGrid, IsTransposed) {
  RateGrid grid{"speed", {"a", "b", "c"}};
  grid.add_row("x", {{1, 9}, {2, 9}, {3, 9}});
  grid.add_row("y", {{4, 9}, {5, 9}, {6, 9}});
  const RateGrid other = grid.transposed("letter");
  EXPECT_EQ(other.rows, grid.columns);
  EXPECT_EQ(other.columns, grid.rows);
  for (std::size_t i = 0; i < 2; ++i) {
    for (std::size_t k = 0; k < 3; ++k) {
      EXPECT_EQ(other.rates[k][i].count, grid.rates[i][k].count);
    }
  }
}

TEST(RateGrid, SumsItsRows) {
  RateGrid grid{"speed", {"a", "b"}};
  grid.add_row("x", {{1, 3}, {2, 4}});
  const RateGrid summed = grid.with_sum();
  EXPECT_EQ(summed.columns.back(), "all");
  EXPECT_EQ(summed.rates[0].back().count, 3);
  EXPECT_EQ(summed.rates[0].back().of, 7);
}

TEST(RateGrid, IsWrittenForPeopleAndPrograms) {
  RateGrid grid{"speed", {"a", "b"}};
  grid.add_row("x", {{25, 34}, {0, 0}});
  EXPECT_EQ(grid.table().rows[0][1], "25 / 34 (0.57 to 0.85)");
  EXPECT_EQ(grid.table().rows[0][2], "-");
  EXPECT_EQ(rates_csv({grid}),
            "table,row,column,dodged,of,rate,lo,hi\nspeed,x,a,25,34,0.7353,0.5688,0.8540\n"
            "speed,x,b,0,0,,,\n");
}

TEST(LastHalf, IsTheLastRateOfAtLeastOneHalf) {
  EXPECT_EQ(last_half({{10, 10}, {8, 10}, {2, 10}}), 1u);
  EXPECT_EQ(last_half({{10, 10}, {5, 10}, {0, 0}}), 1u);
  EXPECT_EQ(last_half({{10, 10}, {2, 10}, {6, 10}}), 2u);
  EXPECT_FALSE(last_half({{4, 10}, {2, 10}}));
}

TEST(MedianText, LeavesOutAnIntervalThatASmallSampleDoesNotHave) {
  Measured sample;
  EXPECT_EQ(median_text(sample, 1), "-");
  for (const double value : {1.0, 2.0, 3.0}) sample.add(value);
  EXPECT_EQ(median_text(sample, 1), "2.0");
  for (int i = 0; i < 100; ++i) sample.add(2.0);
  EXPECT_EQ(median_text(sample, 1), "2.0 (2.0 to 2.0)");
}

TEST(SweepValue, MustBeThere) {
  const Part part{0, {{"delays.perception_us", "3000"}, {"pilot", "oracle"}}, "oracle", {}, {}};
  EXPECT_EQ(sweep_number(part, "delays.perception_us"), 3000);
  EXPECT_EQ(sweep_value(part, "pilot"), "oracle");
  EXPECT_THROW(sweep_number(part, "pilot"), ScenarioError);
  EXPECT_THROW(sweep_value(part, "seed"), ScenarioError);
}

TEST(AddCurve, LeavesOutWhatHadNoTrials) {
  Plot plot;
  add_curve("x", 1, {4, 6, 8}, {{1, 2}, {0, 0}, {2, 2}}, plot);
  EXPECT_EQ(plot.series.at(0).x, (std::vector<double>{4, 8}));
  EXPECT_EQ(plot.series.at(0).y, (std::vector<double>{0.5, 1}));
}

}  // namespace
}  // namespace dodgesim

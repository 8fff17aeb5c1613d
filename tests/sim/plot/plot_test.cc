#include "sim/plot/plot.h"

#include <gtest/gtest.h>

#include <set>
#include <string>
#include <tuple>

namespace dodgesim {
namespace {

Plot falling(int count, const std::string& name) {
  Plot plot;
  plot.title = "title";
  for (int i = 0; i < count; ++i) {
    plot.series.push_back({name.empty() ? "" : name + std::to_string(i),
                           Series::Kind::kLine,
                           i,
                           {0, 1},
                           {1.0 + i, 0},
                           {}});
  }
  return plot;
}

int differing_rows(const cv::Mat3b& a, const cv::Mat3b& b) {
  int rows = 0;
  for (int y = 0; y < a.rows; ++y) rows += cv::norm(a.row(y), b.row(y), cv::NORM_INF) > 0 ? 1 : 0;
  return rows;
}

TEST(Plot, NamesStandAboveTheAxesAndCoverNothing) {
  const cv::Mat3b bare = draw(falling(3, "")), named = draw(falling(3, "name "));
  ASSERT_GT(named.rows, bare.rows);
  ASSERT_EQ(named.cols, bare.cols);
  const int below = bare.rows - 28;  // the title's
  EXPECT_EQ(differing_rows(named.rowRange(named.rows - below, named.rows),
                           bare.rowRange(bare.rows - below, bare.rows)),
            0);
  EXPECT_EQ(differing_rows(named.rowRange(0, 28), bare.rowRange(0, 28)), 0);
}

TEST(Plot, ManyNamesTakeMoreLines) {
  EXPECT_GT(draw(falling(6, "a series with a long name ")).rows, draw(falling(6, "n")).rows);
}

TEST(Plot, EverySeriesHasItsColourAmongTheNames) {
  const cv::Mat3b bare = draw(falling(6, "")), named = draw(falling(6, "a long enough name "));
  const cv::Mat3b names = named.rowRange(28, 28 + named.rows - bare.rows);
  std::set<std::tuple<int, int, int>> colours;
  for (const cv::Vec3b& pixel : names) {
    if (pixel[0] != pixel[1] || pixel[1] != pixel[2]) colours.emplace(pixel[0], pixel[1], pixel[2]);
  }
  EXPECT_EQ(colours.size(), 5u);  // the sixth is grey, as the letters are
}

TEST(Plot, AHistogramHoldsSharesOfAllValues) {
  const Series bars = histogram("", 0, {0.1, 0.2, 0.6, 5}, 0, 1, 2);
  EXPECT_EQ(bars.x, (std::vector<double>{0.25, 0.75}));
  EXPECT_EQ(bars.y, (std::vector<double>{0.5, 0.25}));
}

}  // namespace
}  // namespace dodgesim

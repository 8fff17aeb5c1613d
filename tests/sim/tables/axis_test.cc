#include "sim/tables/axis.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "sim/base/error.h"
#include "tests/sim/tables/fake_throws.h"

namespace dodgesim {
namespace {

using ::testing::ElementsAre;

TEST(Bins, AFewRoundValuesStandForThemselves) {
  const std::vector<Bin> bins = make_bins({0.3, 0.1, 0.1, 0.2}, 0.1);
  ASSERT_EQ(bins.size(), 3u);
  EXPECT_EQ(bins[0].text(), "0.1");
  EXPECT_TRUE(bins[0].contains(0.1));
  EXPECT_FALSE(bins[0].contains(0.10001));
}

TEST(Bins, DrawnValuesFallIntoHalfOpenBins) {
  const std::vector<Bin> bins = make_bins({2.21345678, 4.0, 3.99999}, 1);
  ASSERT_EQ(bins.size(), 3u);
  EXPECT_EQ(bins[0].text(), "2 to 3");
  EXPECT_EQ(bins[2].text(), "4 to 5");
  EXPECT_TRUE(bins[2].contains(4.0));
  EXPECT_FALSE(bins[1].contains(4.0));
}

TEST(Bins, EveryValueIsInExactlyOneBin) {
  std::vector<double> values;
  for (int i = 0; i < 1000; ++i) values.push_back(0.01 + 0.00099 * i);
  for (int i = 1; i < 10; ++i) values.push_back(0.1 * i);
  const std::vector<Bin> bins = make_bins(values, 0.1);
  for (const double value : values) {
    int count = 0;
    for (const Bin& bin : bins) count += bin.contains(value) ? 1 : 0;
    EXPECT_EQ(count, 1) << value;
  }
}

// 0.3 / 0.1 is below 3, 0.7 / 0.1 below 7.
TEST(Bins, TheLargestValueIsInABinThoughItsQuotientIsRoundedDown) {
  for (const double largest : {0.3, 0.6, 0.7, 0.30000000000000004}) {
    const std::vector<Bin> bins = make_bins({0.05123456, 0.1, largest}, 0.1);
    EXPECT_TRUE(bins.back().contains(largest)) << largest;
  }
}

TEST(Bins, OfNoValuesAreNone) { EXPECT_TRUE(make_bins({}, 1).empty()); }

TEST(Axis, NeverPutsCellsOfAGridTogether) {
  std::vector<ThrowResult> results;
  for (const char* size : {"0.0625", "0.07", "0.08", "0.09", "0.1", "0.11", "0.3"}) {
    results.push_back(ball(0, std::stod(size), 3, 5));
    results.back().cell_values = {{"throw.size_m", size}};
  }
  const Axis axis("size_m", results);
  EXPECT_THAT(axis.values(), ElementsAre("0.0625", "0.07", "0.08", "0.09", "0.1", "0.11", "0.3"));
  for (std::size_t i = 0; i < results.size(); ++i) EXPECT_EQ(axis.of(results[i]), i);
}

TEST(Axis, GivesEveryThrowItsPlace) {
  const std::vector<ThrowResult> results = {ball(0, 0.3, 2.2, 4), ball(1, 0.1, 4.9, 4),
                                            ThrowResult{}};
  const Axis size("size_m", results), distance("distance_m", results), object("object", results);
  EXPECT_THAT(size.values(), ElementsAre("0.1", "0.3"));
  EXPECT_EQ(size.of(results[0]), 1u);
  EXPECT_THAT(distance.values(), ElementsAre("2.2", "4.9"));
  EXPECT_THAT(object.values(), ElementsAre("ball"));
  EXPECT_FALSE(object.of(results[2]));
  EXPECT_FALSE(size.of(results[2]));
}

TEST(Axis, NeverPutsValuesTogetherThatComeAgain) {
  std::vector<ThrowResult> results;
  for (int i = 0; i < 8; ++i) {
    results.push_back(ball(i, i % 3 == 0 ? 0.067 : 0.0735, 3.0005, 4.1 + 0.01 * i * i));
    results.back().launch_height_m = 1 + 1.0 / (3 + i % 2);
  }
  EXPECT_THAT(Axis("size_m", results).values(), ElementsAre("0.067", "0.0735"));
  EXPECT_THAT(Axis("distance_m", results).values(), ElementsAre("3.0005"));
  EXPECT_THAT(Axis("speed_mps", results).values(), ElementsAre("4 to 5"));
  EXPECT_EQ(Axis("launch_height_m", results).values().size(), 2u);
}

TEST(Axis, TakesWhatASweepFliesAgainForDrawn) {
  std::vector<ThrowResult> results;
  for (int i = 0; i < 6; ++i) {
    results.push_back(ball(i, 0.1, 3, 4 + 0.12345 * (i % 3)));
    results.back().sweep = i / 3;
  }
  EXPECT_THAT(Axis("speed_mps", results).values(), ElementsAre("4 to 5"));
}

TEST(Axis, OfBinsHasTheirMiddles) {
  std::vector<ThrowResult> results;
  for (int i = 0; i < 10; ++i) results.push_back(ball(i, 0.1, 3, 4.05 + 0.2 * i));
  const Axis speed("speed_mps", results);
  EXPECT_THAT(speed.values(), ElementsAre("4 to 5", "5 to 6"));
  EXPECT_THAT(speed.middles(), ElementsAre(4.5, 5.5));
}

TEST(Axis, MayBeAKeyOfTheGridInItsOrder) {
  std::vector<ThrowResult> results = {ball(0, 0.1, 3, 4), ball(1, 0.1, 3, 4), ball(2, 0.1, 3, 4)};
  results[0].cell_values = results[2].cell_values = {{"throw.speed_mps", "!uniform [8, 9]"}};
  results[1].cell_values = {{"throw.speed_mps", "!uniform [4, 5]"}};
  const Axis speed("throw.speed_mps", results);
  EXPECT_THAT(speed.values(), ElementsAre("!uniform [8, 9]", "!uniform [4, 5]"));
  EXPECT_EQ(speed.of(results[2]), 0u);
}

TEST(Axis, TakesDifferentSpellingsOfANumberForOneValue) {
  std::vector<ThrowResult> results;
  for (const char* size : {"0.1", "0.10", "0.3", "1.0e-1"}) {
    results.push_back(ball(0, std::stod(size), 3, 5));
    results.back().cell_values = {{"throw.size_m", size}};
  }
  for (const char* name : {"size_m", "throw.size_m"}) {
    const Axis axis(name, results);
    EXPECT_THAT(axis.values(), ElementsAre("0.1", "0.3"));
    EXPECT_THAT(axis.middles(), ElementsAre(0.1, 0.3));
    EXPECT_EQ(axis.of(results[1]), 0u);
    EXPECT_EQ(axis.of(results[3]), 0u);
  }
}

TEST(Axis, OfAGridHasMiddlesOnlyIfAllItsValuesAreNumbers) {
  std::vector<ThrowResult> results = {ball(0, 0.1, 3, 4), ball(1, 0.1, 3, 8)};
  results[0].cell_values = {{"throw.speed_mps", "4"}, {"throw.object", "ball"}};
  results[1].cell_values = {{"throw.speed_mps", "!uniform [8, 9]"}, {"throw.object", "box"}};
  const std::vector<Axis> axes = grid_axes(results);
  ASSERT_EQ(axes.size(), 2u);
  EXPECT_EQ(axes[1].name(), "throw.object");
  for (const Axis& axis : axes) EXPECT_THAT(axis.middles(), ::testing::IsEmpty());
  EXPECT_TRUE(grid_axes({ball(0, 0.1, 3, 4)}).empty());
}

TEST(Axis, ThatThereIsNoneOfIsAnErrorThatListsThem) {
  try {
    static_cast<void>(Axis("colour", {}));
    FAIL();
  } catch (const ScenarioError& error) {
    EXPECT_THAT(error.what(), ::testing::HasSubstr("\"colour\"; known: size_m, distance_m"));
  }
}

}  // namespace
}  // namespace dodgesim

#include "dodge/detect/assignment.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

namespace dodge {
namespace {

using ::testing::ElementsAre;

// The least sum by trying everything.
double least_sum(const std::vector<double>& costs, std::size_t rows, std::size_t columns,
                 double limit, std::size_t row, std::vector<bool>& taken) {
  if (row == rows) return 0;
  double least = limit + least_sum(costs, rows, columns, limit, row + 1, taken);
  for (std::size_t j = 0; j < columns; ++j) {
    const double cost = costs[row * columns + j];
    if (taken[j] || cost > limit) continue;
    taken[j] = true;
    least = std::min(least, cost + least_sum(costs, rows, columns, limit, row + 1, taken));
    taken[j] = false;
  }
  return least;
}

TEST(Assignment, HasTheLeastSumOfAll) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> cost(0, 8);
  std::uniform_int_distribution<std::size_t> size(0, 6);
  Assignment assignment(6);
  for (int repeat = 0; repeat < 500; ++repeat) {
    const std::size_t rows = size(random), columns = size(random);
    std::vector<double> costs(rows * columns);
    for (double& c : costs) c = repeat % 2 == 0 ? cost(random) : std::floor(cost(random));
    const auto columns_of = assignment.solve(costs, rows, columns, 5);
    ASSERT_EQ(columns_of.size(), rows);
    std::vector<bool> taken(columns, false), none(columns, false);
    double sum = 0;
    for (std::size_t i = 0; i < rows; ++i) {
      if (columns_of[i] < 0) {
        sum += 5;
        continue;
      }
      const auto j = static_cast<std::size_t>(columns_of[i]);
      ASSERT_FALSE(taken.at(j));
      taken[j] = true;
      ASSERT_LE(costs[i * columns + j], 5);
      sum += costs[i * columns + j];
    }
    EXPECT_NEAR(sum, least_sum(costs, rows, columns, 5, 0, none), 1e-9) << repeat;
  }
}

TEST(Assignment, DoesNotTakeTheCheapestPairWhereThatCostsMore) {
  Assignment assignment(2);
  EXPECT_THAT(assignment.solve(std::vector<double>{0.5, 0.4, 9, 0.5}, 2, 2, 5), ElementsAre(0, 1));
}

TEST(Assignment, LeavesRowsWithoutAColumnThatIsCheapEnough) {
  Assignment assignment(3);
  EXPECT_THAT(assignment.solve(std::vector<double>{6, 5, 4}, 3, 1, 5), ElementsAre(-1, -1, 0));
  EXPECT_THAT(assignment.solve(std::vector<double>{6, 7}, 1, 2, 5), ElementsAre(-1));
}

}  // namespace
}  // namespace dodge

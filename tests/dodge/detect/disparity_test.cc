#include "dodge/detect/disparity.h"

#include <gtest/gtest.h>

#include <cmath>
#include <utility>

namespace dodge {
namespace {

// A smooth ring of positive rho with a negative one inside.
cv::Mat1f ring(double x0, double y0, double radius) {
  cv::Mat1f image(120, 160, 0.0F);
  for (int y = 0; y < image.rows; ++y) {
    for (int x = 0; x < image.cols; ++x) {
      const double d = std::hypot(x - x0, y - y0) - radius;
      image(y, x) = static_cast<float>(0.3 * std::exp(-0.5 * d * d) -
                                       0.3 * std::exp(-0.5 * (d + 3) * (d + 3)));
    }
  }
  return image;
}

cv::Rect around(double x0, double y0, double radius) {
  const int r = static_cast<int>(radius) + 3;
  return {static_cast<int>(x0) - r, static_cast<int>(y0) - r, 2 * r + 1, 2 * r + 1};
}

TEST(FindRowShift, IsExactToATenthOfAPixel) {
  const cv::Mat1f pattern = ring(80, 80, 8);
  for (int i = 0; i < 67; ++i) {
    const double shift = -40 + 0.3 * i;
    const auto found =
        find_row_shift(pattern, around(80, 80, 8), ring(80, 80 + shift, 8), -50, -10);
    ASSERT_TRUE(found.has_value());
    EXPECT_NEAR(found->shift_px, shift, 0.1);
    EXPECT_GT(found->correlation, 0.95);
  }
}

TEST(FindRowShift, FindsAPartOfTheOutlineInTheWhole) {
  const cv::Mat1f whole = ring(80, 50, 10);
  cv::Mat1f part = ring(80, 80, 10);
  part.rowRange(76, 120) = 0.0F;  // one camera sees the upper edge only
  const auto found = find_row_shift(part, {66, 66, 28, 12}, whole, -45, -15);
  ASSERT_TRUE(found.has_value());
  EXPECT_NEAR(found->shift_px, -30, 0.1);
}

TEST(FindRowShift, GoesUphillBeyondTheSearch) {
  const cv::Mat1f pattern = ring(80, 80, 8), image = ring(80, 60.3, 8);
  for (const auto& [least, most] : {std::pair(-25, -15), {-18, -10}, {-30, -22}}) {
    const auto found = find_row_shift(pattern, around(80, 80, 8), image, least, most);
    ASSERT_TRUE(found.has_value());
    EXPECT_NEAR(found->shift_px, -19.7, 0.1) << least << " to " << most;
  }
}

TEST(FindRowShift, FindsNothingInNothing) {
  const cv::Mat1f empty(120, 160, 0.0F), pattern = ring(80, 60, 8);
  EXPECT_FALSE(find_row_shift(pattern, around(80, 60, 8), empty, -20, 20).has_value());
  EXPECT_FALSE(find_row_shift(empty, around(80, 60, 8), pattern, -20, 20).has_value());
  EXPECT_FALSE(find_row_shift(pattern, around(80, 60, 8), pattern, 70, 90).has_value());
}

TEST(FindRowShift, CutsPatchesAndShiftsAtTheBorder) {
  const cv::Mat1f pattern = ring(3, 115, 8);
  const auto found = find_row_shift(pattern, around(3, 115, 8), ring(3, 4, 8), -200, 200);
  ASSERT_TRUE(found.has_value());
  EXPECT_NEAR(found->shift_px, -111, 3);
}

TEST(BestCorrelation, IsTheGreatestOfAllShifts) {
  const cv::Mat1f pattern = ring(80, 80, 8), near = ring(80, 62.4, 9), far = ring(80, 31.3, 8);
  cv::Mat1f image;
  cv::add(near, far, image);
  const cv::Rect patch = around(80, 80, 8);
  const auto nearest = find_row_shift(pattern, patch, image, -22, -14);
  const auto farthest = find_row_shift(pattern, patch, image, -54, -44);
  ASSERT_TRUE(nearest.has_value() && farthest.has_value());
  ASSERT_GT(farthest->correlation, nearest->correlation + 0.05);
  EXPECT_NEAR(best_correlation(pattern, patch, image, -119, -1), farthest->correlation, 1e-6);
  EXPECT_NEAR(best_correlation(pattern, patch, image, -25, -1), nearest->correlation, 1e-6);
}

TEST(BestCorrelation, CutsPatchesAndShiftsAtTheBorder) {
  const cv::Mat1f pattern = ring(3, 115, 8), image = ring(3, 4, 8);
  const cv::Rect patch = around(3, 115, 8);
  const auto found = find_row_shift(pattern, patch, image, -200, 200);
  ASSERT_TRUE(found.has_value());
  EXPECT_NEAR(best_correlation(pattern, patch, image, -200, 200), found->correlation, 1e-6);
  EXPECT_EQ(best_correlation(pattern, patch, image, 5, 200), 0);
}

}  // namespace
}  // namespace dodge

#include "sim/render/turned_picture.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "tests/sim/render/far_pattern.h"

namespace dodgesim {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;
using testing::blended;
using testing::Pattern;
using testing::picture;
using testing::taken;
using testing::turn;
using testing::view;
using testing::waves;

double largest_difference(const std::vector<float>& a, const std::vector<float>& b) {
  EXPECT_EQ(a.size(), b.size());
  double largest = 0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    largest = std::max(largest, std::abs(static_cast<double>(a[i]) - static_cast<double>(b[i])));
  }
  return largest;
}

TEST(TurnedPicture, SeenFromItsOwnOrientationIsTheViewItself) {
  const Matrix3d R = turn(0.3, {1, 2, 3});
  TurnedPicture a = taken(R, waves(7)), b = taken(R, waves(9));
  const auto view_a = picture(view(), R, waves(7));
  std::vector<float> copied(view_a.size());
  a.copy_view(copied);
  EXPECT_EQ(copied, view_a);
  EXPECT_LT(largest_difference(blended(a, b, R, 0), view_a), 1e-3);
  EXPECT_LT(largest_difference(blended(a, b, R, 1), picture(view(), R, waves(9))), 1e-3);
}

TEST(TurnedPicture, SeesWhatACameraOfAnotherOrientationSees) {
  const Vector3d axes[] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {-1, -2, 0.5}};
  for (const Vector3d& axis : axes) {
    const Matrix3d first = turn(0.2, {0, 1, 1});
    for (const double rad : {-0.04, 0.013, 0.05}) {
      const Matrix3d R = first * turn(rad, axis);
      TurnedPicture a = taken(first, waves(12));
      const auto seen = blended(a, a, R, 0.5);
      // The pattern's amplitude is 0.2; it moves by up to 10 px.
      EXPECT_LT(largest_difference(seen, picture(view(), R, waves(12))), 0.02);
      EXPECT_GT(largest_difference(seen, picture(view(), first, waves(12))), 0.05);
    }
  }
}

TEST(TurnedPicture, BlendsByTheShareOfTheSecond) {
  const Matrix3d R = turn(0.01, {0, 1, 0});
  TurnedPicture a = taken(Matrix3d::Identity(), [](const Vector3d&) { return 0.2; });
  TurnedPicture b = taken(turn(0.02, {0, 1, 0}), [](const Vector3d&) { return 0.6; });
  for (const float luminance : blended(a, b, R, 0.25)) EXPECT_NEAR(luminance, 0.3, 1e-6);
}

TEST(TurnedPicture, StaysPositiveAtTheDarkSideOfAnEdge) {
  const Pattern edge = [](const Vector3d& d) { return d.x() > 0 ? 1.0 : 0.01; };
  TurnedPicture a = taken(Matrix3d::Identity(), edge);
  for (const double rad : {0.001, 0.0025, 0.004}) {
    for (const float luminance : blended(a, a, turn(rad, {0.1, 1, 0}), 0.5)) {
      EXPECT_GE(luminance, 0.0079f);
      EXPECT_LE(luminance, 1.2f);
    }
  }
}

}  // namespace
}  // namespace dodgesim

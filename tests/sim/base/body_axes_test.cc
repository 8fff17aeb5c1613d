#include "sim/base/body_axes.h"

#include <gtest/gtest.h>

#include <set>

namespace dodgesim {
namespace {

TEST(BodyAxes, AreColumnsInTheBody) {
  Eigen::Matrix3d camera;
  camera << 0, 0, 1, -1, 0, 0, 0, -1, 0;
  EXPECT_EQ(axes_named("right down forward"), camera);
  EXPECT_EQ(axes_named("forward left up"), Eigen::Matrix3d::Identity());
  EXPECT_EQ(axes_named(" forward  left up "), Eigen::Matrix3d::Identity());
}

TEST(BodyAxes, AllHaveNamesOfTheirOwn) {
  std::set<std::string> names;
  int number = 0;
  for (const Eigen::Matrix3d& axes : all_axes()) {
    EXPECT_EQ(axes_named(names_of_axes(axes)), axes) << names_of_axes(axes);
    EXPECT_NEAR(axes.determinant(), number++ < 24 ? 1 : -1, 1e-12);
    names.insert(names_of_axes(axes));
  }
  EXPECT_EQ(names.size(), 48u);
}

TEST(BodyAxes, AreThreeDirectionsAtRightAngles) {
  for (const char* words : {"", "forward left", "forward left up up", "forward backward up",
                            "forward left sideways", "forward, left, up", "Forward left up"}) {
    EXPECT_FALSE(axes_named(words)) << words;
  }
}

}  // namespace
}  // namespace dodgesim

#include "sim/camera/camera.h"

#include <gtest/gtest.h>

namespace dodgesim {
namespace {

TEST(Intrinsics, PixelsReachHalfOfOneAroundTheirCentres) {
  const Intrinsics camera = {.width = 4, .height = 3};
  for (const double x : {-0.5, 0.0, 3.0, 3.499}) {
    for (const double y : {-0.5, 0.0, 2.0, 2.499}) EXPECT_TRUE(camera.contains({x, y}));
  }
  for (const double x : {-0.501, 3.5}) EXPECT_FALSE(camera.contains({x, 1})) << x;
  for (const double y : {-0.501, 2.5}) EXPECT_FALSE(camera.contains({1, y})) << y;
}

}  // namespace
}  // namespace dodgesim

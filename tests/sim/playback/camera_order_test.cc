#include "sim/playback/camera_order.h"

#include <gtest/gtest.h>

namespace dodgesim {
namespace {

using Clusters = std::vector<dodge::Cluster>;

Clusters one_at(double x, double y) {
  Clusters clusters(1);
  clusters.front().centroid = {x, y};
  return clusters;
}

TEST(CameraOrder, WhatIsNearStandsLowerInTheUpperCamera) {
  CameraOrder right, wrong;
  for (int i = 0; i < 10; ++i) {
    EXPECT_FALSE(wrong.surely_swapped());
    right.add(one_at(100 + i, 80), one_at(103 + i, 60));
    wrong.add(one_at(103 + i, 60), one_at(100 + i, 80));
  }
  EXPECT_EQ(right.counted(), 10);
  EXPECT_EQ(right.swapped(), 0);
  EXPECT_FALSE(right.surely_swapped());
  EXPECT_EQ(wrong.swapped(), 10);
  EXPECT_TRUE(wrong.surely_swapped());
}

TEST(CameraOrder, AFewOddCyclesDoNotDecide) {
  CameraOrder order;
  for (int i = 0; i < 30; ++i) order.add(one_at(100, 60), one_at(100, 80));
  for (int i = 0; i < 6; ++i) order.add(one_at(100, 80), one_at(100, 60));
  EXPECT_TRUE(order.surely_swapped());
  order.add(one_at(100, 80), one_at(100, 60));
  EXPECT_FALSE(order.surely_swapped());
}

// Different things, what is far away, and what cannot be told apart.
TEST(CameraOrder, CountsOnlyWhatIsTheSameThingAndNear) {
  CameraOrder order;
  order.add(one_at(100, 60), one_at(109, 80));
  order.add(one_at(100, 60), one_at(100, 61));
  order.add(one_at(100, 60), {});
  order.add({}, {});
  Clusters two = one_at(100, 60);
  two.push_back(two.front());
  order.add(two, one_at(100, 80));
  EXPECT_EQ(order.counted(), 0);
}

}  // namespace
}  // namespace dodgesim

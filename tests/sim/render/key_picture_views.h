// What the tests of KeyPicture share.
#pragma once

#include <gtest/gtest.h>

#include <vector>

#include "tests/sim/render/analytic_scene.h"

namespace dodgesim::testing {

inline const Eigen::Isometry3d kAtOrigin = Eigen::Isometry3d::Identity();

inline std::vector<float> shown(KeyPicture& key, const Eigen::Isometry3d& X_WC,
                                const Intrinsics& view = small_view()) {
  std::vector<float> out = blank(view);
  EXPECT_TRUE(key.show(X_WC, whole(view), out.data()));
  return out;
}

// A wall 1 m away in front of one 4 m away.
inline AnalyticScene corner_of_a_wall() {
  return nearer_of(half_wall(1, 0.011, 0.9), plane({0, 0, 1}, 4, 1e6));
}

}  // namespace dodgesim::testing

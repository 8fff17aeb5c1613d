// Pictures of the static scene that are drawn from a place to which the camera is on its way.
#include <gtest/gtest.h>

#include "tests/sim/render/key_picture_views.h"

namespace dodgesim {
namespace {

using namespace testing;  // NOLINT(google-build-using-namespace)
using Eigen::Isometry3d;
using Eigen::Vector3d;

const Isometry3d kNow = pose(turn(0.4, {1, -2, 1}), {0.1, 0.2, -0.1});

bool serves(KeyPicture& key, const Isometry3d& X_WC) {
  std::vector<float> out = blank(small_view());
  return key.show(X_WC, whole(small_view()), out.data());
}

// How long a picture that is drawn from X_WK serves a camera that goes on as it does [s].
double served_s(const AnalyticScene& scene, const Isometry3d& X_WK, const CameraMotion& motion) {
  constexpr double kStepS = 2e-4;
  KeyPicture key = key_of(scene, X_WK);
  double t_s = 0;
  while (t_s < 1 && serves(key, motion.after(t_s))) t_s += kStepS;
  return t_s;
}

struct Case {
  const char* name;
  AnalyticScene scene;
  Vector3d v_C, w_C;  // in the camera's frame
};

CameraMotion motion_of(const Case& c) {
  return {kNow, kNow.linear() * c.v_C, kNow.linear() * c.w_C};
}

class KeyAhead : public ::testing::TestWithParam<Case> {};

TEST_P(KeyAhead, ServesNowAndNearlyTwiceAsLong) {
  const CameraMotion motion = motion_of(GetParam());
  const KeyPicture last = key_of(GetParam().scene, kNow);
  const Isometry3d ahead = last.pose_ahead(motion);
  const double here_s = served_s(GetParam().scene, kNow, motion);
  ASSERT_GT(here_s, 0);
  ASSERT_LT(here_s, 0.1);
  EXPECT_GT(served_s(GetParam().scene, ahead, motion), 1.6 * here_s);
}

const Case kCases[] = {
    {"Yaw", sky_waves(12), {0, 0, 0}, {0, 4, 0}},
    {"PitchAndRoll", sky_waves(12), {0, 0, 0}, {-3, 0, 3}},
    {"Sideways", plane({0, 0, 1}, 2, 1), {5, 0, 0}, {0, 0, 0}},
    {"Backwards", plane({0, 0, 1}, 2, 1), {0, 0, -5}, {0, 0, 0}},
    {"TurningAsItGoes", plane({0, 0, 1}, 2, 1), {3, 0, 1}, {0, 2, 0}},
};

INSTANTIATE_TEST_SUITE_P(Motions, KeyAhead, ::testing::ValuesIn(kCases),
                         [](const auto& info) { return info.param.name; });

TEST(KeyPictureAhead, OfACameraAtRestIsDrawnWhereItIs) {
  const KeyPicture last = key_of(sky_waves(12), kNow);
  const CameraMotion rest = {kNow, Vector3d::Zero(), Vector3d::Zero()};
  EXPECT_TRUE(last.pose_ahead(rest).isApprox(kNow));
}

TEST(KeyPictureAhead, TheFirstAndThoseThatMayNotBeAwayAreDrawnWhereTheCameraIs) {
  const CameraMotion motion = {kNow, {1, 2, 3}, {4, 5, 6}};
  EXPECT_TRUE(KeyPicture(small_view(), KeySpec{}).pose_ahead(motion).isApprox(kNow));
  KeySpec every;
  every.max_misplacement_px = 0;
  EXPECT_TRUE(key_of(sky_waves(12), kNow, every).pose_ahead(motion).isApprox(kNow));
}

}  // namespace
}  // namespace dodgesim

#include "sim/outcome/trajectory.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "sim/base/error.h"

namespace dodgesim {
namespace {

using Eigen::Vector3d;

// 1.4 s of a vehicle that dodges two balls, of which the second is launched later.
Trajectory dodge() {
  Trajectory trajectory;
  trajectory.start_us = 400000;
  trajectory.period_us = 20000;
  trajectory.end_us = 400000 + 69 * 20000 + 250;
  trajectory.sizes_m = {0.2, 0.3};
  for (int i = 0; i <= 70; ++i) {
    const double t = 0.02 * i;
    Trajectory::Sample sample;
    sample.p_W = {-2, 10 * t * t, 2 + 0.1 * t};
    sample.q_W = Eigen::AngleAxisd(-std::min(1.2, 3 * t), Vector3d::UnitX());
    sample.evading = i > 20;
    if (sample.evading) sample.command_W = {0, 5, 0.4};
    sample.objects.resize(2);
    if (i >= 5) sample.objects[0] = Vector3d(3 - 7 * t, 0, 1.5 + 2 * t - 4.905 * t * t);
    if (i >= 50) sample.objects[1] = Vector3d(3 - 8 * t, 1, 1.2);
    trajectory.samples.push_back(sample);
  }
  for (int i = 0; i < 40; ++i) {
    trajectory.detections.push_back({600000 + 10000 * i, {2 - 0.07 * i, 0.01 * i, 1.5}, i > 3});
  }
  return trajectory;
}

TEST(Trajectory, ComesBackToTheRoundingOfItsParts) {
  const Trajectory sent = dodge();
  const Trajectory got = trajectory_from_bytes(to_bytes(sent));
  EXPECT_EQ(got.start_us, sent.start_us);
  EXPECT_EQ(got.period_us, sent.period_us);
  EXPECT_EQ(got.end_us, sent.end_us);
  EXPECT_EQ(got.sizes_m, sent.sizes_m);
  ASSERT_EQ(got.samples.size(), sent.samples.size());
  for (std::size_t i = 0; i < sent.samples.size(); ++i) {
    const auto &a = sent.samples[i], &b = got.samples[i];
    EXPECT_LT((a.p_W - b.p_W).cwiseAbs().maxCoeff(), 0.00051);
    EXPECT_LT((a.command_W - b.command_W).cwiseAbs().maxCoeff(), 0.051);
    EXPECT_LT(a.q_W.angularDistance(b.q_W), 0.02);
    EXPECT_EQ(a.evading, b.evading);
    for (std::size_t k = 0; k < 2; ++k) {
      ASSERT_EQ(a.objects[k].has_value(), b.objects[k].has_value());
      if (a.objects[k]) {
        EXPECT_LT((*a.objects[k] - *b.objects[k]).cwiseAbs().maxCoeff(), 0.00051);
      }
    }
  }
  ASSERT_EQ(got.detections.size(), sent.detections.size());
  for (std::size_t i = 0; i < sent.detections.size(); ++i) {
    EXPECT_EQ(got.detections[i].output_us, sent.detections[i].output_us);
    EXPECT_EQ(got.detections[i].true_object, sent.detections[i].true_object);
    EXPECT_LT((got.detections[i].p_W - sent.detections[i].p_W).norm(), 0.009);
  }
}

TEST(Trajectory, OfAThrowTakesLittleRoom) { EXPECT_LT(to_bytes(dodge()).size(), 1300u); }

TEST(Trajectory, ThatIsCutAnywhereOrDamagedIsRefusedOrReadButNeverMore) {
  const std::string bytes = to_bytes(dodge());
  for (std::size_t size = 0; size < bytes.size(); ++size) {
    EXPECT_THROW(trajectory_from_bytes(std::string_view(bytes).substr(0, size)), IoError) << size;
  }
  EXPECT_THROW(trajectory_from_bytes(bytes + '\0'), IoError);
  for (std::size_t i = 0; i < bytes.size(); ++i) {
    for (const int flip : {1, 64, 128, 255}) {
      std::string damaged = bytes;
      damaged[i] = static_cast<char>(damaged[i] ^ flip);
      try {
        trajectory_from_bytes(damaged);
      } catch (const IoError&) {
      }
    }
  }
}

TEST(Trajectory, OfAFlightWithoutThrowOrSamplesIsATrajectory) {
  EXPECT_TRUE(trajectory_from_bytes(to_bytes(Trajectory{})).samples.empty());
}

}  // namespace
}  // namespace dodgesim

// Frames far apart give the events of the light between them, or the check fails.
#include "sim/check/far_frames.h"

#include <gtest/gtest.h>

#include "tests/sim/check/outcomes.h"

namespace dodgesim {
namespace {

TEST(FarFramesCheck, FailsForOtherEventsThanThoseOfTheLightBetween) {
  const std::vector<FarFrames> good = measure_far_frames(event_camera_preset("sees1"), 1);
  ASSERT_EQ(good.size(), 2u);
  EXPECT_TRUE(failures(judge(good)).empty());
  std::vector<FarFrames> broken = good;
  broken[0].difference.count_ratio = 0.98;
  EXPECT_EQ(failures(judge(broken)), Names{"frames.1000us.count"});
  broken = good;
  broken[0].difference.median_us = kSamplingStampLimitUs + good[0].early_us + 1;
  EXPECT_EQ(failures(judge(broken)), Names{"frames.1000us.stamps"});
  broken = good;
  broken[1].difference.median_us = kSamplingStampLimitUs + good[1].early_us + 1;
  EXPECT_EQ(failures(judge(broken)), Names{"frames.33333us.stamps"});
}

// A dim camera fails in no seed for what is known of its low-pass.
TEST(FarFramesCheck, PassesADimCamera) {
  EventCameraSpec dim = event_camera_preset("ideal");
  dim.photoreceptor_hz = 3000;
  dim.photoreceptor_dark_hz = 3;
  dim.illuminance_lux = 0.1;
  for (const std::uint64_t seed : {1, 2, 3}) {
    EXPECT_TRUE(failures(judge(measure_far_frames(dim, seed))).empty()) << seed;
  }
}

// Nearly all of its time passes in steps of which each has one cut-off.
TEST(FarFramesCheck, KnowsHowEarlyAStepsCutOffMakesASlowLowPass) {
  EventCameraSpec slow = event_camera_preset("sees1");
  slow.photoreceptor_hz = slow.photoreceptor_dark_hz = 1;
  std::vector<FarFrames> frames = measure_far_frames(slow, 1);
  EXPECT_GT(frames[1].difference.median_us, kSamplingStampLimitUs);
  EXPECT_TRUE(failures(judge(frames)).empty());
  frames[1].difference.median_us = kSamplingStampLimitUs + 93;  // 92.3 of 33 ms
  EXPECT_EQ(failures(judge(frames)), Names{"frames.33333us.stamps"});
}

TEST(FarFramesCheck, SaysSoWhereThereIsNothingToSee) {
  EventCameraSpec blind = event_camera_preset("ideal");
  blind.dead_pixel_fraction = 1;
  EXPECT_EQ(lines(judge(measure_far_frames(blind, 1)), Outcome::kOff),
            (Names{"frames.1000us", "frames.33333us"}));
  // The reference's low-passes come to rest too early, not those of the camera.
  EventCameraSpec slow = event_camera_preset("ideal");
  slow.follower_hz = 0.0363;
  const Check slowly = judge(measure_far_frames(slow, 1));
  EXPECT_EQ(lines(slowly, Outcome::kOff), Names{"frames.1000us"});
  EXPECT_TRUE(failures(slowly).empty());
}

}  // namespace
}  // namespace dodgesim

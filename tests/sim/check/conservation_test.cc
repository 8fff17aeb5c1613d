// Every pixel lies within its threshold of the light, or the check fails.
#include <gtest/gtest.h>

#include "sim/check/conservation.h"
#include "tests/sim/check/outcomes.h"

namespace dodgesim {
namespace {

TEST(ConservationCheck, FailsForAPixelBeyondItsThresholdUnlessItIsHeld) {
  const EventCameraSpec spec;
  PixelsAfterFilm after = measure_conservation(spec, 1);
  PixelState& pixel = after.pixels.at(777);
  ASSERT_FALSE(pixel.held);
  pixel.signal = pixel.reference + 1.01 * pixel.threshold_on;
  EXPECT_EQ(failures(judge(after, spec)), Names{"conservation.beyond"});
  pixel.held = true;
  EXPECT_EQ(failures(judge(after, spec)), Names());
  pixel.held = false;
  pixel.signal = pixel.reference - 1.01 * pixel.threshold_off;
  EXPECT_EQ(failures(judge(after, spec)), Names{"conservation.beyond"});
}

TEST(ConservationCheck, FailsForAPixelThatHasFallenSilent) {
  const EventCameraSpec spec;
  PixelsAfterFilm after = measure_conservation(spec, 1);
  after.answered.at(777) = false;
  EXPECT_EQ(failures(judge(after, spec)), Names{"conservation.stuck"});
}

TEST(ConservationCheck, FailsForTooManyDeadPixels) {
  EventCameraSpec broken;
  broken.dead_pixel_fraction = 0.002;
  EXPECT_EQ(failures(judge(measure_conservation(broken, 1), EventCameraSpec())),
            Names{"conservation.dead"});
}

}  // namespace
}  // namespace dodgesim

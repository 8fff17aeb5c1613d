// Events of a ramp keep apart by the refractory period, in steps of the clock, or the check fails.
#include <gtest/gtest.h>

#include "sim/check/refractory.h"
#include "tests/sim/check/outcomes.h"

namespace dodgesim {
namespace {

TEST(RefractoryCheck, FailsForAnotherPeriodAndForAnotherClock) {
  for (const std::int64_t refractory_us : {0, 100, 1000}) {
    for (const std::int64_t resolution_us : {1, 10, 250}) {
      EventCameraSpec spec;
      spec.refractory_us = refractory_us;
      spec.stamp_resolution_us = resolution_us;
      const RampEvents measured = measure_ramp(spec, 1);
      EXPECT_EQ(failures(judge(measured, spec)), Names()) << refractory_us << " " << resolution_us;
      EventCameraSpec longer = spec;
      longer.refractory_us = 2 * refractory_us + 10;
      EXPECT_EQ(failures(judge(measured, longer)).front(), "refractory.interval");
      EventCameraSpec finer = spec;
      finer.stamp_resolution_us = resolution_us + 70;
      EXPECT_FALSE(failures(judge(measured, finer)).empty());
    }
  }
}

TEST(RefractoryCheck, HoldsForCamerasThatAreLateSlowOrUneven) {
  EventCameraSpec late, slow, uneven;
  late.latency_us = 20000;
  slow.stamp_resolution_us = 20000;
  uneven.mismatch_sigma = 0.15;
  for (const EventCameraSpec& spec : {late, slow, uneven}) {
    EXPECT_EQ(failures(judge(measure_ramp(spec, 1), spec)), Names());
  }
}

TEST(RefractoryCheck, WaitsUntilTheLowPassesHaveSettled) {
  for (const char* preset : {"ideal", "sees1"}) {
    for (const double follower_hz : {10, 50, 100, 250}) {
      EventCameraSpec spec = event_camera_preset(preset);
      spec.follower_hz = follower_hz;
      const RampEvents measured = measure_ramp(spec, 1);
      const Check check = judge(measured, spec);
      EXPECT_EQ(failures(check), Names()) << preset << " " << follower_hz;
      EXPECT_EQ(check.lines.front().name, "refractory.interval");
      EventCameraSpec longer = spec;
      longer.refractory_us = 2 * spec.refractory_us + 20;
      EXPECT_EQ(failures(judge(measured, longer)).front(), "refractory.interval");
    }
  }
  EventCameraSpec dim = event_camera_preset("ideal"), slowest = event_camera_preset("ideal");
  dim.photoreceptor_hz = 1;
  dim.photoreceptor_dark_hz = 0.1;
  EXPECT_EQ(failures(judge(measure_ramp(dim, 1), dim)), Names());
  slowest.follower_hz = 0.001;
  EXPECT_EQ(lines(judge(measure_ramp(slowest, 1), slowest), Outcome::kOff),
            (Names{"refractory", "clock"}));
}

// Among them those that divide the time from one event to the next, 50 us.
TEST(RefractoryCheck, KnowsWhichWayAClockOfAnyResolutionRounds) {
  for (const std::int64_t resolution_us : {2, 7, 10, 25, 37, 50, 100, 333, 1000, 2000}) {
    EventCameraSpec spec = event_camera_preset("ideal");
    spec.stamp_resolution_us = resolution_us;
    RampEvents measured = measure_ramp(spec, 1);
    const Check check = judge(measured, spec);
    EXPECT_EQ(failures(check), Names()) << resolution_us;
    EXPECT_EQ(check.lines.back().name, "clock.rounded_by");
    const auto step_us = static_cast<double>(resolution_us);
    RampEvents nearest = measured;
    for (double& late_us : nearest.rounded_by_us) late_us -= late_us > step_us / 2 ? step_us : 0;
    if (resolution_us > 2) {  // a half goes up
      EXPECT_EQ(failures(judge(nearest, spec)), Names{"clock.rounded_by"}) << resolution_us;
    }
    for (double& late_us : measured.rounded_by_us) late_us -= late_us > 0 ? step_us : 0;
    EXPECT_EQ(failures(judge(measured, spec)), Names{"clock.rounded_by"}) << resolution_us;
  }
}

}  // namespace
}  // namespace dodgesim

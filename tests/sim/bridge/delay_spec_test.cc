#include "sim/bridge/delay_spec.h"

#include <gtest/gtest.h>

#include <limits>

#include "sim/base/random.h"

namespace dodgesim {
namespace {

// End of the newest packet of a camera that has arrived: packets end at multiples of their length.
TimeUs newest_end_us(const DelaySpec& delays, int camera, TimeUs now_us) {
  const TimeUs sent_us = now_us - delays.transport_us_of(camera);
  return sent_us / delays.packet_us * delays.packet_us;
}

TEST(DelaySpec, KnowsHowOldEventsAreAtBest) {
  RandomStream random(1, 0, "delays");
  const auto whole = [&](double least, double most) {
    return static_cast<int>(random.uniform(least, most));
  };
  for (int trial = 0; trial < 300; ++trial) {
    DelaySpec delays;
    delays.packet_us = 50 * whole(1, 200);
    delays.cycle_us = 250 * whole(1, 60);
    delays.compute_us = whole(0, 20000);
    delays.transport_us = whole(0, 30000);
    delays.lower_camera_us = whole(0, 30000);
    TimeUs upper_us = std::numeric_limits<TimeUs>::max(), lower_us = upper_us, lag_us = upper_us;
    for (int k = 0; k < 2000; ++k) {
      const TimeUs now_us =
          1000000000 / delays.period_us() * delays.period_us() + k * delays.period_us();
      const TimeUs upper_end_us = newest_end_us(delays, 0, now_us);
      const TimeUs lower_end_us = newest_end_us(delays, 1, now_us);
      upper_us = std::min(upper_us, now_us - upper_end_us);
      lower_us = std::min(lower_us, now_us - lower_end_us);
      lag_us = std::min(lag_us, upper_end_us - lower_end_us);
    }
    EXPECT_EQ(delays.least_event_age_us(0), upper_us) << trial;
    EXPECT_EQ(delays.least_event_age_us(1), lower_us) << trial;
    EXPECT_EQ(delays.least_lag_us(), lag_us) << trial;
  }
}

}  // namespace
}  // namespace dodgesim

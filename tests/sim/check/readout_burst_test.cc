// A burst is delivered at the readout's rate and its losses are counted, or the check fails.
#include <gtest/gtest.h>

#include "sim/check/readout_burst.h"
#include "tests/sim/check/outcomes.h"

namespace dodgesim {
namespace {

TEST(ReadoutCheck, IsOffForAReadoutThatIsTooSlowForAFilm) {
  EventCameraSpec spec;
  spec.readout_max_hz = 0.001;
  EXPECT_EQ(lines(judge(measure_burst(spec, 1), spec), Outcome::kOff), Names{"readout.rate"});
}

TEST(ReadoutCheck, FailsForAnotherRate) {
  EventCameraSpec broken;
  broken.readout_max_hz *= 1.02;
  EXPECT_EQ(failures(judge(measure_burst(broken, 1), EventCameraSpec())), Names{"readout.burst"});
  broken.readout_max_hz = 3e5;
  EventCameraSpec slow = broken;
  slow.readout_max_hz = 2.9e5;
  EXPECT_EQ(failures(judge(measure_burst(broken, 1), broken)), Names());
  EXPECT_EQ(failures(judge(measure_burst(broken, 1), slow)), Names{"readout.burst"});
}

TEST(ReadoutCheck, FailsForLossesThatAreNotCounted) {
  const EventCameraSpec spec;
  Burst burst = measure_burst(spec, 1);
  burst.second_delivered -= 1;
  EXPECT_EQ(failures(judge(burst, spec)), Names{"readout.second.not_counted"});
  burst = measure_burst(spec, 1);
  burst.lost = 1;
  EXPECT_EQ(failures(judge(burst, spec)), Names{"readout.lost"});
}

}  // namespace
}  // namespace dodgesim

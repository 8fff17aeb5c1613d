// Time stamps are spread over the clock's steps, or the check fails.
#include <gtest/gtest.h>

#include <cmath>

#include "sim/check/stamps.h"
#include "tests/sim/check/outcomes.h"

namespace dodgesim {
namespace {

TEST(StampCheck, FailsForStampsThatClump) {
  StampPhases phases = measure_stamps(EventCameraSpec(), 1);
  ASSERT_EQ(failures(judge(phases)), Names());
  ASSERT_GT(phases.phases.size(), 10000u);
  StampPhases clumped = phases;
  for (std::size_t i = 0; i < clumped.phases.size(); i += 10) clumped.phases[i] = 0.999;
  const Names failed = failures(judge(clumped));
  EXPECT_EQ(failed, (Names{"stamps.at_samples", "stamps.fullest_bin"}));
  // Equal slots, as of a simulator that spreads each picture's events over four instants.
  for (double& phase : phases.phases) phase = (std::floor(4 * phase) + 0.5) / 4;
  EXPECT_EQ(failures(judge(phases)).size(), 3u);
}

TEST(StampCheck, IsOffWithoutEvents) {
  EXPECT_EQ(lines(judge(StampPhases()), Outcome::kOff), Names{"stamps"});
}

}  // namespace
}  // namespace dodgesim

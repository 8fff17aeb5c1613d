// Finer sampling does not change the events, or the check fails.
#include <gtest/gtest.h>

#include "sim/check/convergence.h"
#include "tests/sim/check/outcomes.h"

namespace dodgesim {
namespace {

TEST(ConvergenceCheck, FailsForEventsThatDependOnTheSampling) {
  const std::vector<Sampled> good = measure_convergence(EventCameraSpec(), 1);
  ASSERT_EQ(good.at(2).displacement_px, 0.5);
  std::vector<Sampled> broken = good;
  broken[2].difference.count_ratio = 0.985;
  EXPECT_EQ(failures(judge(broken)), Names{"convergence.0.500px.count"});
  broken = good;
  broken[2].difference.median_us = 60;
  EXPECT_EQ(failures(judge(broken)), Names{"convergence.0.500px.stamps"});
  broken = good;
  broken[2].difference.matched = 0.8;
  EXPECT_EQ(failures(judge(broken)), Names{"convergence.0.500px.matched"});
}

TEST(ConvergenceCheck, SeesTheErrorGrowWithTheDisplacement) {
  const std::vector<Sampled> rates = measure_convergence(event_camera_preset("ideal"), 1);
  for (std::size_t i = 1; i < rates.size(); ++i) {
    EXPECT_LT(rates[i].difference.count_ratio, rates[i - 1].difference.count_ratio);
    EXPECT_GE(rates[i].difference.median_us, rates[i - 1].difference.median_us);
  }
}

}  // namespace
}  // namespace dodgesim

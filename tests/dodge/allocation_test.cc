// The flight core allocates no memory in flight.
#include <gtest/gtest.h>

#include "dodge/dodger.h"
#include "dodge/presets.h"
#include "tests/count_allocations.h"
#include "tests/dodge/synthetic_flight.h"

namespace dodge {
namespace {

using synthetic::kCycleUs;

struct Variant {
  const char* name;
  Config config;
};

void PrintTo(const Variant& variant, std::ostream* out) { *out << variant.name; }

Config stereo(const char* pilot) {
  Config config = preset(pilot);
  config.cameras = synthetic::vertical_pair();
  return config;
}

Config mono(const char* pilot) {
  Config config = stereo(pilot);
  config.position.depth = "mono";
  return config;
}

// The branches that the presets do not take: larger kernels, more groups than DBSCAN shall see.
Config unusual() {
  Config config = stereo("falanga2020");
  config.ego_motion.reference = "start";
  config.time_image.blur_px = 5;
  config.time_image.open_px = 0;
  config.time_image.dilate_px = 3;
  config.cluster.min_group_pixels = 1;
  config.cluster.max_groups = 2;
  config.position.stereo.disparity = "centres";
  config.position.centre = "centroid";
  return config;
}

// Balls that cross the view of a turning camera and one that comes.
std::vector<synthetic::Disk> scene() {
  std::vector<synthetic::Disk> disks = synthetic::far_background(15, 8);
  for (const double start_s : {0.15, 0.3}) {
    disks.push_back(synthetic::thrown_ball({1.3, -0.5, 0}, {1.3, 0.5, 0.1}, 4, 0.2, 1, start_s));
  }
  disks.push_back(synthetic::thrown_ball({3.5, 0.2, -0.2}, {0.1, 0, 0}, 6, 0.3, -1, 0.35));
  return disks;
}

class Allocation : public ::testing::TestWithParam<Variant> {};

TEST_P(Allocation, NoneFromTheFirstCycleOn) {
  if (!DODGESIM_OWN_MALLOC) GTEST_SKIP() << "malloc cannot be counted in this build.";
  synthetic::Flight flight(synthetic::turning, scene(), {}, 5);
  Dodger dodger(GetParam().config);
  dodger.set_goal({});
  int detections = 0, obstacles = 0, evading = 0;
  for (TimeUs t = kCycleUs; t <= 800000; t += kCycleUs) {
    flight.advance(t);
    const long before = allocations;
    dodger.add_range({t, 2});
    const VelocityCommand command = flight.feed(dodger);
    const long during = allocations - before;
    ASSERT_EQ(during, 0) << "at " << t << " us";
    detections += static_cast<int>(dodger.detections().size());
    obstacles += static_cast<int>(dodger.obstacles().size());
    evading += command.evading ? 1 : 0;
  }
  EXPECT_GT(detections, 20);  // all stages have worked
  EXPECT_GT(obstacles, 40);
  EXPECT_GT(evading, 5);
}

TEST(EventWindow, AllocatesNothingOnceItHasHeldAsManyEvents) {
  if (!DODGESIM_OWN_MALLOC) GTEST_SKIP() << "malloc cannot be counted in this build.";
  EventWindow window;
  long growing = 0, steady = 0;
  for (TimeUs t = 0; t < 500000; t += 1000) {
    const std::vector<Event> packet(6000, Event{.t_us = t});
    const long before = allocations;
    window.add(packet);
    window.take(t);
    window.forget_until(t - 10000);
    (t <= 20000 ? growing : steady) += allocations - before;
  }
  EXPECT_GT(growing, 0);
  EXPECT_EQ(steady, 0);
}

TEST(AllocationCount, SeesOperatorNewAndOpencv) {
  if (!DODGESIM_OWN_MALLOC) GTEST_SKIP() << "malloc cannot be counted in this build.";
  long before = allocations;
  std::vector<int> numbers(1000);
  EXPECT_EQ(allocations - before, 1);
  before = allocations;
  const cv::Mat1b image(100, 100);
  EXPECT_GE(allocations - before, 1);
}

INSTANTIATE_TEST_SUITE_P(Pilots, Allocation,
                         ::testing::Values(Variant{"falanga2020_stereo", stereo("falanga2020")},
                                           Variant{"falanga2020_mono", mono("falanga2020")},
                                           Variant{"dodgesim_stereo", stereo("dodgesim")},
                                           Variant{"dodgesim_mono", mono("dodgesim")},
                                           Variant{"unusual", unusual()}),
                         [](const auto& info) { return std::string(info.param.name); });

}  // namespace
}  // namespace dodge

// The event camera allocates no memory once its buffers have held as much as they need to.
#include <gtest/gtest.h>

#include <string>

#include "sim/events/event_camera.h"
#include "tests/count_allocations.h"
#include "tests/sim/events/moving_plane.h"

namespace dodgesim {
namespace {

class EventCameraAllocation : public ::testing::TestWithParam<const char*> {};

TEST_P(EventCameraAllocation, IsNoneOnceItHasSeenAsMuch) {
  if (!DODGESIM_OWN_MALLOC) GTEST_SKIP() << "malloc cannot be counted in this build.";
  testing::MovingPlane plane;
  plane.v_W = {0, 2, 0};
  const Intrinsics& view = plane.intrinsics;
  EventCamera camera(event_camera_preset(GetParam()), view.width, view.height, 3, 0, "top");
  std::vector<float> picture;
  std::vector<Event> events;
  plane.render(0, picture);
  camera.reset(0, picture.data());
  long first = 0, later = 0;
  std::size_t made = 0;
  for (TimeUs t_us = 1000; t_us <= 250000; t_us += 1000) {
    plane.render(t_us - 500, picture);
    const Rect region = {20, 20, 70, 50};
    long before = allocations;
    camera.add_region(t_us - 500, region, picture.data());
    long during = allocations - before;
    plane.render(t_us, picture);
    events.clear();
    before = allocations;
    camera.update(t_us, picture.data(), events);
    during += allocations - before;
    (t_us <= 150000 ? first : later) += during;
    made += events.size();
  }
  EXPECT_GT(made, 5000u);
  EXPECT_GT(first, 0);
  EXPECT_EQ(later, 0);
}

INSTANTIATE_TEST_SUITE_P(Presets, EventCameraAllocation,
                         ::testing::Values("ideal", "sees1", "noisy", "low_light"),
                         [](const auto& info) { return std::string(info.param); });

}  // namespace
}  // namespace dodgesim

// Is the sampling fine enough? A moving textured wall, sampled as the sampler wants it, against a
// reference sampled eight times as often.
#include <gtest/gtest.h>

#include "tests/sim/events/moving_plane.h"

namespace dodgesim {
namespace {

using testing::compare;
using testing::events_of;
using testing::MovingPlane;
using testing::sample_times;
using testing::subdivide;

struct Motion {
  const char* name;
  Eigen::Vector3d v_W;
  Eigen::Vector3d w_W;
  TimeUs duration_us;
};

class Convergence : public ::testing::TestWithParam<Motion> {};

INSTANTIATE_TEST_SUITE_P(Motions, Convergence,
                         ::testing::Values(Motion{"yaw", {0, 0, 0}, {0, 0, 5}, 25000},
                                           Motion{"roll", {0, 0, 0}, {5, 0, 0}, 50000},
                                           Motion{"slow_yaw", {0, 0, 0}, {0, 0, 0.5}, 100000},
                                           Motion{"sideways", {0, 3, 0}, {0, 0, 0}, 50000},
                                           Motion{"ahead", {3, 0, 0}, {0, 0, 0}, 50000},
                                           Motion{"dodge", {1, 2, 2}, {3, 1, -2}, 40000}),
                         [](const auto& info) { return info.param.name; });

TEST_P(Convergence, EventsAgreeWithAnEightTimesFinerReference) {
  MovingPlane plane;
  plane.v_W = GetParam().v_W;
  plane.w_W = GetParam().w_W;
  const auto times = sample_times(plane, SamplingSpec(), 1.7, GetParam().duration_us);
  for (const bool everything : {false, true}) {
    const EventCameraSpec spec = everything ? EventCameraSpec() : event_camera_preset("ideal");
    const auto events = events_of(plane, spec, times);
    const auto reference = events_of(plane, spec, subdivide(times, 8));
    ASSERT_GT(reference.size(), 3000u);
    const auto difference = compare(events, reference);
    EXPECT_LT(std::abs(difference.count), 0.02);
    EXPECT_LT(difference.median_us, 100);
    EXPECT_GT(difference.matched, 0.8);
  }
}

TEST(Convergence, EightTimesFinerIsAReferenceBecauseTheErrorFallsWithTheSquareOfTheInterval) {
  MovingPlane plane;
  plane.w_W = Eigen::Vector3d(0, 0, 5);
  const auto times = sample_times(plane, SamplingSpec(), 1.7, 25000);
  const auto spec = event_camera_preset("ideal");
  const auto reference = events_of(plane, spec, subdivide(times, 16));
  const double full = std::abs(compare(events_of(plane, spec, times), reference).count);
  const double half =
      std::abs(compare(events_of(plane, spec, subdivide(times, 2)), reference).count);
  EXPECT_LT(half, 0.4 * full);
}

}  // namespace
}  // namespace dodgesim

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "sim/events/event_camera.h"
#include "tests/sim/events/moving_plane.h"
#include "tests/sim/render/far_pattern.h"

namespace dodgesim {
namespace {

using Eigen::Vector3d;
using testing::blended;
using testing::picture;
using testing::taken;
using testing::turn;
using testing::view;
using testing::waves;

// Events of a fast turn: keys 10 px apart and pictures turned from them every pixel, against
// pictures computed eight times as often.
TEST(TurnedScene, GivesTheEventsOfATurnThatIsSeenEightTimesAsOften) {
  constexpr double kRateRadps = 8;
  constexpr TimeUs kKeyUs = 4000, kStepUs = 500, kEndUs = 24000;
  const auto orientation = [](TimeUs t) {
    return turn(kRateRadps * seconds(t), Vector3d(0.3, 1, 0.2));
  };
  const auto seen_at = [&](TimeUs t) { return picture(view(), orientation(t), waves(16)); };
  EventCamera coarse(ideal_event_camera(), view().width, view().height, 1, 0, "top");
  EventCamera fine(ideal_event_camera(), view().width, view().height, 1, 0, "top");
  coarse.reset(0, seen_at(0).data());
  fine.reset(0, seen_at(0).data());
  std::vector<Event> by_keys, reference;
  TurnedPicture before = taken(orientation(0), waves(16));
  for (TimeUs key = kKeyUs; key <= kEndUs; key += kKeyUs) {
    TurnedPicture now = taken(orientation(key), waves(16));
    for (TimeUs t = key - kKeyUs + kStepUs; t <= key; t += kStepUs) {
      const double share = static_cast<double>(t - key + kKeyUs) / kKeyUs;
      coarse.update(t, blended(before, now, orientation(t), share).data(), by_keys);
    }
    before = now;
  }
  for (TimeUs t = kStepUs / 8; t <= kEndUs; t += kStepUs / 8) {
    fine.update(t, seen_at(t).data(), reference);
  }
  ASSERT_GT(reference.size(), 10000u);
  const auto difference = testing::compare(by_keys, reference);
  EXPECT_LT(std::abs(difference.count), 0.02);
  EXPECT_LT(difference.median_us, 100);
  EXPECT_GT(difference.matched, 0.8);
}

}  // namespace
}  // namespace dodgesim

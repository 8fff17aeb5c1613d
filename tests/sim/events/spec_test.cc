#include "sim/events/spec.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <limits>
#include <map>
#include <stdexcept>
#include <string>

#include "sim/base/random.h"
#include "tests/sim/events/reference.h"

namespace dodgesim {
namespace {

using testing::emulate;
using testing::event_order;
using testing::every;
using testing::film;

// Collects every number with its limits, or sets one of them.
struct Numbers {
  struct Number {
    double value, min, max;
  };
  void operator()(const char* name, std::string& value, std::initializer_list<const char*> allowed,
                  const char*) {
    if (!preset.empty() && name == std::string("preset")) value = preset;
    EXPECT_NE(std::find(allowed.begin(), allowed.end(), value), allowed.end());
  }
  template <class T, class Least, class Most>
  void operator()(const char* name, T& value, Least min, Most max, const char*) {
    const auto set = given.find(name);
    if (set != given.end()) value = static_cast<T>(set->second);
    all[name] = {static_cast<double>(value), static_cast<double>(min), static_cast<double>(max)};
  }
  std::string preset;
  std::map<std::string, double> given;
  std::map<std::string, Number> all;
};

double lively(int x, int y, TimeUs t) {
  const auto block =
      RandomStream(7, 0, "walk")
          .block(static_cast<std::uint64_t>(t) * 1000 + static_cast<std::uint64_t>(y * 17 + x));
  return std::exp(4 * unit_interval(block[0]) - 4);
}

std::vector<Event> run(const EventCameraSpec& spec, std::string_view name = "top",
                       std::uint64_t seed = 1) {
  EventCamera camera(spec, 17, 9, seed, 0, name);
  auto events = emulate(camera, film(17, 9, every(500, 20000), lively));
  EXPECT_TRUE(std::is_sorted(events.begin(), events.end(), event_order));
  return events;
}

TEST(EventCameraPreset, EveryOneLiesWithinItsLimitsAndIsKnownByItsName) {
  for (const char* name : {"sees1", "ideal", "noisy", "low_light"}) {
    EventCameraSpec spec = event_camera_preset(name);
    EXPECT_EQ(spec.preset, name);
    Numbers numbers;
    spec.visit(numbers);
    EXPECT_GT(numbers.all.size(), 20u);
    for (const auto& [key, number] : numbers.all) {
      EXPECT_GE(number.value, number.min) << name << " " << key;
      EXPECT_LE(number.value, number.max) << name << " " << key;
    }
    EXPECT_GT(run(spec).size(), 100u) << name;
  }
  EXPECT_THROW(event_camera_preset("dvs128"), std::invalid_argument);
}

TEST(EventCameraPreset, IsTheBaseOfTheKeysThatAreGiven) {
  EventCameraSpec spec;
  Numbers reader;
  reader.preset = "ideal";
  reader.given = {{"leak_hz", 3}};
  spec.visit(reader);
  EXPECT_EQ(spec.preset, "ideal");
  EXPECT_EQ(spec.leak_hz, 3);
  EXPECT_EQ(spec.photoreceptor_hz, 0);
  EXPECT_EQ(spec.latency_us, 0);
  // Reading what was written changes nothing.
  Numbers again;
  again.preset = "ideal";
  for (const auto& [key, number] : reader.all) again.given[key] = number.value;
  EventCameraSpec copy;
  copy.visit(again);
  for (const auto& [key, number] : again.all) EXPECT_EQ(number.value, reader.all[key].value) << key;
}

TEST(EventCameraPreset, LowLightIsTheSameCameraWithLessLight) {
  EventCameraSpec spec = event_camera_preset("low_light");
  EXPECT_LT(spec.illuminance_lux, 10);
  spec.illuminance_lux = EventCameraSpec().illuminance_lux;
  EXPECT_EQ(run(spec), run(EventCameraSpec()));
}

TEST(EventCameraSpec, ZeroSwitchesEachPartOff) {
  EventCameraSpec spec = event_camera_preset("noisy");
  spec.mismatch_sigma = 0;
  spec.photoreceptor_hz = 0;
  spec.refractory_us = 0;
  spec.leak_hz = 0;
  spec.shot_noise_on_hz = spec.shot_noise_off_hz = 0;
  spec.hot_pixel_fraction = 0;
  spec.dead_pixel_fraction = 0;
  spec.latency_us = 0;
  spec.jitter_us = 0;
  spec.readout_max_hz = 0;
  const auto ideal = run(event_camera_preset("ideal"));
  EXPECT_EQ(run(spec), ideal);
  spec.hot_pixel_fraction = 1;
  spec.hot_pixel_hz = 0;
  EXPECT_EQ(run(spec), ideal);
}

TEST(EventCameraSpec, AnyParameterMayLieAtItsLimits) {
  for (const char* preset : {"sees1", "ideal"}) {
    Numbers numbers;
    EventCameraSpec base = event_camera_preset(preset);
    base.visit(numbers);
    for (const auto& [key, number] : numbers.all) {
      for (const double limit : {number.min, number.max}) {
        EventCameraSpec spec = event_camera_preset(preset);
        Numbers set;
        set.given = {{key, limit}};
        spec.visit(set);
        SCOPED_TRACE(std::string(preset) + " " + key + " " + std::to_string(limit));
        const auto events = run(spec);
        for (const Event& event : events) {
          ASSERT_GT(event.t_us, 0);
          ASSERT_LE(event.t_us, 20000);
        }
      }
    }
  }
}

TEST(EventCameraSpec, AnyLuminanceThatIsANumberIsSeen) {
  constexpr float kMost = std::numeric_limits<float>::max();
  const std::vector<float> values = {0.0f, kMost, 1e-45f, 1.0f, 1e-38f, 1e30f, -0.0f, 5e37f};
  for (const char* preset : {"sees1", "ideal"}) {
    for (const double epsilon : {1e-9, 1e-3, 1e3}) {
      for (const double follower_hz : {0.0, 500.0}) {
        EventCameraSpec spec = event_camera_preset(preset);
        spec.log_epsilon = epsilon;
        spec.follower_hz = follower_hz;
        EventCamera camera(spec, 19, 1, 1, 0, "top");
        const auto frames = film(19, 1, every(300, 30000), [](int, int, TimeUs) { return 0.0; });
        std::vector<Event> events;
        for (std::size_t i = 0; i < frames.size(); ++i) {
          std::vector<float> picture;
          for (std::size_t x = 0; x < 19; ++x) {
            picture.push_back(values[(i * (x + 1) + x) % values.size()]);
          }
          if (i == 0) {
            camera.reset(0, picture.data());
          } else {
            camera.update(frames[i].t_us, picture.data(), events);
          }
        }
        EXPECT_GT(events.size(), 50u);
        EXPECT_TRUE(std::is_sorted(events.begin(), events.end(), event_order));
        for (int x = 0; x < 19; ++x) {
          EXPECT_TRUE(std::isfinite(camera.pixel(x, 0).signal));
          EXPECT_TRUE(std::isfinite(camera.pixel(x, 0).reference));
        }
      }
    }
  }
}

TEST(EventCameraSpec, TheSameSeedGivesTheSameEventsAndEachCameraItsOwn) {
  const EventCameraSpec spec = event_camera_preset("noisy");
  const auto events = run(spec);
  EXPECT_EQ(run(spec), events);
  EXPECT_NE(run(spec, "bottom"), events);
  EXPECT_NE(run(spec, "top", 2), events);
}

}  // namespace
}  // namespace dodgesim

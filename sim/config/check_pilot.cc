#include "sim/config/check_pilot.h"

#include <stdexcept>
#include <string_view>

#include "sim/base/formatted.h"
#include "sim/base/numbers.h"
#include "sim/base/time.h"
#include "sim/camera/looking_forward.h"
#include "sim/config/pilot.h"

namespace dodgesim {

namespace {

// What the flight core says of a parameter, at the place of its key; of several, at that of all.
void add_core_problem(const std::string& what, ReadContext& context) {
  constexpr std::string_view kBegins = "The parameter ";
  if (what.starts_with(kBegins)) {
    const std::string text = "dodger." + what.substr(kBegins.size());
    const auto at = context.where.find(text.substr(0, text.find(' ')));
    if (at != context.where.end()) return context.problems.add(at->second, text);
  }
  context.add_problem("dodger", "dodger does not fit together: " + what);
}

// The flight core checks its own configuration. Which cameras it gets is known only with the
// vehicle's model; a rectified pair of one pixel each stands for them.
void check_dodger(const Scenario& scenario, ReadContext& context) {
  dodge::Config config = scenario.dodger;
  config.cameras.resize(2);
  config.cameras[0].X_BC.translation().z() = 0.15;
  for (dodge::CameraModel& camera : config.cameras) {
    camera.X_BC.linear() = looking_forward();
    camera.width = camera.height = 1;
  }
  try {
    dodge::validate(config);
  } catch (const std::invalid_argument& error) {
    add_core_problem(error.what(), context);
  }
}

// A monitor that takes every reading for the end of a pause never lands the vehicle.
void check_height_monitor(const Scenario& scenario, ReadContext& context) {
  const dodge::HeightMonitorConfig& monitor = scenario.dodger.height_monitor;
  const int rate_hz = scenario.sensors.range.rate_hz;
  if (!monitor.enabled) return;
  const auto expect_readings_within = [&](const std::string& key, std::int64_t gap_us,
                                          const std::string& otherwise) {
    if (gap_us * rate_hz >= 1000000) return;
    context.add_problem("sensors.range.rate_hz",
                        "sensors.range.rate_hz is " + std::to_string(rate_hz) +
                            ", too slow for dodger." + key + ", which is " +
                            std::to_string(gap_us) + ": " + otherwise +
                            "; raise it, or set dodger.height_monitor.enabled: false.");
  };
  expect_readings_within("height_monitor.max_gap_us", monitor.max_gap_us,
                         "the pilot would never land");
  expect_readings_within("landing.fresh_us", scenario.dodger.landing.fresh_us,
                         "a pilot that lands would not know its height");
  const auto expect_believed = [&](bool holds, const std::string& name, double value,
                                   const std::string& must, const std::string& other,
                                   double limit) {
    if (holds) return;
    const std::string key = "sensors.range." + name;
    context.add_problem(key, key + " is " + to_text(value) + ", but must " + must +
                                 " dodger.range_sensor." + other + ", which is " + to_text(limit) +
                                 ": the pilot would believe no reading, and never land.");
  };
  const auto& sensor = scenario.sensors.range;
  const auto& believed = scenario.dodger.range_sensor;
  expect_believed(sensor.max_range_m > believed.min_range_m, "max_range_m", sensor.max_range_m,
                  "exceed", "min_range_m", believed.min_range_m);
  expect_believed(sensor.min_range_m < believed.max_range_m, "min_range_m", sensor.min_range_m,
                  "be less than", "max_range_m", believed.max_range_m);
}

// Obstacles that are forgotten before the next look are never confirmed.
void check_memory(const Scenario& scenario, ReadContext& context) {
  const dodge::Config& dodger = scenario.dodger;
  if (dodger.association.min_detections < 2 || dodger.repulsive.k_r0 == 0) return;
  const double lifetime_s = dodge::decay_lifetime_s(dodger.repulsive);
  const TimeUs period_us = scenario.delays.period_us();
  if (lifetime_s > seconds(period_us)) return;
  context.add_problem("dodger.repulsive",
                      "dodger.repulsive has an obstacle forgotten " +
                          formatted("%.3g", lifetime_s) +
                          " s after its last detection, when k_r0 has decayed to k_tau with "
                          "lambda_decay_1ps, but the next look comes after " +
                          std::to_string(period_us) +
                          " us (delays.cycle_us, or delays.compute_us if that is longer): the "
                          "pilot would never evade.");
}

// What our own pilots' window of events must be able to hold.
void check_window(const Scenario& scenario, ReadContext& context) {
  const dodge::WindowConfig& window = scenario.dodger.window;
  const DelaySpec& delays = scenario.delays;
  const std::string is_window =
      " dodger.window.window_us, which is " + std::to_string(window.window_us) + ": ";
  if (delays.packet_us > window.window_us) {
    context.add_problem("delays.packet_us",
                        "delays.packet_us is " + std::to_string(delays.packet_us) +
                            ", but must not exceed" + is_window +
                            "of each packet the pilot would see the end alone.");
  }
  const std::int64_t resolution_us = scenario.sensors.events.stamp_resolution_us;
  if (resolution_us >= window.window_us) {
    context.add_problem("sensors.events.stamp_resolution_us",
                        "sensors.events.stamp_resolution_us is " + std::to_string(resolution_us) +
                            ", but must be less than" + is_window +
                            "all events of a window would have one time, and nothing would move.");
  }
}

// Our own pilots look at the events of a window that ends at most the timeout before now, and with
// two cameras at most the lag before the newest event of any.
void check_transport(const Scenario& scenario, ReadContext& context) {
  const dodge::WindowConfig& window = scenario.dodger.window;
  const DelaySpec& delays = scenario.delays;
  const auto expect_less = [&](const std::string& delay, std::int64_t delay_us, TimeUs age_us,
                               const std::string& wait, std::int64_t wait_us,
                               const std::string& otherwise) {
    const std::int64_t most_us = window.window_us + wait_us;
    if (age_us < most_us) return;
    const std::string as_seen =
        age_us == delay_us ? "" : " (" + std::to_string(age_us) + " in whole packets and cycles)";
    context.add_problem(delay.substr(0, delay.find(' ')),
                        delay + std::to_string(delay_us) + as_seen +
                            ", but must be less than dodger.window.window_us and " + wait +
                            " together, which are " + std::to_string(most_us) + ": " + otherwise);
  };
  expect_less("delays.transport_us is ", delays.transport_us, delays.least_event_age_us(0),
              "event_timeout_us", window.event_timeout_us,
              "the pilot would never see an event; raise the timeout, or delay what it sees by "
              "delays.perception_us instead.");
  if (!scenario.dodger.position.stereo_depth()) return;
  expect_less("delays.lower_camera_us is ", delays.lower_camera_us, delays.least_lag_us(),
              "camera_lag_us", window.camera_lag_us,
              "the pilot would never see with both cameras at once; raise the lag.");
  if (delays.least_event_age_us(0) >= window.window_us + window.event_timeout_us) return;
  expect_less("delays.lower_camera_us and delays.transport_us together are ",
              delays.transport_us_of(1), delays.least_event_age_us(1), "event_timeout_us",
              window.event_timeout_us, "the pilot would never see an event of the lower camera.");
}

}  // namespace

void check_pilot(const Scenario& scenario, ReadContext& context) {
  check_dodger(scenario, context);
  if (!perceives(scenario.pilot)) return;
  check_height_monitor(scenario, context);
  if (scenario.pilot == kPluginPilot) return;
  check_memory(scenario, context);
  check_window(scenario, context);
  check_transport(scenario, context);
}

}  // namespace dodgesim

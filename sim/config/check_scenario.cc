#include "sim/config/check_scenario.h"

#include <map>
#include <stdexcept>
#include <string_view>

#include "sim/base/formatted.h"
#include "sim/base/numbers.h"
#include "sim/base/time.h"
#include "sim/base/utf8.h"
#include "sim/camera/looking_forward.h"
#include "sim/config/check_presets.h"
#include "sim/config/expand.h"
#include "sim/config/pilot.h"
#include "sim/sensors/sample_clock.h"

namespace dodgesim {

namespace {

constexpr std::int64_t kMostCombinations = 10000;
constexpr std::int64_t kMostThrows = 10000000;

// Adds the complaint if a text has a control character, of ASCII or of Latin-1 (U+0080 to U+009F),
// that is not allowed.
void check_text(const std::string& key, const std::string& text, std::string_view allowed,
                const std::string& complaint, ReadContext& context) {
  const bool from_file = key == "name" && !context.where.contains(key);
  const std::string what = from_file ? "The file's name, for want of the key name," : key;
  const auto byte = [&](std::size_t i) { return static_cast<unsigned char>(text[i]); };
  std::size_t length = 0;
  for (std::size_t i = 0; i < text.size(); i += length) {
    length = utf8_length(std::string_view(text).substr(i));
    if (length == 0) {
      return context.add_problem(key, what + " is not UTF-8 text.");
    }
    const bool control =
        byte(i) < 0x20 || byte(i) == 0x7f || (length == 2 && byte(i) == 0xc2 && byte(i + 1) < 0xa0);
    if (!control || allowed.find(text[i]) != std::string_view::npos) continue;
    return context.add_problem(key, what + complaint);
  }
}

// A name is the title of tables; a description may have lines.
void check_texts(const Scenario& scenario, ReadContext& context) {
  check_text("name", scenario.name, "", " has a line break, a tab or another control character.",
             context);
  check_text("description", scenario.description, "\n\t",
             " has a control character other than line break and tab.", context);
}

// A key that one type of mission needs, and the others must not have.
void check_mission_key(const Scenario& scenario, const std::string& type, const std::string& key,
                       bool given, ReadContext& context) {
  const std::string& mission = scenario.mission.type;
  if (mission == type && !given) {
    context.add_problem("mission.type",
                        key + " is missing, but mission.type " + type + " needs it.");
  }
  if (mission != type && given) {
    context.add_problem(key,
                        key + " is given, but mission.type " + mission + " does not fly there.");
  }
}

void check_throws(const Scenario& scenario, ReadContext& context) {
  if (scenario.throw_spec && !scenario.throws.empty()) {
    context.add_problem("throws", "throws and throw are both given; one of them is enough.");
  }
  int objects = 0;
  for (const ThrowSpec& spec : scenario.throw_specs()) objects += spec.count;
  if (objects > ThrowSpec::kMost) {
    context.add_problem("throws", "throws has " + std::to_string(objects) + " objects; at most " +
                                      std::to_string(ThrowSpec::kMost) + " can fly.");
  }
}

// How many combinations of values there are; of too many, more than kMostCombinations.
std::int64_t product(const VariedKeys& axes) {
  std::int64_t count = 1;
  for (const VariedKey& axis : axes) {
    count *= static_cast<std::int64_t>(axis.values.size());
    if (count > kMostCombinations) break;
  }
  return count;
}

// `stop` needs a single success rate, of throws that would have hit.
void check_stop(const Scenario& scenario, ReadContext& context) {
  if (!scenario.stop) return;
  if (!scenario.anyone_throws()) {
    context.add_problem("stop", "stop is given, but nobody throws.");
  }
  if (!scenario.sweep.empty()) {
    context.add_problem("stop",
                        "stop and sweep are both given, but the success rates of different sweep "
                        "values are not one.");
  }
  if (product(scenario.grid) > 1) {
    context.add_problem("stop",
                        "stop and grid are both given, but a campaign that ends within a round of "
                        "its cells has flown some oftener than others, and its interval would "
                        "not hold: draw the key instead, as in size_m: !choice [0.1, 0.2].");
  }
}

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
// vehicle's model; a rectified pair stands for them.
void check_dodger(const Scenario& scenario, ReadContext& context) {
  dodge::Config config = scenario.dodger;
  config.cameras.resize(2);
  config.cameras[0].X_BC.translation().z() = 0.15;
  for (dodge::CameraModel& camera : config.cameras) camera.X_BC.linear() = looking_forward();
  try {
    dodge::validate(config);
  } catch (const std::invalid_argument& error) {
    add_core_problem(error.what(), context);
  }
}

void check_vehicle(const Scenario& scenario, ReadContext& context) {
  const VehicleOverrides& vehicle = scenario.vehicle_overrides;
  constexpr double kLeast = VehicleOverrides::kLeastMassOfInertia;
  if (vehicle.mass_scale >= kLeast * vehicle.inertia_scale) return;
  context.add_problem("vehicle_overrides.mass_scale",
                      "vehicle_overrides.mass_scale is " + to_text(vehicle.mass_scale) +
                          ", but must be at least " + to_text(kLeast) +
                          " of vehicle_overrides.inertia_scale, which is " +
                          to_text(vehicle.inertia_scale) +
                          ": so light a vehicle would climb away when its rotors turn it.");
}

// A monitor that takes every reading for the end of a pause never lands the vehicle.
void check_height_monitor(const Scenario& scenario, ReadContext& context) {
  const dodge::HeightMonitorConfig& monitor = scenario.dodger.height_monitor;
  const int rate_hz = scenario.sensors.range.rate_hz;
  if (!perceives(scenario.pilot) || !monitor.enabled) return;
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
  if (!perceives(scenario.pilot) || scenario.pilot == kPluginPilot) return;
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

// Our own pilots look at the events of a window that ends at most the timeout before now, and with
// two cameras at most the lag before the newest event of any.
void check_transport(const Scenario& scenario, ReadContext& context) {
  const dodge::WindowConfig& window = scenario.dodger.window;
  if (!perceives(scenario.pilot) || scenario.pilot == kPluginPilot) return;
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
  if (scenario.dodger.position.depth != "stereo") return;
  expect_less("delays.lower_camera_us is ", delays.lower_camera_us, delays.least_lag_us(),
              "camera_lag_us", window.camera_lag_us,
              "the pilot would never see with both cameras at once; raise the lag.");
  if (delays.least_event_age_us(0) >= window.window_us + window.event_timeout_us) return;
  expect_less("delays.lower_camera_us and delays.transport_us together are ",
              delays.transport_us_of(1), delays.least_event_age_us(1), "event_timeout_us",
              window.event_timeout_us, "the pilot would never see an event of the lower camera.");
}

void check_rate(const std::string& key, int rate_hz, ReadContext& context) {
  if (SampleClock::fits(rate_hz)) return;
  context.add_problem(key, key + " is " + std::to_string(rate_hz) + ", but must divide " +
                               std::to_string(SampleClock::kTickRateHz) + ".");
}

void check_rates(const Scenario& scenario, ReadContext& context) {
  check_rate("sensors.imu.rate_hz", scenario.sensors.imu.rate_hz, context);
  check_rate("sensors.state_estimate.rate_hz", scenario.sensors.state_estimate.rate_hz, context);
  check_rate("sensors.range.rate_hz", scenario.sensors.range.rate_hz, context);
  const int period_us = scenario.flight_controller.period_us;
  if (period_us % kTickUs != 0) {
    const std::string key = "flight_controller.period_us";
    context.add_problem(key, key + " is " + std::to_string(period_us) +
                                 ", but must be a multiple of " + std::to_string(kTickUs) + ".");
  }
}

struct ValueOfKey {
  std::string key;
  double value;
};

// Adds a problem for two keys whose values exclude each other, at the one that the scenario gives.
// `must` is what the first must do to the second, "be less than", `converse` the second to the
// first.
void add_contradiction(const ValueOfKey& a, const std::string& must, const ValueOfKey& b,
                       const std::string& converse, ReadContext& context) {
  const bool a_given = context.where.contains(a.key) || !context.where.contains(b.key);
  const auto &about = a_given ? a : b, &other = a_given ? b : a;
  context.add_problem(about.key, about.key + " is " + to_text(about.value) + ", but must " +
                                     (a_given ? must : converse) + " " + other.key + ", which is " +
                                     to_text(other.value) + ".");
}

void check_range_sensor(const Scenario& scenario, ReadContext& context) {
  const RangeSpec& range = scenario.sensors.range;
  if (range.min_range_m < range.max_range_m) return;
  add_contradiction({"sensors.range.min_range_m", range.min_range_m}, "be less than",
                    {"sensors.range.max_range_m", range.max_range_m}, "exceed", context);
}

// A pilot that takes the vehicle for faster than it may fly predicts escapes that never happen.
void check_speed_limit(const Scenario& scenario, ReadContext& context) {
  const double limit_mps = scenario.controller.evading_speed_limit_mps;
  const double pilot_mps = scenario.dodger.velocity_limit.max_speed_mps;
  if (scenario.pilot == kNoPilot || pilot_mps <= limit_mps) return;
  add_contradiction({"dodger.velocity_limit.max_speed_mps", pilot_mps}, "not exceed",
                    {"controller.evading_speed_limit_mps", limit_mps}, "not be less than", context);
}

void check_cruise_speed(const Scenario& scenario, ReadContext& context) {
  const MissionSpec& mission = scenario.mission;
  const double limit_mps = scenario.dodger.velocity_limit.max_speed_mps;
  if (mission.type == "hover" || mission.speed_mps <= limit_mps) return;
  add_contradiction({"mission.speed_mps", mission.speed_mps}, "not exceed",
                    {"dodger.velocity_limit.max_speed_mps", limit_mps}, "not be less than",
                    context);
}

// Of a rotor's thrusts that the scenario sets. What a model says is known only to the simulation.
void check_thrust(const Scenario& scenario, ReadContext& context) {
  const double least_n = scenario.motors.min_thrust_n;
  const double most_n = scenario.vehicle_overrides.max_thrust_n;
  if (most_n == 0 || least_n < most_n) return;
  add_contradiction({"motors.min_thrust_n", least_n}, "be less than",
                    {"vehicle_overrides.max_thrust_n", most_n}, "exceed", context);
}

void check_keys_together(const Scenario& scenario, ReadContext& context) {
  const MissionSpec& mission = scenario.mission;
  check_mission_key(scenario, "goal", "mission.goal_m", mission.goal_m.has_value(), context);
  check_mission_key(scenario, "waypoints", "mission.waypoints_m", !mission.waypoints_m.empty(),
                    context);
  check_throws(scenario, context);
  check_dodger(scenario, context);
  check_vehicle(scenario, context);
  check_height_monitor(scenario, context);
  check_memory(scenario, context);
  check_transport(scenario, context);
  check_rates(scenario, context);
  check_range_sensor(scenario, context);
  check_thrust(scenario, context);
  check_speed_limit(scenario, context);
  check_cruise_speed(scenario, context);
}

// Whether there are so few combinations that the counts of expand.h do not overflow.
bool check_counts(const Scenario& scenario, ReadContext& context) {
  const std::int64_t combinations = product(scenario.grid) * product(scenario.sweep);
  const Position at = context.position_of(scenario.grid.empty() ? "sweep" : "grid");
  if (combinations > kMostCombinations) {
    context.problems.add(at, "grid and sweep have more than " + std::to_string(kMostCombinations) +
                                 " combinations of values.");
    return false;
  }
  if (combinations * scenario.repeats > kMostThrows) {
    context.problems.add(
        at, "repeats, grid and sweep make " + std::to_string(combinations * scenario.repeats) +
                " throws; at most " + std::to_string(kMostThrows) + " are allowed.");
    return false;
  }
  return true;
}

void check_axis(const Scenario& scenario, const VariedKey& axis, bool in_grid,
                ReadContext& context) {
  if (axis.key.starts_with("throw.") && !scenario.anyone_throws()) {
    context.problems.add(axis.at,
                         axis.key + " has several values, but nobody throws; add throw: {}.");
    return;
  }
  if (in_grid && axis.key == "pilot") {
    context.problems.add(axis.at, "pilot belongs into sweep: pilots are compared, not pooled.");
  }
  if (axis.key == "stop" || axis.key.starts_with("stop.")) {
    context.problems.add(axis.at, axis.key + " cannot vary: it is about the whole campaign.");
  }
  for (const VariedKey& other : scenario.sweep) {
    if (in_grid && other.key == axis.key) {
      context.problems.add(axis.at, axis.key + " is in grid and in sweep.");
    }
  }
  for (const YamlNode& value : axis.values) with_values(scenario, {{axis.key, &value}}, context);
}

// Adds every problem of the combinations once, with the first one that has it unless all have.
void check_combinations(const Scenario& scenario, ReadContext& context) {
  struct Found {
    Problems::Problem problem;
    std::string with;  // the first of the combinations: "mission.type hover"
    int combinations = 0;
  };
  std::map<std::string, Found> all;  // by place and sentence
  const int cells = cell_count(scenario), combinations = cells * sweep_count(scenario);
  for (int i = 0; i < combinations; ++i) {
    const Assignments values = values_of(scenario, i % cells, i / cells);
    ReadContext one = context;  // without problems, so far
    check_keys_together(with_values(scenario, values, one), one);
    for (const Problems::Problem& problem : one.problems.all()) {
      const std::string name = one.problems.place(problem.at) + problem.sentence;
      Found& found = all.try_emplace(name, Found{problem, label(as_text(values))}).first->second;
      ++found.combinations;
    }
  }
  for (const auto& [name, found] : all) {
    const bool always = found.combinations >= combinations;
    const std::string with = always ? "" : " That is so with " + found.with + ".";
    context.problems.add(found.problem.at, found.problem.sentence + with);
  }
}

}  // namespace

void check_scenario(const Scenario& scenario, ReadContext& context) {
  for (const VariedKey& axis : scenario.grid) check_axis(scenario, axis, true, context);
  for (const VariedKey& axis : scenario.sweep) check_axis(scenario, axis, false, context);
  check_texts(scenario, context);
  check_stop(scenario, context);
  check_varied_presets(scenario, context);
  context.problems.raise_if_any();
  if (!check_counts(scenario, context)) return;
  check_combinations(scenario, context);
}

}  // namespace dodgesim

#include "sim/config/check_scenario.h"

#include <map>
#include <string_view>

#include "sim/base/numbers.h"
#include "sim/base/time.h"
#include "sim/base/utf8.h"
#include "sim/config/check_pilot.h"
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
    context.add_problem("throw",
                        "throw is given, and throws too; one of them is enough: 'throw: ~' or "
                        "'throws: ~' takes away that of a scenario that this one extends.");
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
  check_pilot(scenario, context);
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
  if (axis.key.starts_with("stop.")) {
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

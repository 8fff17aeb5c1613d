#include "sim/tables/throw_statistics.h"

#include <algorithm>
#include <utility>

#include "sim/base/formatted.h"
#include "sim/config/pilot.h"
#include "sim/files/text_table.h"

namespace dodgesim {

namespace {

std::optional<double> seconds_between(std::optional<TimeUs> from, std::optional<TimeUs> to) {
  if (!from || !to) return std::nullopt;
  return seconds(*to - *from);
}

void add_flight(const ThrowResult& result, ThrowResult::FlightOf by, PilotStatistics& sum) {
  const FlightResult& flight = result.*by;
  if (!result.thrown()) {
    if (flight.failed()) ++sum.tally.errors;
    if (flight.ok()) sum.tally.collisions.add(!flight.unharmed());
    return;
  }
  if (flight.status == "not flown") return;
  sum.tally.add(result, by);
  if (flight.ok()) sum.clearance_m.add(flight.clearance_m);
}

// Who is told the truth, or wants to know nothing, detects nothing.
void add_perception(const ThrowResult& result, ThrowStatistics& sum) {
  sum.false_alarms.add(result.false_alarm);
  if (!result.cause.empty()) ++sum.causes[result.cause];
  if (!result.thrown()) return;
  if (result.first_in_view_us && perceives(sum.flown().pilot)) {
    sum.detected.add(result.first_detection_us.has_value());
  }
  sum.detection_distance_m.add(result.first_detection_distance_m);
  if (result.time_to_contact_us) sum.time_to_contact_s.add(seconds(*result.time_to_contact_us));
  sum.view_to_detection_s.add(seconds_between(result.first_in_view_us, result.first_detection_us));
  sum.image_to_detection_s.add(
      seconds_between(result.first_detection_t_us, result.first_detection_us));
  if (result.false_alarm) return;
  sum.detection_to_command_s.add(
      seconds_between(result.first_detection_us, result.first_command_us));
}

}  // namespace

const char* role_name(Role role) {
  constexpr const char* kNames[] = {"flown", "oracle", "none"};
  return kNames[static_cast<std::size_t>(role)];
}

std::optional<double> Rate::value() const {
  if (of == 0) return std::nullopt;
  return static_cast<double>(count) / static_cast<double>(of);
}

std::string Rate::interval_name() const {
  if (stopped) return "none";
  if (!sequential) return "Wilson 95 %";
  return formatted("sequential %.4g %%", 100 * sequential->confidence);
}

std::string rate_text(const Rate& rate) {
  std::string text = std::to_string(rate.count) + " / " + std::to_string(rate.of);
  if (rate.of == 0) return text;
  if (rate.stopped) return text + " (" + fixed_text(*rate.value(), 3) + ")";
  const Interval interval = rate.interval();
  return text + " (" + fixed_text(*rate.value(), 3) + ", " + fixed_text(interval.lo, 3) + " to " +
         fixed_text(interval.hi, 3) + (rate.sequential ? ", " + rate.interval_name() : "") + ")";
}

std::string tally_text(const Tally& tally, Role role) {
  std::string text = rate_text(tally.shown(role));
  if (tally.errors == 0) return text;
  return text + ", " + std::to_string(tally.errors) + (tally.errors == 1 ? " error" : " errors");
}

void Tally::add(const ThrowResult& result, ThrowResult::FlightOf by) {
  const FlightResult &flight = result.*by, &none = result.none;
  if (result.nobody_could_fly()) {
    if (by == &ThrowResult::flown) ++errors;
    return;
  }
  if (flight.failed() || none.failed()) ++errors;
  if (flight.ok()) collisions.add(!flight.unharmed());
  if (flight.status == "not flown") return;
  ++throws;
  if (none.ok()) hit_undisturbed.add(none.hit);
  if (none.ok() && !none.hit) return;
  ++would_have_hit;  // or, where a flight failed, might have
  if (result.dodged(by)) ++dodged;
}

std::optional<QuantileEstimate> Measured::quantile(double share) const {
  std::vector<double> sorted = values_;
  std::ranges::sort(sorted);
  return estimate_quantile(sorted, share);
}

std::vector<FailedFlight> failed_flights(const ThrowResult& result, const std::string& pilot) {
  std::vector<FailedFlight> failed;
  if (result.flown.failed()) failed.push_back({&result.flown, pilot});
  if (result.nobody_could_fly()) return failed;
  if (result.none.failed() && pilot != kNoPilot) failed.push_back({&result.none, kNoPilot});
  if (result.oracle.failed() && pilot != kOraclePilot) {
    failed.push_back({&result.oracle, kOraclePilot});
  }
  return failed;
}

std::vector<Part> parts_of(const std::vector<ThrowResult>& results, const std::string& pilot) {
  std::map<int, Part> parts;
  for (const ThrowResult& result : results) {
    Part& part = parts[result.sweep];
    part.results.push_back(&result);
    if (part.results.size() > 1) continue;
    part.sweep = result.sweep;
    part.values = result.sweep_values;
    part.pilot = pilot;
    for (const AxisValue& value : part.values) {
      if (value.key == "pilot") part.pilot = value.value;
    }
  }
  if (parts.empty()) parts[0].pilot = pilot;
  std::vector<Part> in_order;
  in_order.reserve(parts.size());
  for (auto& [sweep, part] : parts) in_order.push_back(std::move(part));
  return in_order;
}

ThrowStatistics statistics_of(const Results& results, const std::string& pilot) {
  ThrowStatistics sum;
  PilotStatistics &flown = sum.by(Role::kFlown), &oracle = sum.by(Role::kOracle),
                  &none = sum.by(Role::kNone);
  flown.pilot = pilot;
  oracle.pilot = kOraclePilot;
  none.pilot = kNoPilot;
  for (const ThrowResult* result : results) {
    // Not beside itself.
    sum.oracle_flew =
        sum.oracle_flew || (pilot != kOraclePilot && result->oracle.status != "not flown");
    add_flight(*result, &ThrowResult::flown, flown);
    add_flight(*result, &ThrowResult::oracle, oracle);
    add_flight(*result, &ThrowResult::none, none);
    if (result->flown.ok()) add_perception(*result, sum);
  }
  return sum;
}

ThrowStatistics statistics_of(const Part& part) {
  ThrowStatistics sum = statistics_of(part.results, part.pilot);
  Tally& tally = sum.by(Role::kFlown).tally;
  tally.sequential = part.sequential;
  tally.collisions.stopped = part.sequential.has_value();
  return sum;
}

}  // namespace dodgesim

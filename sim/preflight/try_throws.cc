#include "sim/preflight/try_throws.h"

#include <algorithm>
#include <cstdint>
#include <numbers>
#include <numeric>
#include <set>
#include <stdexcept>
#include <string>
#include <utility>

#include "sim/base/error.h"
#include "sim/base/formatted.h"
#include "sim/config/expand.h"
#include "sim/flight/plan.h"
#include "sim/loop.h"
#include "sim/preflight/placed.h"

namespace dodgesim {

namespace {

// Multiples of it, modulo `throws`, meet every throw once, are spread evenly over them from the
// beginning, and meet every cell before any twice: it has no factor in common with their number.
std::int64_t stride_through(int throws) {
  auto stride = static_cast<std::int64_t>(throws / std::numbers::phi);
  while (std::gcd(stride, throws) != 1) ++stride;
  return stride;
}

// "throw 3 (throw.distance_m 9)".
std::string name_of(const ThrowCase& thrown) {
  const std::string number = "throw " + std::to_string(thrown.index), values = label(thrown);
  return values.empty() ? number : number + " (" + values + ")";
}

std::string place_of(const std::string& mistake, const Scenario& campaign) {
  std::string named = place_named_in(mistake, campaign);
  if (!named.empty()) return named;
  const std::string list = place_of_key("throws", campaign);
  return list.empty() ? place_of_key("throw", campaign) : list;
}

// The launches of one instant alone, up to their first tick: what was thrown before would hit a
// vehicle without a pilot, and end its flight.
FlightPlan launches_at(TimeUs launch_us, FlightPlan plan) {
  plan.pilot = kNoPilot;
  plan.end_us = launch_us + kTickUs;
  for (FlightPlan::Launch& launch : plan.launches) {
    if (launch.drawn.launch_us != launch_us) launch.drawn.launch_us = plan.end_us + kTickUs;
  }
  return plan;
}

// Adds up the simulated time of flights, and ends the one that makes it too long.
class Budget : public FlightObserver {
 public:
  struct Spent {};

  void on_tick(const World& world) override {
    fastest_turn_radps_ = std::max(fastest_turn_radps_, world.snapshot().vehicle.w_W.norm());
    flown_us_ += kTickUs;
    if (flown_s() > kMostTriedS) throw Spent();
  }
  double flown_s() const { return seconds(flown_us_); }
  // The vehicle's, since the last call.
  double take_fastest_turn_radps() { return std::exchange(fastest_turn_radps_, 0); }

 private:
  TimeUs flown_us_ = 0;
  double fastest_turn_radps_ = 0;
};

// Every launch after the ones before it, in whose way their objects may still be. Ends at a hit.
FlightPlan all_launches_until(TimeUs last_us, FlightPlan plan) {
  plan.pilot = kNoPilot;
  plan.end_us = last_us + kTickUs;
  return plan;
}

// Faster than a vehicle that hovers with the noisiest of IMUs turns.
constexpr double kRestlessRadps = 2;

// A sentence if the vehicle had trouble to hover, up to its flight's end at a launch, or is empty.
std::string trouble_before_launch(const ThrowCase& thrown, const FlightRecord& record,
                                  double fastest_turn_radps) {
  if (record.verdict.crashed) {
    return formatted("In %s the vehicle crashes by itself, at %g s, before it is thrown at.",
                     name_of(thrown).c_str(), seconds(record.last.t_us));
  }
  if (thrown.scenario.mission.type != "hover" || fastest_turn_radps < kRestlessRadps) return {};
  return formatted(
      "In %s the vehicle, which is to hover, turns by up to %.3g rad/s before it is thrown at.",
      name_of(thrown).c_str(), fastest_turn_radps);
}

// Solves the throw and launches its objects, some of which may start inside something: flights up
// to each arrival and each launch. Returns what trouble the vehicle has before a launch.
std::string try_throw(const ThrowCase& thrown, Budget& budget) {
  const FlightPlan plan = plan_throw(thrown.scenario, thrown.stream, &budget);
  std::set<TimeUs> launches_us;
  for (const FlightPlan::Launch& launch : plan.launches) {
    launches_us.insert(launch.drawn.launch_us);
  }
  std::string trouble;
  for (const TimeUs launch_us : launches_us) {
    budget.take_fastest_turn_radps();
    const FlightRecord record = fly(thrown.scenario, launches_at(launch_us, plan), &budget);
    const double fastest_turn_radps = budget.take_fastest_turn_radps();
    if (trouble.empty()) trouble = trouble_before_launch(thrown, record, fastest_turn_radps);
    if (record.verdict.crashed) return trouble;
  }
  if (launches_us.size() < 2) return trouble;
  fly(thrown.scenario, all_launches_until(*launches_us.rbegin(), plan), &budget);
  return trouble;
}

}  // namespace

TriedThrows try_throws(const Scenario& campaign) {
  TriedThrows tried;
  if (!campaign.anyone_throws()) return tried;
  const int throws = throw_count(campaign);
  const std::int64_t stride = stride_through(throws);
  std::string mistake;  // of the first throw that is impossible
  int impossible = 0;
  Budget budget;
  for (; tried.solved < throws && budget.flown_s() < kMostSolvedS; ++tried.solved) {
    const ThrowCase thrown = case_of(campaign, static_cast<int>(tried.solved * stride % throws));
    try {
      const std::string trouble = try_throw(thrown, budget);
      if (tried.trouble.empty()) tried.trouble = trouble;
    } catch (const Budget::Spent&) {
      break;
    } catch (const std::runtime_error& error) {
      if (++impossible > 1) continue;
      mistake =
          placed("In " + name_of(thrown) + ": " + error.what(), place_of(error.what(), campaign));
    }
  }
  if (impossible == 0) return tried;
  if (tried.solved > 1) {
    mistake +=
        formatted(" Of %d throws that were tried %d cannot be flown.", tried.solved, impossible);
  }
  throw ScenarioError(mistake);
}

}  // namespace dodgesim

#include "sim/preflight/try_throws.h"

#include <algorithm>
#include <cstdint>
#include <stdexcept>
#include <string>

#include "sim/base/error.h"
#include "sim/config/expand.h"
#include "sim/loop.h"
#include "sim/preflight/placed.h"

namespace dodgesim {

namespace {

// "throw 3 (throw.distance_m 9)".
std::string name_of(const ThrowCase& thrown) {
  std::vector<AxisValue> values = thrown.cell_values;
  values.insert(values.end(), thrown.sweep_values.begin(), thrown.sweep_values.end());
  const std::string number = "throw " + std::to_string(thrown.index);
  return values.empty() ? number : number + " (" + label(values) + ")";
}

}  // namespace

int try_throws(const Scenario& campaign) {
  if (!campaign.anyone_throws()) return 0;
  const int throws = throw_count(campaign);
  const int tried = std::min(throws, kMostTriedThrows);
  for (int i = 0; i < tried; ++i) {
    const ThrowCase thrown = case_of(campaign, static_cast<int>(std::int64_t{i} * throws / tried));
    try {
      plan_throw(thrown.scenario, thrown.stream);
    } catch (const std::runtime_error& error) {
      throw ScenarioError(placed("In " + name_of(thrown) + ": " + error.what(), campaign));
    }
  }
  return tried;
}

}  // namespace dodgesim

// From a scenario with grid, repeats and sweep to its throws.
//
// Throws are numbered t = sweep value * (cells * repeats) + i with i = repeat * cells + cell. All
// random numbers of a throw are named by i alone: every sweep value meets the same throws with the
// same noise, so that two of them can be compared throw by throw; and more repeats only add throws.
#pragma once

#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "sim/config/axis_value.h"
#include "sim/config/reader.h"
#include "sim/config/scenario.h"

namespace dodgesim {

// One throw of a campaign.
struct ThrowCase {
  Scenario scenario;  // with the values of its cell and sweep; grid and sweep are empty
  int index = 0;      // t
  int stream = 0;     // i: the number that names its random numbers
  int cell = 0;
  int sweep = 0;  // number of the sweep value (of the combination, with several keys)
  std::vector<AxisValue> cell_values;   // of the keys of the grid, in its order
  std::vector<AxisValue> sweep_values;  // of those of the sweep
};

int cell_count(const Scenario& scenario);   // 1 without a grid
int sweep_count(const Scenario& scenario);  // 1 without a sweep
int throw_count(const Scenario& scenario);

// Throw t of a scenario as load_scenario() has checked it. With a sweep t < throw_count(), without
// one any t >= 0: the draws of more repeats. Throws std::out_of_range.
ThrowCase case_of(const Scenario& scenario, int t);

// A key of the grid or the sweep that takes several values and is one of `groups` or below one of
// them, such as "dodger"; null if there is none.
const VariedKey* find_varied(const Scenario& scenario, const std::vector<std::string>& groups);

// "delays.compute_us 3500, pilot oracle"; empty without values.
std::string label(const std::vector<AxisValue>& values);
std::string label(const ThrowCase& thrown);  // of its cell and sweep

// With the values of each cell and each value of the sweep, once.
void for_each_combination(const Scenario& scenario,
                          const std::function<void(const Scenario&)>& visit);

// Whether one of the pilots is plugin.
bool flies_plugin(const Scenario& scenario);

// "pilot falanga2020", or "pilots none, oracle" of a sweep over them.
std::string pilots_of(const Scenario& scenario);

// The scenario with some keys set to other values, as if they stood in its file; what is wrong with
// them is added to the problems of `context`. A preset among the values takes the place of all keys
// that belong to it; check_presets.h refuses a scenario that gives some of them.
using Assignments = std::vector<std::pair<std::string, const YamlNode*>>;
Scenario with_values(Scenario scenario, const Assignments& values, ReadContext& context);

// Those of a cell and of a value of the sweep, by their numbers. The scenario must outlive them.
Assignments values_of(const Scenario& scenario, int cell, int sweep);
std::vector<AxisValue> as_text(const Assignments& values);

}  // namespace dodgesim

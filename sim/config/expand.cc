#include "sim/config/expand.h"

#include <algorithm>
#include <stdexcept>

#include "sim/base/contains.h"
#include "sim/base/joined.h"
#include "sim/config/layers.h"

namespace dodgesim {

namespace {

int combinations(const VariedKeys& axes) {
  int count = 1;
  for (const VariedKey& axis : axes) count *= static_cast<int>(axis.values.size());
  return count;
}

// The values of combination number `index` of the axes.
Assignments combination(const VariedKeys& axes, int index) {
  Assignments values(axes.size());
  for (std::size_t k = axes.size(); k-- > 0;) {
    const auto count = static_cast<int>(axes[k].values.size());
    values[k] = {axes[k].key, &axes[k].values[static_cast<std::size_t>(index % count)]};
    index /= count;
  }
  return values;
}

}  // namespace

std::vector<AxisValue> as_text(const Assignments& values) {
  std::vector<AxisValue> texts;
  for (const auto& [key, value] : values) texts.push_back({key, to_text(*value)});
  return texts;
}

int cell_count(const Scenario& scenario) { return combinations(scenario.grid); }

int sweep_count(const Scenario& scenario) { return combinations(scenario.sweep); }

int throw_count(const Scenario& scenario) {
  return cell_count(scenario) * scenario.repeats * sweep_count(scenario);
}

Assignments values_of(const Scenario& scenario, int cell, int sweep) {
  Assignments values = combination(scenario.grid, cell);
  const Assignments sweep_values = combination(scenario.sweep, sweep);
  values.insert(values.end(), sweep_values.begin(), sweep_values.end());
  return values;
}

Scenario with_values(Scenario scenario, const Assignments& values, ReadContext& context) {
  YamlNode patch;
  patch.kind = YamlNode::Kind::kMap;
  for (const auto& [key, value] : values) set_value(patch, key, *value);
  const auto read = [&context](const YamlNode& map, const std::string& path, auto& part) {
    Reader reader(map, path, context);
    part.visit(reader);
    reader.finish();
  };
  if (!scenario.throws.empty()) {
    const std::optional<YamlNode> of_each = patch.take("throw");
    for (ThrowSpec& spec : scenario.throws) {
      if (of_each) read(*of_each, "throw", spec);
    }
  }
  read(patch, "", scenario);
  return scenario;
}

ThrowCase case_of(const Scenario& scenario, int t) {
  const int cells = cell_count(scenario);
  const int throws_of_a_value = cells * scenario.repeats;
  ThrowCase result;
  result.index = t;
  result.sweep = scenario.sweep.empty() ? 0 : t / throws_of_a_value;
  result.stream = t - result.sweep * throws_of_a_value;
  result.cell = result.stream % cells;
  if (t < 0 || result.sweep >= sweep_count(scenario)) {
    throw std::out_of_range("The scenario has no throw " + std::to_string(t) + ".");
  }
  result.cell_values = as_text(combination(scenario.grid, result.cell));
  result.sweep_values = as_text(combination(scenario.sweep, result.sweep));
  ReadContext context(scenario.name);
  result.scenario = with_values(scenario, values_of(scenario, result.cell, result.sweep), context);
  context.problems.raise_if_any();
  result.scenario.grid.clear();
  result.scenario.sweep.clear();
  return result;
}

const VariedKey* find_varied(const Scenario& scenario, const std::vector<std::string>& groups) {
  const auto matters = [&](const VariedKey& axis) {
    return axis.values.size() > 1 && std::ranges::any_of(groups, [&](const std::string& group) {
             return axis.key == group || axis.key.starts_with(group + ".");
           });
  };
  for (const VariedKeys* const axes : {&scenario.grid, &scenario.sweep}) {
    const auto found = std::ranges::find_if(*axes, matters);
    if (found != axes->end()) return &*found;
  }
  return nullptr;
}

std::string label(const std::vector<AxisValue>& values) {
  return joined(values, [](const AxisValue& value) { return value.key + " " + value.value; });
}

std::string label(const ThrowCase& thrown) {
  std::vector<AxisValue> values = thrown.cell_values;
  values.insert(values.end(), thrown.sweep_values.begin(), thrown.sweep_values.end());
  return label(values);
}

void for_each_combination(const Scenario& scenario,
                          const std::function<void(const Scenario&)>& visit) {
  const int cells = cell_count(scenario);
  for (int sweep = 0; sweep < sweep_count(scenario); ++sweep) {
    for (int cell = 0; cell < cells; ++cell) {
      visit(case_of(scenario, sweep * cells * scenario.repeats + cell).scenario);
    }
  }
}

bool flies_plugin(const Scenario& scenario) {
  for (const VariedKey& axis : scenario.sweep) {
    if (axis.key != "pilot") continue;
    return contains(axis.values, kPluginPilot, &YamlNode::text);
  }
  return scenario.pilot == kPluginPilot;
}

std::string pilots_of(const Scenario& scenario) {
  for (const VariedKey& axis : scenario.sweep) {
    if (axis.key != "pilot") continue;
    return "pilots " + joined(axis.values, &YamlNode::text);
  }
  return "pilot " + scenario.pilot;
}

}  // namespace dodgesim

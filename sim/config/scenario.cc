#include "sim/config/scenario.h"

#include <filesystem>
#include <iterator>

#include "sim/base/contains.h"
#include "sim/base/error.h"
#include "sim/config/check_presets.h"
#include "sim/config/check_scenario.h"
#include "sim/config/reader.h"
#include "sim/config/writer.h"

namespace dodgesim {

namespace {

// Several values are for single keys, and not for those that name the campaign or its throws.
bool may_vary(const ParameterDoc& doc) {
  constexpr const char* kSingle[] = {"extends", "name", "description", "seed",
                                     "repeats", "grid", "sweep",       "throws"};
  return !doc.is_group() && !contains(kSingle, doc.path);
}

// The list of grid and sweep that is longest; nullptr without any.
const VariedKey* longest_axis(const Scenario& scenario) {
  const VariedKey* longest = nullptr;
  for (const VariedKeys* const axes : {&scenario.grid, &scenario.sweep}) {
    for (const VariedKey& axis : *axes) {
      if (longest == nullptr || axis.values.size() > longest->values.size()) longest = &axis;
    }
  }
  return longest;
}

// A campaign keeps its scenario with every value spelled out, and must be able to read it again.
void check_resolved(const Scenario& scenario, ReadContext& context) {
  Problems resolved("");
  try {
    parse_yaml(to_yaml(scenario), resolved);
    resolved.raise_if_any();
  } catch (const ScenarioError&) {
    // Its lines are not the user's. It is too long, mostly for one list.
    const VariedKey* const longest = longest_axis(scenario);
    context.problems.fail(
        longest == nullptr ? Position{} : longest->at,
        resolved.all().back().sentence + " That is so with every value spelled out.");
  }
}

Scenario read(const std::string& text, const std::string& file, const std::string& models_dir,
              const std::vector<Setting>& settings) {
  ReadContext context(file);
  context.models_dir = models_dir;
  for (const ParameterDoc& doc : scenario_docs()) {
    context.all_keys.push_back(doc.path);
    if (may_vary(doc)) context.variable_keys.push_back(doc.path);
  }
  const YamlNode root = scenario_tree(text, file, settings, context.problems);
  Scenario scenario;
  scenario.models_dir = models_dir;
  Reader reader(root, "", context);
  scenario.visit(reader);
  reader.finish();
  if (!settings.empty()) {
    Problems known(file);
    const YamlNode alone = scenario_tree(text, file, {}, known);
    check_set_presets(alone, root, context);
  }
  context.problems.raise_if_any();
  if (scenario.name.empty()) scenario.name = std::filesystem::path(file).stem().string();
  check_scenario(scenario, context);
  context.problems.raise_if_any();
  for (const auto& [key, at] : context.where) scenario.places[key] = context.problems.place(at);
  check_resolved(scenario, context);
  return scenario;
}

}  // namespace

Scenario parse_scenario(const std::string& text, const std::string& file,
                        const std::string& models_dir, const std::vector<Setting>& settings) {
  return read(text, file, models_dir, settings);
}

Scenario load_scenario(const std::string& path, const std::string& models_dir,
                       const std::vector<Setting>& settings) {
  return read(read_scenario_text(path), path, models_dir, settings);
}

std::string to_yaml(const Scenario& scenario) {
  Scenario copy = scenario;  // visit() is not const because the reader shares it
  Writer writer;
  copy.visit(writer);
  return writer.yaml();
}

std::vector<ParameterDoc> scenario_docs() {
  Scenario defaults;
  Documenter documenter;
  defaults.visit(documenter);
  return documenter.take();
}

}  // namespace dodgesim

#include "sim/config/scenario.h"

#include <algorithm>
#include <filesystem>
#include <iterator>

#include "sim/config/check_scenario.h"
#include "sim/config/reader.h"
#include "sim/config/writer.h"

namespace dodgesim {

namespace {

// Neither what names the campaign or its throws can have several values, nor what is no value.
bool may_vary(const ParameterDoc& doc) {
  constexpr const char* kSingle[] = {"extends", "name", "description", "seed",
                                     "repeats", "grid", "sweep",       "throws"};
  return !doc.is_group() &&
         std::find(std::begin(kSingle), std::end(kSingle), doc.path) == std::end(kSingle);
}

// A key whose value decides on the defaults of a group of keys.
struct Preset {
  const char *key, *group;
};
constexpr Preset kPresets[] = {{"pilot", "dodger"}, {"sensors.events.preset", "sensors.events"}};

// Of a dotted key; empty if it is not there.
std::string text_at(const YamlNode& root, const std::string& key) {
  const YamlNode* node = &root;
  for (std::size_t begin = 0; begin <= key.size();) {
    const std::size_t end = std::min(key.find('.', begin), key.size());
    const std::string part = key.substr(begin, end - begin);
    const auto named = [&part](const YamlNode::Key& k) { return k.name == part; };
    const auto found = std::find_if(node->keys.begin(), node->keys.end(), named);
    if (found == node->keys.end()) return "";
    node = &node->items[static_cast<std::size_t>(found - node->keys.begin())];
    begin = end + 1;
  }
  return node->text;
}

// Where a file gives all keys of the group, as a resolved scenario does, another preset on the
// command line would be one by its name only.
void check_preset(const Preset& preset, const YamlNode& file, const YamlNode& root,
                  ReadContext& context) {
  const std::string before = text_at(file, preset.key), now = text_at(root, preset.key);
  if (before.empty() || now == before) return;
  const std::string group = preset.group;
  if (group == "dodger" && dodger_preset(now) == dodger_preset(before)) return;
  for (const std::string& key : context.all_keys) {
    const bool of_group = key.starts_with(group + ".") && key != preset.key;
    if (of_group && !context.where.contains(key)) return;
  }
  const auto place = context.where.find(now.empty() ? group : std::string(preset.key));
  const std::string change =
      now.empty() ? " is left out instead of " : " is " + now + " instead of ";
  context.problems.add(place == context.where.end() ? Position{} : place->second,
                       std::string(preset.key) + change + before +
                           " by its name only: the file sets all keys of " + group +
                           " itself. Put --set " + group + "=~ in front to take them away.");
}

// A campaign keeps its scenario with every value spelled out, and must be able to read it again.
void check_resolved(const Scenario& scenario, const std::string& file) {
  Problems problems(file + ", with every value spelled out");
  parse_yaml(to_yaml(scenario), problems);
  problems.raise_if_any();
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
    for (const Preset& preset : kPresets) check_preset(preset, alone, root, context);
  }
  context.problems.raise_if_any();
  if (scenario.name.empty()) scenario.name = std::filesystem::path(file).stem().string();
  check_scenario(scenario, context);
  context.problems.raise_if_any();
  for (const auto& [key, at] : context.where) scenario.places[key] = context.problems.place(at);
  check_resolved(scenario, file);
  return scenario;
}

}  // namespace

Scenario parse_scenario(const std::string& text, const std::string& file,
                        const std::string& models_dir) {
  return read(text, file, models_dir, {});
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

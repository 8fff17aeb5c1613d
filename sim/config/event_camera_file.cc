#include "sim/config/event_camera_file.h"

#include <algorithm>
#include <filesystem>

#include "sim/base/contains.h"
#include "sim/base/error.h"
#include "sim/base/joined.h"
#include "sim/config/closest_name.h"
#include "sim/config/expand.h"
#include "sim/config/parameter_docs.h"
#include "sim/config/reader.h"
#include "sim/config/yaml_tree.h"

namespace dodgesim {

namespace {

// Visitor that finds out which presets there are.
struct PresetNames {
  std::vector<std::string> names;

  void operator()(std::string_view key, const std::string&,
                  std::initializer_list<const char*> allowed, const char*) {
    if (key == "preset") names.assign(allowed.begin(), allowed.end());
  }
  template <class... Rest>
  void operator()(const char*, const Rest&...) {}
};

std::vector<std::string> preset_names() {
  PresetNames visitor;
  EventCameraSpec().visit(visitor);
  return visitor.names;
}

// Whether a key of a scenario stands at the root: none of a camera is called so.
bool is_scenario(const YamlNode& root) {
  const std::vector<ParameterDoc> docs = scenario_docs();
  return std::ranges::any_of(root.keys, [&](const YamlNode::Key& key) {
    return key.name == "extends" || contains(docs, key.name, &ParameterDoc::path);
  });
}

// `group`: of the keys that must not vary.
SensorsSpec sensors_of_scenario(const std::string& path, const char* group) {
  const Scenario scenario = load_scenario(path, "");
  if (const VariedKey* const varied = find_varied(scenario, {group})) {
    throw ScenarioError(path + " varies " + varied->key +
                        ": write a file with one event camera only.");
  }
  return case_of(scenario, 0).scenario.sensors;
}

SensorsSpec with_events(const EventCameraSpec& events) {
  SensorsSpec sensors;
  sensors.events = events;
  return sensors;
}

SensorsSpec load(const std::string& path, const char* group) {
  ReadContext context(path);
  EventCameraSpec spec;
  Documenter documenter;
  spec.visit(documenter);
  for (const ParameterDoc& doc : documenter.take()) context.all_keys.push_back(doc.path);
  const YamlNode root = parse_yaml(read_scenario_text(path), context.problems);
  if (is_scenario(root)) return sensors_of_scenario(path, group);
  Reader reader(root, "", context);
  spec.visit(reader);
  reader.finish();
  context.problems.raise_if_any();
  return with_events(spec);
}

SensorsSpec sensors_by_name(const std::string& name_or_file, const char* group) {
  const std::string end = std::filesystem::path(name_or_file).extension().string();
  if (end == ".yaml" || end == ".yml") return load(name_or_file, group);
  const std::vector<std::string> names = preset_names();
  if (contains(names, name_or_file)) {
    return with_events(event_camera_preset(name_or_file));
  }
  throw ScenarioError("There is no event camera \"" + name_or_file + "\"; known are " +
                      joined(names) + ", and files that end in .yaml" +
                      did_you_mean(closest_name(name_or_file, names)));
}

}  // namespace

EventCameraSpec named_event_camera(const std::string& name_or_file) {
  return sensors_by_name(name_or_file, "sensors.events").events;
}

SensorsSpec named_sensors(const std::string& name_or_file) {
  return sensors_by_name(name_or_file, "sensors");
}

}  // namespace dodgesim

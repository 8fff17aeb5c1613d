#include "sim/config/event_camera_file.h"

#include <algorithm>
#include <filesystem>

#include "sim/base/error.h"
#include "sim/config/closest_name.h"
#include "sim/config/parameter_docs.h"
#include "sim/config/reader.h"
#include "sim/config/yaml_tree.h"

namespace dodgesim {

namespace {

EventCameraSpec preset(const std::string& name) {
  return name == "ideal" ? ideal_event_camera() : EventCameraSpec{};
}

EventCameraSpec load(const std::string& path) {
  ReadContext context(path);
  EventCameraSpec spec;
  Documenter documenter;
  spec.visit(documenter);
  for (const ParameterDoc& doc : documenter.take()) context.all_keys.push_back(doc.path);
  const YamlNode root = parse_yaml(read_scenario_text(path), context.problems);
  Reader reader(root, "", context);
  spec.visit(reader);
  reader.finish();
  context.problems.raise_if_any();
  return spec;
}

}  // namespace

const std::vector<std::string>& event_camera_presets() {
  static const std::vector<std::string> names = {"ideal", "sees1"};
  return names;
}

EventCameraSpec named_event_camera(const std::string& name_or_file) {
  const std::string end = std::filesystem::path(name_or_file).extension().string();
  if (end == ".yaml" || end == ".yml") return load(name_or_file);
  const std::vector<std::string>& names = event_camera_presets();
  if (std::find(names.begin(), names.end(), name_or_file) != names.end()) {
    return preset(name_or_file);
  }
  std::string known;
  for (const std::string& name : names) known += name + ", ";
  const std::string near = closest_name(name_or_file, names);
  throw ScenarioError("There is no event camera \"" + name_or_file + "\"; known are " + known +
                      "and files that end in .yaml" +
                      (near.empty() ? "." : "; did you mean " + near + "?"));
}

}  // namespace dodgesim

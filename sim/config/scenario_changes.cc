#include "sim/config/scenario_changes.h"

#include <map>

#include "sim/config/yaml_tree.h"

namespace dodgesim {

namespace {

// Values by their dotted key.
using Values = std::map<std::string, std::string>;

void collect(const YamlNode& node, const std::string& path, Values& values) {
  if (node.kind != YamlNode::Kind::kMap) {
    values[path] = to_text(node);
    return;
  }
  for (std::size_t i = 0; i < node.items.size(); ++i) {
    const std::string& key = node.keys[i].name;
    collect(node.items[i], path.empty() ? key : path + "." + key, values);
  }
}

Values values_of(const std::string& yaml) {
  Problems problems("scenario.resolved.yaml");
  Values values;
  collect(parse_yaml(yaml, problems), "", values);
  problems.raise_if_any();
  values.erase("name");
  values.erase("description");
  return values;
}

}  // namespace

std::vector<ScenarioChange> scenario_changes(const std::string& before, const std::string& after) {
  const std::string unset = "unset";
  const Values was = values_of(before);
  const Values is = values_of(after);
  std::vector<ScenarioChange> changes;
  for (const auto& [key, value] : was) {
    const auto now = is.find(key);
    if (now == is.end() || now->second != value) {
      changes.push_back({key, value, now == is.end() ? unset : now->second});
    }
  }
  for (const auto& [key, value] : is) {
    if (was.count(key) == 0) changes.push_back({key, unset, value});
  }
  return changes;
}

std::string scenario_difference(const std::string& of, const std::string& from) {
  const auto changes = scenario_changes(of, from);
  if (changes.empty()) return "only its name or description differs";
  const ScenarioChange& first = changes.front();
  const std::size_t more = changes.size() - 1;
  std::string text = first.key + " is " + first.before + ", not " + first.after;
  if (more > 0) text += ", and " + std::to_string(more) + " more key";
  if (more == 1) text += " differs";
  if (more > 1) text += "s differ";
  return text;
}

}  // namespace dodgesim

#include "sim/gate/scenario_changes.h"

#include <map>

#include "sim/config/yaml_tree.h"

namespace dodgesim {

namespace {

// Values by their dotted key.
using Values = std::map<std::string, std::string>;

std::string text_of(const YamlNode& node) {
  std::string text = node.tag.empty() ? "" : node.tag + " ";
  if (node.kind == YamlNode::Kind::kScalar) return text + node.text;
  text += "[";
  for (std::size_t i = 0; i < node.items.size(); ++i) {
    text += (i == 0 ? "" : ", ") + text_of(node.items[i]);
  }
  return text + "]";
}

void collect(const YamlNode& node, const std::string& path, Values& values) {
  if (node.kind != YamlNode::Kind::kMap) {
    values[path] = text_of(node);
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

std::vector<std::string> scenario_changes(const std::string& before, const std::string& after) {
  const Values was = values_of(before);
  const Values is = values_of(after);
  std::vector<std::string> changes;
  for (const auto& [key, value] : was) {
    const auto now = is.find(key);
    if (now == is.end()) {
      changes.push_back(key + " was " + value + ", is not there");
    } else if (now->second != value) {
      changes.push_back(key + " was " + value + ", is " + now->second);
    }
  }
  for (const auto& [key, value] : is) {
    if (was.count(key) == 0) changes.push_back(key + " was not there, is " + value);
  }
  return changes;
}

}  // namespace dodgesim

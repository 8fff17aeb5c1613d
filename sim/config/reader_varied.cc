// Reader: the keys of grid and sweep.
#include <algorithm>
#include <optional>

#include "sim/base/contains.h"
#include "sim/base/numbers.h"
#include "sim/config/closest_name.h"
#include "sim/config/reader.h"

namespace dodgesim {

namespace {

// A word alone is rather meant as one of throw's.
std::string closest_varied(const std::string& word, const std::vector<std::string>& keys) {
  std::vector<std::string> of_throw;
  for (const std::string& key : keys) {
    if (key.starts_with("throw.")) of_throw.push_back(key);
  }
  const std::string near = closest_key(word, of_throw);
  return near.empty() ? closest_key(word, keys) : near;
}

// 0.20 is 0.2, alone or within a value.
bool same_value(const YamlNode& a, const YamlNode& b) {
  if (a.kind != b.kind || a.tag != b.tag || a.items.size() != b.items.size()) return false;
  if (a.kind == YamlNode::Kind::kScalar) {
    if (a.quoted || b.quoted) return a.quoted == b.quoted && a.text == b.text;
    const std::optional<double> number = as_number(a.text);
    return number ? as_number(b.text) == number : a.text == b.text;
  }
  return std::ranges::equal(a.keys, b.keys, {}, &YamlNode::Key::name, &YamlNode::Key::name) &&
         std::ranges::equal(a.items, b.items, same_value);
}

}  // namespace

bool Reader::read_varied(const YamlNode& node, const YamlNode::Key& key, const VariedKeys& before,
                         VariedKey& axis) {
  const std::vector<std::string>& keys = context_.variable_keys;
  axis.at = key.at;
  for (const std::string& path : {key.name, "throw." + key.name}) {
    if (contains(keys, path)) axis.key = path;
  }
  const std::string name = full(key.name);
  const auto refuse_key = [&](const std::string& sentence) {
    context_.problems.add(key.at, sentence);
    return false;
  };
  if (axis.key.empty()) {
    return refuse_key(name + " is not a key that can take several values" +
                      did_you_mean(closest_varied(key.name, keys)));
  }
  for (const VariedKey& other : before) {
    if (other.key == axis.key) {
      return refuse_key(name + " is given twice; it is already in " +
                        context_.problems.place(other.at) + ".");
    }
  }
  if (node.taken_away) return false;
  if (node.kind != YamlNode::Kind::kSequence || !node.tag.empty() || node.items.empty()) {
    return refuse(node, name, "must be a list of values, such as [0.1, 0.2]");
  }
  for (const YamlNode& item : node.items) {
    const auto same = [&item](const YamlNode& other) { return same_value(item, other); };
    if (std::ranges::any_of(axis.values, same)) {
      return refuse(item, name + "[" + std::to_string(axis.values.size()) + "]",
                    "this value is in the list already");
    }
    axis.values.push_back(item);
  }
  return true;
}

void Reader::varied(const char* key, VariedKeys& list, const char*) {
  const YamlNode* map = take_map(key);
  if (map == nullptr) return;
  Reader inside(*map, full(key), context_);
  for (std::size_t i = 0; i < map->keys.size(); ++i) {
    VariedKey varied;
    if (inside.read_varied(map->items[i], map->keys[i], list, varied)) list.push_back(varied);
  }
}

}  // namespace dodgesim

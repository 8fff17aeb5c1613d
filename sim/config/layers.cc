#include "sim/config/layers.h"

#include <algorithm>
#include <string_view>
#include <utility>

namespace dodgesim {

namespace {

bool is_plain_map(const YamlNode& node) {
  return node.kind == YamlNode::Kind::kMap && node.tag.empty();
}

std::vector<std::string> parts_of(const std::string& key) {
  std::vector<std::string> parts;
  std::size_t begin = 0;
  for (std::size_t dot = 0; (dot = key.find('.', begin)) != std::string::npos; begin = dot + 1) {
    if (parts.size() == 1 && (parts[0] == "grid" || parts[0] == "sweep")) break;
    parts.push_back(key.substr(begin, dot - begin));
  }
  parts.push_back(key.substr(begin));
  return parts;
}

// Where a map has a key; its size without it. Keys of grid and sweep have two names, with and
// without "throw.".
std::size_t find(const std::string& name, const YamlNode& map, bool two_names) {
  const auto at = [&map](const std::string& wanted) {
    return static_cast<std::size_t>(std::ranges::find(map.keys, wanted, &YamlNode::Key::name) -
                                    map.keys.begin());
  };
  const std::size_t own = at(name);
  if (own < map.keys.size() || !two_names) return own;
  constexpr std::string_view kThrow = "throw.";
  return at(name.starts_with(kThrow) ? name.substr(kThrow.size()) : kThrow.data() + name);
}

void lay_over(YamlNode& base, const YamlNode& over, bool two_names) {
  for (std::size_t i = 0; i < over.keys.size(); ++i) {
    const std::string& name = over.keys[i].name;
    std::size_t k = find(name, base, two_names);
    // Both names in one map are a mistake, which the reader finds.
    if (k < base.keys.size() && base.keys[k].name != name &&
        find(base.keys[k].name, over, false) < over.keys.size()) {
      k = base.keys.size();
    }
    if (k == base.keys.size()) {
      base.keys.push_back(over.keys[i]);
      base.items.push_back(over.items[i]);
    } else if (is_plain_map(base.items[k]) && is_plain_map(over.items[i])) {
      lay_over(base.items[k], over.items[i], name == "grid" || name == "sweep");
    } else if (over.items[i].taken_away) {
      base.erase(k);
    } else {
      base.keys[k] = over.keys[i];
      base.items[k] = over.items[i];
    }
  }
}

}  // namespace

void lay_over(YamlNode& base, const YamlNode& over) { lay_over(base, over, false); }

void set_value(YamlNode& root, const std::string& key, const YamlNode& value) {
  const std::vector<std::string> parts = parts_of(key);
  YamlNode tree = value;
  for (auto part = parts.rbegin(); part != parts.rend(); ++part) {
    YamlNode map;
    map.kind = YamlNode::Kind::kMap;
    map.at = value.at;
    map.keys = {{*part, value.at}};
    map.items = {std::move(tree)};
    tree = std::move(map);
  }
  lay_over(root, tree);
}

}  // namespace dodgesim

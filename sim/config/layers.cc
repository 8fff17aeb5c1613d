#include "sim/config/layers.h"

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

}  // namespace

void lay_over(YamlNode& base, const YamlNode& over) {
  for (std::size_t i = 0; i < over.keys.size(); ++i) {
    std::size_t k = 0;
    while (k < base.keys.size() && base.keys[k].name != over.keys[i].name) ++k;
    if (k == base.keys.size()) {
      base.keys.push_back(over.keys[i]);
      base.items.push_back(over.items[i]);
    } else if (is_plain_map(base.items[k]) && is_plain_map(over.items[i])) {
      lay_over(base.items[k], over.items[i]);
    } else if (over.items[i].taken_away) {
      base.erase(k);
    } else {
      base.keys[k] = over.keys[i];
      base.items[k] = over.items[i];
    }
  }
}

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

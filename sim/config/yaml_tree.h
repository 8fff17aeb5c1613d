// A YAML file as a plain tree with positions. Built from yaml-cpp's parser events, not from its
// nodes, because those hide what a strict reader must see: duplicate keys (the first wins), merge
// keys (ignored), aliases (shared nodes that an alias bomb multiplies), several documents
// (dropped).
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "sim/config/problems.h"

namespace dodgesim {

struct YamlNode {
  enum class Kind { kNull, kScalar, kSequence, kMap };
  struct Key {
    std::string name;
    Position at;
  };

  Kind kind = Kind::kNull;
  Position at;
  std::string tag;              // "!uniform"; empty when the file gives none
  std::string text;             // of a scalar
  bool quoted = false;          // a scalar in quotes is text, whatever it looks like
  bool alias = false;           // stands for an alias, which is a problem already
  bool taken_away = false;      // null, and ~ or null is written there: its key is to be none
  std::vector<YamlNode> items;  // of a sequence or map
  std::vector<Key> keys;        // of a map: keys[i] names items[i]

  // The value of a key; null if there is none, or this is no map.
  const YamlNode* find(std::string_view key) const;
  // Removes a key with its value.
  void erase(std::size_t i);
  std::optional<YamlNode> take(std::string_view key);
};

inline constexpr std::size_t kMostValues = 5000;  // of a scenario

// Parses one document whose root is a map; its positions have the given source. Duplicate keys,
// anchors, aliases and merge keys are added to `problems`; what cannot be parsed at all (not UTF-8,
// syntax, empty, several documents, too deep, too large) throws ScenarioError at once. Time and
// memory are bounded by limits on size and depth.
YamlNode parse_yaml(std::string_view text, Problems& problems, int source = 0,
                    std::size_t most_values = kMostValues);

// The same for a value of any kind, such as the `[1, 2]` of a command line. The positions name the
// source only.
YamlNode parse_yaml_value(std::string_view text, Problems& problems, int source);

// The node on one line, as parse_yaml_value() reads it: `!uniform [0.1, 0.3]`.
std::string to_text(const YamlNode& node);

// Whole contents of a file of bounded size. Throws ScenarioError when there is no such file or it
// is a directory or too large, and IoError when reading fails.
std::string read_scenario_text(const std::string& path);

}  // namespace dodgesim

// Reads a YAML map into a struct with visit(), strictly: unknown keys, wrong types and values out
// of range are problems with file, line, column and key. A visitor of the one list of parameters,
// as writer.h and parameter_docs.h are.
#pragma once

#include <Eigen/Dense>
#include <algorithm>
#include <initializer_list>
#include <map>
#include <optional>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "sim/config/distribution.h"
#include "sim/config/varied_key.h"
#include "sim/config/yaml_tree.h"

namespace dodgesim {

// Shared by the readers of all nested structs of one file.
struct ReadContext {
  explicit ReadContext(std::string file) : problems(std::move(file)) {}

  Problems problems;
  std::map<std::string, Position> where;   // of the value of every key given, by its dotted path
  std::vector<std::string> all_keys;       // dotted paths of all keys there are, for suggestions
  std::vector<std::string> variable_keys;  // of those that grid and sweep may have
  std::string models_dir;                  // when set, named models must exist below it

  // Of a key's value; of none where the key is not given.
  Position position_of(const std::string& key) const {
    const auto found = where.find(key);
    return found == where.end() ? Position{} : found->second;
  }
  void add_problem(const std::string& key, const std::string& sentence) {
    problems.add(position_of(key), sentence);
  }
};

class Reader {
 public:
  // `map` must outlive the reader. `path` is the dotted path of the map, empty at the root.
  Reader(const YamlNode& map, std::string path, ReadContext& context)
      : map_(map), path_(std::move(path)), context_(context) {}

  // Keys that were not asked for are problems. Call after visit().
  void finish();

  template <class Number>
  requires std::is_arithmetic_v<Number>
  void operator()(const char* key, Number& value, std::type_identity_t<Number> min,
                  std::type_identity_t<Number> max, const char*) {
    if (const YamlNode* node = take(key)) read_number(*node, full(key), value, min, max);
  }
  void operator()(const char* key, bool& value, const char*);
  void operator()(const char* key, std::string& value, std::initializer_list<const char*> allowed,
                  const char*);
  void operator()(const char* key, Eigen::Vector3d& value, double min, double max, const char*);
  void operator()(const char* key, std::optional<Eigen::Vector3d>& value, double min, double max,
                  const char*);

  // Lists of up to kMostPoints.
  void operator()(const char* key, std::vector<Eigen::Vector3d>& value, double min, double max,
                  const char*);
  void operator()(const char* key, std::vector<double>& value, double min, double max, const char*);

  // A number or a distribution whose whole support lies in [min, max].
  void operator()(const char* key, Distribution& value, double min, double max, const char*);
  // One such, or a list of value.count of them.
  void operator()(const char* key, Components& value, double min, double max, const char*);

  // Free text for people.
  void text(const char* key, std::string& value, const char*);
  // The name of the model file models/<folder>/<name>.xml; several: !choice [a, b].
  void model(const char* key, std::string& value, const char* folder, const char*);
  void model(const char* key, NameChoice& value, const char* folder, const char*);
  // Keys with a list of values each. A key of `throw` may stand without that word. Values are not
  // checked (see check_scenario.h).
  void varied(const char* key, VariedKeys& list, const char*);
  // The name of another file, which is read before (see scenario_tree.h).
  void file(const char* key, const char*) { known_.emplace_back(key); }

  template <class T>
  void operator()(const char* key, T& value, const char*) {
    if (const YamlNode* map = take_map(key)) read_nested(key, *map, value);
  }

  // A part that may be absent altogether.
  template <class T>
  void operator()(const char* key, std::optional<T>& value, const char*) {
    const YamlNode* map = take_map(key);
    if (map == nullptr) return;
    T read = value.value_or(T());
    read_nested(key, *map, read);
    if (value || !gives_nothing(*map)) value = std::move(read);
  }

  // A list of up to T::kMost.
  template <class T>
  void operator()(const char* key, std::vector<T>& values, const char*) {
    const YamlNode* list = take_list(key, "a list of maps", std::size_t{T::kMost});
    if (list == nullptr) return;
    values.clear();
    for (const YamlNode& item : list->items) {
      const std::string name = key + ("[" + std::to_string(values.size()) + "]");
      values.emplace_back();
      if (is_map(item, full(name))) read_nested(name, item, values.back());
    }
  }

 private:
  static constexpr std::size_t kMostPoints = 100;

  // Whether all that stands there are keys that settings take away: they make no map. One that
  // stands in a file, whose positions have lines, is there.
  static bool gives_nothing(const YamlNode& map) {
    const auto none = [](const YamlNode& item) { return item.taken_away && item.at.line == 0; };
    return !map.items.empty() && std::ranges::all_of(map.items, none);
  }

  template <class T>
  void read_nested(const std::string& key, const YamlNode& map, T& value) {
    Reader nested(map, full(key), context_);
    value.visit(nested);
    nested.finish();
  }

  std::string hint(const std::string& unknown_key, const YamlNode& value) const;
  std::string full(const std::string& key) const { return path_.empty() ? key : path_ + "." + key; }
  const YamlNode* take(const char* key);
  const YamlNode* take_map(const char* key);
  const YamlNode* take_list(const char* key, const char* wanted, std::size_t most);  // not empty
  bool is_map(const YamlNode& node, const std::string& name);
  void problem(const YamlNode& node, const std::string& name, const std::string& complaint);

  // The functions below return whether the value was read; if not, there is a problem.
  bool refuse(const YamlNode& node, const std::string& name, const std::string& complaint) {
    problem(node, name, complaint);
    return false;
  }
  template <class Number>
  bool read_number(const YamlNode& node, const std::string& name, Number& value, Number min,
                   Number max);
  bool read_distribution(const YamlNode& node, const std::string& name, Distribution& value,
                         double min, double max);
  bool read_uniform(const YamlNode& node, const std::string& name, Distribution& value, double min,
                    double max);
  bool read_normal(const YamlNode& node, const std::string& name, Distribution& value, double min,
                   double max);
  bool read_choice(const YamlNode& node, const std::string& name, Distribution& value, double min,
                   double max);
  bool read_numbers(const YamlNode& list, const std::string& name, std::vector<double>& values,
                    double min, double max);
  bool read_vector(const YamlNode& node, const std::string& name, Eigen::Vector3d& value,
                   double min, double max);
  bool read_model(const YamlNode& node, const std::string& name, const char* folder,
                  std::string& value);
  bool read_varied(const YamlNode& node, const YamlNode::Key& key, const VariedKeys& before,
                   VariedKey& axis);

  const YamlNode& map_;
  std::string path_;
  ReadContext& context_;
  std::vector<std::string> known_;
};

}  // namespace dodgesim

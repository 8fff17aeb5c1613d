// The documentation of every key of a scenario, from the same visit() that reads and writes it.
#pragma once

#include <Eigen/Dense>
#include <initializer_list>
#include <optional>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "sim/base/numbers.h"
#include "sim/config/distribution.h"
#include "sim/config/varied_key.h"

namespace dodgesim {

struct ParameterDoc {
  std::string path;          // "throw.size_m"
  std::string type;          // "number", "a, b or c", ...; empty for a group of keys
  std::string range;         // "0.01 to 1"; empty where there is none
  std::string default_text;  // as in YAML; empty where there is none
  std::string doc;           // one sentence
  bool is_group() const { return type.empty(); }
};

// Visitor that lists the parameters of a struct with visit(), whose values are the defaults.
class Documenter {
 public:
  std::vector<ParameterDoc> take() { return std::move(docs_); }

  template <class Number>
  requires std::is_arithmetic_v<Number>
  void operator()(const char* key, Number& value, std::type_identity_t<Number> min,
                  std::type_identity_t<Number> max, const char* doc) {
    const char* type = std::is_integral_v<Number> ? "whole number" : "number";
    add(key, type, range_text(min, max), to_text(value), doc);
  }
  void operator()(const char* key, bool& value, const char* doc);
  void operator()(const char* key, const std::string& value,
                  std::initializer_list<const char*> allowed, const char* doc);
  void operator()(const char* key, const Eigen::Vector3d& value, double min, double max,
                  const char* doc);
  void operator()(const char* key, const std::optional<Eigen::Vector3d>& value, double min,
                  double max, const char* doc);
  void operator()(const char* key, const std::vector<Eigen::Vector3d>& value, double min,
                  double max, const char* doc);
  void operator()(const char* key, const Distribution& value, double min, double max,
                  const char* doc);
  void operator()(const char* key, const Components& value, double min, double max,
                  const char* doc);
  void text(const char* key, const std::string& value, const char* doc);
  void model(const char* key, const std::string& value, const char* folder, const char* doc);
  void model(const char* key, const NameChoice& value, const char* folder, const char* doc);
  void varied(const char* key, const VariedKeys& axes, const char* doc);
  void file(const char* key, const char* doc);

  template <class T>
  void operator()(const char* key, T& value, const char* doc) {
    docs_.push_back({prefix_ + key, "", "", "", doc});
    const std::string outer = prefix_;
    prefix_ += std::string(key) + ".";
    value.visit(*this);
    prefix_ = outer;
  }

  // `doc` says which keys the maps have.
  template <class T>
  void operator()(const char* key, std::vector<T>&, const char* doc) {
    add(key, "list of maps", "", "", doc);
  }

  template <class T>
  void operator()(const char* key, std::optional<T>& value, const char* doc) {
    T present = value.value_or(T{});
    (*this)(key, present, doc);
  }

 private:
  template <class Number>
  static std::string range_text(Number min, Number max) {
    return to_text(min) + " to " + to_text(max);
  }

  void add(const char* key, const std::string& type, const std::string& range,
           const std::string& default_text, const char* doc);

  std::vector<ParameterDoc> docs_;
  std::string prefix_;
};

// One table for each group of keys, as GitHub Markdown.
std::string to_markdown(const std::vector<ParameterDoc>& docs);

// For a terminal: the key `key`, or the group of keys, or (empty) all keys. Accepts the last part
// of a path ("size_m"). Throws ScenarioError with a suggestion when there is no such key.
std::string explain(const std::vector<ParameterDoc>& docs, const std::string& key);

}  // namespace dodgesim

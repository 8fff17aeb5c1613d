// Writes a struct with visit() as YAML with every value spelled out: what Reader reads back equal,
// to the last bit of every number.
#pragma once

#include <Eigen/Dense>
#include <initializer_list>
#include <optional>
#include <string>
#include <type_traits>
#include <vector>

#include "sim/base/numbers.h"
#include "sim/config/distribution.h"
#include "sim/config/varied_key.h"

namespace dodgesim {

// Text as a YAML scalar in double quotes.
std::string in_quotes(const std::string& text);

// As they stand in YAML: "0.3", "!uniform [0.1, 0.3]", "[0.1, 0, !normal {...}]".
std::string to_yaml(const Distribution& distribution);
std::string to_yaml(const Components& components);
std::string to_yaml(const NameChoice& choice);
std::string to_yaml(const Eigen::Vector3d& vector);

// Values are taken by reference only so that no number converts to another type.
class Writer {
 public:
  const std::string& yaml() const { return yaml_; }

  template <class Number>
  requires std::is_arithmetic_v<Number>
  void operator()(const char* key, Number& value, std::type_identity_t<Number>,
                  std::type_identity_t<Number>, const char*) {
    line(key, to_text(value));
  }
  void operator()(const char* key, bool& value, const char*) {
    line(key, value ? "true" : "false");
  }
  void operator()(const char* key, const std::string& value, std::initializer_list<const char*>,
                  const char*) {
    line(key, value);
  }
  template <class T>
  requires requires(const T& value) { to_yaml(value); }
  void operator()(const char* key, const T& value, double, double, const char*) {
    line(key, to_yaml(value));
  }
  void operator()(const char* key, const std::optional<Eigen::Vector3d>& value, double, double,
                  const char*) {
    if (value) line(key, to_yaml(*value));
  }
  void operator()(const char* key, const std::vector<Eigen::Vector3d>& value, double, double,
                  const char*);
  void text(const char* key, const std::string& value, const char*) { line(key, in_quotes(value)); }
  void model(const char* key, const std::string& value, const char*, const char*) {
    line(key, to_yaml(NameChoice{{value}}));
  }
  void model(const char* key, const NameChoice& value, const char*, const char*) {
    line(key, to_yaml(value));
  }
  void varied(const char* key, const VariedKeys& axes, const char*);
  void file(const char*, const char*) {}  // its contents are written

  template <class T>
  void operator()(const char* key, T& value, const char*) {
    line(key, "");
    ++level_;
    value.visit(*this);
    --level_;
  }

  template <class T>
  void operator()(const char* key, std::vector<T>& values, const char*) {
    if (values.empty()) return;
    line(key, "");
    level_ += 2;
    for (T& value : values) {
      item_ = true;
      value.visit(*this);
    }
    level_ -= 2;
  }

  template <class T>
  void operator()(const char* key, std::optional<T>& value, const char* doc) {
    if (value) (*this)(key, *value, doc);
  }

 private:
  void line(const char* key, const std::string& value);

  std::string yaml_;
  int level_ = 0;
  bool item_ = false;  // the next line begins an item of a list
};

}  // namespace dodgesim

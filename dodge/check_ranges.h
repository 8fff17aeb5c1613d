// The ranges that a configuration's visit() states, checked.
#pragma once

#include <initializer_list>
#include <sstream>
#include <stdexcept>
#include <string>
#include <type_traits>
#include <utility>

namespace dodge {

// A visitor that throws std::invalid_argument, with a sentence that names the parameter and its
// range, at the first value outside it.
class RangeChecker {
 public:
  // path: before the names, such as "kalman.".
  explicit RangeChecker(std::string path = "") : path_(std::move(path)) {}

  template <class Number>
  requires std::is_arithmetic_v<Number>
  void operator()(const char* name, Number& value, std::type_identity_t<Number> min,
                  std::type_identity_t<Number> max, const char*) const {
    if (value >= min && value <= max) return;  // false for NaN
    std::ostringstream sentence;
    sentence << "The parameter " << path_ << name << " is " << value << " but must lie between "
             << min << " and " << max << ".";
    throw std::invalid_argument(sentence.str());
  }
  void operator()(const char*, bool&, const char*) const {}
  void operator()(const char* name, std::string& value, std::initializer_list<const char*> allowed,
                  const char*) const {
    std::string choices;
    for (const char* choice : allowed) {
      if (value == choice) return;
      choices += std::string(choices.empty() ? "" : ", ") + choice;
    }
    throw std::invalid_argument("The parameter " + path_ + name + " is \"" + value +
                                "\" but must be one of " + choices + ".");
  }
  template <class Nested>
  void operator()(const char* name, Nested& nested, const char*) const {
    RangeChecker inner(path_ + name + ".");
    nested.visit(inner);
  }

 private:
  std::string path_;
};

// Throws std::invalid_argument as RangeChecker does.
template <class Config>
void check_ranges(Config config) {  // a copy: visit() is not const
  RangeChecker checker;
  config.visit(checker);
}

}  // namespace dodge

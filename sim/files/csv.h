// CSV (RFC 4180) from visit(): names of arrays get _0, _1, ...; nested structs a prefix; empty
// optionals an empty cell; doubles the shortest text that reads back as the same double.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "sim/base/numbers.h"

namespace dodgesim {

// Quoted when it must be; line breaks become spaces, so that a row stays a line.
std::string csv_cell(const std::string& text);

// Collects both lines of a struct: header() names the columns of row(), each ending with "\n".
class CsvLine {
 public:
  std::string header() const { return header_ + "\n"; }
  std::string row() const { return row_ + "\n"; }

  void operator()(const std::string& name, const std::string& value) { add(name, csv_cell(value)); }
  void operator()(const std::string& name, bool& value) { add(name, value ? "1" : "0"); }
  void operator()(const std::string& name, int& value) { add(name, to_text(value)); }
  void operator()(const std::string& name, std::int64_t& value) { add(name, to_text(value)); }
  void operator()(const std::string& name, std::uint64_t& value) { add(name, to_text(value)); }
  void operator()(const std::string& name, double& value);

  template <class T, std::size_t N>
  void operator()(const std::string& name, std::array<T, N>& values) {
    for (std::size_t i = 0; i < N; ++i) (*this)(name + "_" + std::to_string(i), values[i]);
  }

  // A column for each key, of structs {key, value}.
  template <class KeyAndValue>
  requires requires(const KeyAndValue& of) { of.key, of.value; }
  void operator()(const std::string&, const std::vector<KeyAndValue>& values) {
    for (const KeyAndValue& of : values) add(of.key, csv_cell(of.value));
  }

  template <class T>
  void operator()(const std::string& name, std::optional<T>& value) {
    blank_ = blank_ || !value;
    T present = value.value_or(T{});
    (*this)(name, present);
    blank_ = false;
  }

  template <class T>
  requires requires(T& t, CsvLine& line) { t.visit(line); }
  void operator()(const std::string& name, T& nested) {
    const std::string outer = prefix_;
    prefix_ += name + "_";
    nested.visit(*this);
    prefix_ = outer;
  }

 protected:
  // `cell` as it stands in the row, quoted where it must be.
  void add(const std::string& name, const std::string& cell);

 private:
  std::string header_, row_;
  std::string prefix_;
  bool blank_ = false;
  bool started_ = false;
};

// Of the rows of values like this one: the results of a campaign share the keys of their axes.
template <class T>
std::string csv_header(T value = {}) {
  CsvLine line;
  value.visit(line);
  return line.header();
}

template <class T>
std::string csv_row(T value) {
  CsvLine line;
  value.visit(line);
  return line.row();
}

}  // namespace dodgesim

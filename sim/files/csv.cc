#include "sim/files/csv.h"

#include <algorithm>
#include <cmath>

namespace dodgesim {

std::string csv_cell(const std::string& text) {
  std::string line = text;
  std::ranges::replace_if(
      line, [](char c) { return c == '\n' || c == '\r'; }, ' ');
  if (line.find_first_of(",\"") == std::string::npos) return line;
  std::string quoted = "\"";
  for (const char c : line) {
    if (c == '"') quoted += '"';
    quoted += c;
  }
  return quoted + "\"";
}

void CsvLine::operator()(const std::string& name, double& value) {
  // Readers agree on nan, not on the sign or the spelling of infinities.
  add(name, std::isfinite(value) ? to_text(value) : "nan");
}

void CsvLine::add(const std::string& name, const std::string& cell) {
  if (started_) {
    header_ += ",";
    row_ += ",";
  }
  started_ = true;
  header_ += prefix_ + name;
  if (!blank_) row_ += cell;
}

}  // namespace dodgesim

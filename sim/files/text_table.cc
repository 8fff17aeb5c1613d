#include "sim/files/text_table.h"

#include <cmath>

#include "sim/base/formatted.h"
#include "sim/files/csv.h"
#include "sim/files/markup.h"

namespace dodgesim {

namespace {

std::string markdown_row(const std::vector<std::string>& cells) {
  std::string line = "|";
  for (const std::string& cell : cells) line += " " + markdown_cell(cell) + " |";
  return line + "\n";
}

std::string csv_line(const std::vector<std::string>& cells) {
  std::string line;
  const char* separator = "";
  for (const std::string& cell : cells) {
    line += separator + csv_cell(cell);
    separator = ",";
  }
  return line + "\n";
}

}  // namespace

std::string TextTable::to_markdown() const {
  std::string text = markdown_row(head) + "|";
  for (std::size_t i = 0; i < head.size(); ++i) text += "---|";
  text += "\n";
  for (const auto& row : rows) text += markdown_row(row);
  return text;
}

std::string TextTable::to_csv() const {
  std::string text = csv_line(head);
  for (const auto& row : rows) text += csv_line(row);
  return text;
}

std::string fixed_text(double value, int digits) { return formatted("%.*f", digits, value); }

std::string with_interval(double value, const Interval& interval, int digits) {
  if (!std::isfinite(interval.lo) && !std::isfinite(interval.hi)) return fixed_text(value, digits);
  return fixed_text(value, digits) + " (" + fixed_text(interval.lo, digits) + " to " +
         fixed_text(interval.hi, digits) + ")";
}

std::string count_text(std::int64_t count, const std::string& what) {
  return std::to_string(count) + " " + what + (count == 1 ? "" : "s");
}

}  // namespace dodgesim

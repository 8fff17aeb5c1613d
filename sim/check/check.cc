#include "sim/check/check.h"

#include <algorithm>
#include <cmath>

#include "sim/base/contains.h"
#include "sim/files/text_table.h"

namespace dodgesim {

namespace {

constexpr std::size_t kNameColumn = 34, kMeasuredColumn = 24, kExpectedColumn = 34;

std::string padded(std::string text, std::size_t width) {
  text.resize(std::max(text.size() + 1, width), ' ');
  return text;
}

}  // namespace

std::string quantity_text(double value, int decimals, const std::string& unit) {
  return fixed_text(value, decimals) + (unit.empty() ? "" : " " + unit);
}

std::string outcome_text(Outcome outcome) {
  if (outcome == Outcome::kOff) return "off";
  return outcome == Outcome::kOk ? "ok" : "FAIL";
}

std::string line_text(const CheckLine& line) {
  return padded(line.name, kNameColumn) + padded(line.measured, kMeasuredColumn) +
         padded(line.expected, kExpectedColumn) + outcome_text(line.outcome);
}

bool Check::failed() const { return contains(lines, Outcome::kFail, &CheckLine::outcome); }

void Check::within(const std::string& name, double measured, double expected, double limit,
                   const std::string& unit, int decimals) {
  const bool good = std::abs(measured - expected) <= limit;
  lines.push_back(
      {name, quantity_text(measured, decimals, unit),
       quantity_text(expected, decimals, "") + " +- " + quantity_text(limit, decimals, unit),
       good ? Outcome::kOk : Outcome::kFail});
}

void Check::between(const std::string& name, double measured, double lowest, double highest,
                    const std::string& unit, int decimals) {
  const bool good = measured >= lowest && measured <= highest;
  const std::string range = lowest == highest ? quantity_text(lowest, decimals, unit)
                                              : quantity_text(lowest, decimals, "") + " to " +
                                                    quantity_text(highest, decimals, unit);
  lines.push_back(
      {name, quantity_text(measured, decimals, unit), range, good ? Outcome::kOk : Outcome::kFail});
}

void Check::off(const std::string& name, const std::string& why) {
  lines.push_back({name, "-", why, Outcome::kOff});
}

}  // namespace dodgesim

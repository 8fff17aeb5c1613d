// What a self-test of the event camera has to say: lines for the terminal, plots for the report.
//
// Every check comes in two parts: measure_...() films an event camera and takes from its events
// what can be measured; judge() holds that against the parameters that the camera should have. A
// camera that is not what it is said to be thus fails.
#pragma once

#include <string>
#include <vector>

#include "sim/plot/plot.h"

namespace dodgesim {

enum class Outcome {
  kOk,
  kFail,
  kOff,  // that part of the camera is switched off, or the check cannot be made with it
};

struct CheckLine {
  std::string name;      // "threshold.on.mean", without spaces
  std::string measured;  // with its unit
  std::string expected;  // with what it may differ by
  Outcome outcome = Outcome::kOk;
};

struct Check {
  std::string title;
  std::string method;  // what was done, in a few sentences
  std::vector<CheckLine> lines = {};
  std::vector<Plot> plots = {};

  bool failed() const;

  // |measured - expected| <= limit; a measured value that is no number fails.
  void within(const std::string& name, double measured, double expected, double limit,
              const std::string& unit, int decimals);
  // lowest <= measured <= highest
  void between(const std::string& name, double measured, double lowest, double highest,
               const std::string& unit, int decimals);
  void off(const std::string& name, const std::string& why);
};

// "12.30 us"; the unit may be empty.
std::string quantity_text(double value, int decimals, const std::string& unit);

// "ok", "FAIL", "off".
std::string outcome_text(Outcome outcome);

// The line as it is printed, in columns, without a line end.
std::string line_text(const CheckLine& line);

}  // namespace dodgesim

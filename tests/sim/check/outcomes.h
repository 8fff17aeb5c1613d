// What a check says of a camera, by the names of its lines.
#pragma once

#include <string>
#include <vector>

#include "sim/check/check.h"

namespace dodgesim {

using Names = std::vector<std::string>;

// Names of the lines with this outcome.
inline Names lines(const Check& check, Outcome outcome) {
  Names names;
  for (const CheckLine& line : check.lines) {
    if (line.outcome == outcome) names.push_back(line.name);
  }
  return names;
}

inline Names failures(const Check& check) { return lines(check, Outcome::kFail); }

}  // namespace dodgesim

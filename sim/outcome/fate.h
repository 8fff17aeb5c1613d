// What became of a throw, in one word.
#pragma once

#include <array>
#include <string>

#include "sim/outcome/result.h"

namespace dodgesim {

enum class Fate {
  kNotFlown,  // ThrowResult::nobody_could_fly()
  kFailed,    // the flight of the scenario's pilot
  kHit,
  kCrashed,
  kLanded,      // ThrowResult::gave_up()
  kQuiet,       // nobody threw, and the pilot did not evade
  kFalseAlarm,  // nobody threw, and it did
  kNotJudged,   // neither hit nor crashed, but nobody knows whether it would have been
  kDodged,
  kWouldHaveMissed
};
inline constexpr std::array kFates = {
    Fate::kNotFlown, Fate::kFailed,     Fate::kHit,       Fate::kCrashed, Fate::kLanded,
    Fate::kQuiet,    Fate::kFalseAlarm, Fate::kNotJudged, Fate::kDodged,  Fate::kWouldHaveMissed};

// The first in the order above that is true of it.
Fate fate_of(const ThrowResult& result);

std::string to_text(Fate fate);  // "would have missed"

}  // namespace dodgesim

#include "sim/outcome/fate.h"

#include <iterator>

namespace dodgesim {

Fate fate_of(const ThrowResult& result) {
  if (result.nobody_could_fly()) return Fate::kNotFlown;
  if (!result.flown.ok()) return Fate::kFailed;
  if (result.flown.hit) return Fate::kHit;
  if (result.flown.crashed) return Fate::kCrashed;
  if (result.gave_up()) return Fate::kLanded;
  if (!result.thrown()) return result.evaded ? Fate::kFalseAlarm : Fate::kQuiet;
  if (!result.none.ok()) return Fate::kNotJudged;
  return result.none.hit ? Fate::kDodged : Fate::kWouldHaveMissed;
}

std::string to_text(Fate fate) {
  constexpr const char* kTexts[] = {
      "not flown", "failed",      "hit",        "crashed", "landed",
      "quiet",     "false alarm", "not judged", "dodged",  "would have missed"};
  static_assert(std::size(kTexts) == kFates.size());
  return kTexts[static_cast<std::size_t>(fate)];
}

}  // namespace dodgesim

#include "sim/outcome/fate.h"

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
  switch (fate) {
    case Fate::kNotFlown:
      return "not flown";
    case Fate::kFailed:
      return "failed";
    case Fate::kHit:
      return "hit";
    case Fate::kCrashed:
      return "crashed";
    case Fate::kLanded:
      return "landed";
    case Fate::kQuiet:
      return "quiet";
    case Fate::kFalseAlarm:
      return "false alarm";
    case Fate::kNotJudged:
      return "not judged";
    case Fate::kDodged:
      return "dodged";
    case Fate::kWouldHaveMissed:
      break;
  }
  return "would have missed";
}

}  // namespace dodgesim

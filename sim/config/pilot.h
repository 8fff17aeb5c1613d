// The names of the pilots that a scenario may choose.
#pragma once

#include <string>

namespace dodgesim {

inline constexpr const char* kPaperPilot = "falanga2020";
inline constexpr const char* kOwnPilot = "dodgesim";
inline constexpr const char* kPluginPilot = "plugin";
inline constexpr const char* kOraclePilot = "oracle";  // is told of the objects
inline constexpr const char* kNoPilot = "none";        // dodges nothing

// Whether the pilot sees with the cameras; the others are told of objects, or of nothing.
inline bool perceives(const std::string& pilot) {
  return pilot != kOraclePilot && pilot != kNoPilot;
}

// Whose configuration the key `dodger` starts from: the pilot's own or, for those who do not
// perceive, the paper's.
inline std::string dodger_preset(const std::string& pilot) {
  return pilot == kOwnPilot ? kOwnPilot : kPaperPilot;
}

}  // namespace dodgesim

// The value that a varied key has for a throw.
#pragma once

#include <string>

namespace dodgesim {

// As in YAML: {"throw.speed_mps", "!uniform [4, 6]"}.
struct AxisValue {
  std::string key;
  std::string value;

  bool operator==(const AxisValue&) const = default;
};

}  // namespace dodgesim

// What is said of a scenario that is refused, for the tests.
#pragma once

#include <string>

#include "sim/base/error.h"
#include "sim/config/scenario.h"

namespace dodgesim {

inline std::string error_of(const std::string& yaml) {
  try {
    parse_scenario(yaml, "bad.yaml", std::string(DODGESIM_SOURCE_DIR) + "/models");
  } catch (const ScenarioError& error) {
    return error.what();
  }
  return "no error";
}

inline std::string repeat(const std::string& text, int times) {
  std::string all;
  for (int i = 0; i < times; ++i) all += text;
  return all;
}

}  // namespace dodgesim

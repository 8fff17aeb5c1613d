// What is said of a scenario that is refused, for the tests.
#pragma once

#include <string>

#include "sim/base/error.h"
#include "sim/config/scenario.h"
#include "tests/complaint.h"

namespace dodgesim {

inline std::string error_of(const std::string& yaml) {
  return testing::complaint<ScenarioError>(
      [&] { parse_scenario(yaml, "bad.yaml", std::string(DODGESIM_SOURCE_DIR) + "/models"); });
}

inline std::string repeat(const std::string& text, int times) {
  std::string all;
  for (int i = 0; i < times; ++i) all += text;
  return all;
}

struct BadScenario {
  const char* name;
  std::string yaml;
  std::string message;  // the whole of it, or its start
};

inline void PrintTo(const BadScenario& bad, std::ostream* out) { *out << bad.name; }

}  // namespace dodgesim

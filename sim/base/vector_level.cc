#include "sim/base/vector_level.h"

#include <array>
#include <cstdlib>
#include <string>

#include "sim/base/error.h"
#include "sim/base/shell.h"

namespace dodgesim {

namespace {

constexpr std::array<const char*, kVectorLevels> kNames = {"portable", "avx2", "avx512"};

int level_asked_for() {
  const char* const asked = std::getenv("DODGESIM_VECTORS");
  if (asked == nullptr) return widest_vector_level();
  std::string names;
  for (int level = kPortable; level <= widest_vector_level(); ++level) {
    const char* const name = kNames.at(static_cast<std::size_t>(level));
    if (std::string(name) == asked) return level;
    names += (names.empty() ? "" : ", ") + std::string(name);
  }
  throw ScenarioError("The environment variable DODGESIM_VECTORS is " + shell_quoted(asked) +
                      ", but must be one of those that this processor has: " + names + ".");
}

}  // namespace

int vector_level() {
  static const int level = level_asked_for();
  return level;
}

}  // namespace dodgesim

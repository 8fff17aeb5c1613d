// Campaigns that end early, of throws that nobody flew.
#pragma once

#include <string>

#include "sim/config/scenario.h"
#include "tests/sim/tables/fake_throws.h"

namespace dodgesim {

// Every tenth ball would have missed; of the others, all but every fifth is dodged.
inline ThrowResult nth_throw(int index) {
  ThrowResult result = ball(index, 0.2, 3, 5);
  result.none = flown(index % 10 != 0);
  result.flown = flown(index % 5 == 1);
  return result;
}

inline Scenario stopping(double half_width, int repeats) {
  return parse_scenario("repeats: " + std::to_string(repeats) +
                            "\nthrow: {}\nstop: {half_width: " + std::to_string(half_width) + "}\n",
                        "s.yaml", "");
}

}  // namespace dodgesim

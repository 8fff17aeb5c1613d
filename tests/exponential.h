#pragma once

#include <cmath>

#include "sim/base/random.h"

namespace dodgesim {

// A draw from the exponential distribution of mean 1 / rate.
inline double exponential(RandomStream& random, double rate) {
  return -std::log1p(-random.uniform()) / rate;
}

}  // namespace dodgesim

// The pilots that are configurations of Dodger.
#pragma once

#include <string>

#include "dodge/config.h"

namespace dodge {

// "falanga2020": the defaults of Config, after the paper. "dodgesim": believes an obstacle as
// far as its covariance allows, 5 m at most, predicts its free fall, and escapes by the predicted
// closest approach. Throws std::invalid_argument for another name.
Config preset(const std::string& pilot);

}  // namespace dodge

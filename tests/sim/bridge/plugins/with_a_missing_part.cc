// A plug-in that calls what no library has.
#include "dodge/plugin.h"

std::unique_ptr<dodge::Pilot> made_elsewhere(const dodge::Config& config,
                                             const std::string& parameters);

DODGE_PLUGIN(made_elsewhere)

// Pilots of users: shared libraries that are loaded at run time (dodge/plugin.h).
#pragma once

#include <memory>
#include <string>

#include "dodge/plugin.h"

namespace dodgesim {

// The library of a campaign; without one, both are empty.
struct Plugin {
  std::string file;
  std::string digest;  // hexadecimal digits, of the file's bytes
};

// Throws IoError if the file cannot be read.
Plugin read_plugin(const std::string& file);

// A pilot for one flight. The library stays loaded until the process ends. Throws SimulationError
// if it is no longer the one that was read, cannot be loaded, was compiled with other headers, or
// makes no pilot; what it throws itself leaves as it is.
std::unique_ptr<dodge::Pilot> make_pilot(const Plugin& plugin, const dodge::Config& config,
                                         const std::string& parameters);

}  // namespace dodgesim

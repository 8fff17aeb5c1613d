// Pilots of users: shared libraries that are loaded at run time (dodge/plugin.h).
#pragma once

#include <memory>
#include <string>

#include "dodge/plugin.h"

namespace dodgesim {

// The library of a campaign, as its file was when it was read; without one, all are empty.
struct Plugin {
  std::string file;
  std::string digest;  // hexadecimal digits, of the bytes
  // Descriptor of a copy in memory, which this process and its children have. It stays open: the
  // loader knows a library by its descriptor's name, and would take another of that name for it.
  int copy = -1;
};

// Throws IoError if the file cannot be read or copied.
Plugin read_plugin(const std::string& file);

// A pilot for one flight, guarded (guarded_pilot.h). The library stays loaded until the process
// ends. Throws SimulationError if it cannot be loaded, was compiled with other headers, or makes no
// pilot; MemoryError if that is for lack of memory.
std::unique_ptr<dodge::Pilot> make_plugin_pilot(const Plugin& plugin, const dodge::Config& config,
                                                const std::string& parameters);

}  // namespace dodgesim

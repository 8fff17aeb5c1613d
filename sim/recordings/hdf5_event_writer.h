// The HDF5 format of event_writer.h.
#pragma once

#include <filesystem>
#include <memory>

#include "sim/recordings/event_writer.h"

namespace dodgesim {

// Throws ScenarioError for a recording that is too long for its 32-bit time stamps.
std::unique_ptr<EventWriter> make_hdf5_event_writer(const std::filesystem::path& path,
                                                    const Recording& recording);

}  // namespace dodgesim

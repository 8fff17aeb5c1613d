// Recordings of events in HDF5 (see event_reader.h for the layout).
#pragma once

#include <memory>
#include <string>

#include "sim/recordings/event_reader.h"

namespace dodgesim {

std::unique_ptr<EventReader> open_hdf5_events(const std::string& path, const ImageSize& image);

}  // namespace dodgesim

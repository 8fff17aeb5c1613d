// Recordings of events as NumPy's arrays (.npy; see event_reader.h).
#pragma once

#include <memory>
#include <string>

#include "sim/recordings/event_reader.h"

namespace dodgesim {

std::unique_ptr<EventReader> open_npy_events(const std::string& path, const ImageSize& image);

}  // namespace dodgesim

// Recordings of Prophesee's cameras (.raw; see event_reader.h).
#pragma once

#include <memory>
#include <string>

#include "sim/recordings/event_reader.h"

namespace dodgesim {

std::unique_ptr<EventReader> open_prophesee_events(const std::string& path, const ImageSize& image);

}  // namespace dodgesim

// The format .raw of event_writer.h.
#pragma once

#include <filesystem>
#include <memory>

#include "sim/recordings/event_writer.h"

namespace dodgesim {

// Throws ScenarioError for a recording that is too long for its 34-bit clock, or too large for its
// 11-bit pixels.
std::unique_ptr<EventWriter> make_prophesee_event_writer(const std::filesystem::path& path,
                                                         const Recording& recording);

}  // namespace dodgesim

// Directories for results.
#pragma once

#include <filesystem>

namespace dodgesim {

// Makes it, and what it lies in, when it is missing, and returns it. Throws IoError with its name
// and the reason.
std::filesystem::path make_directory(const std::filesystem::path& directory);

}  // namespace dodgesim

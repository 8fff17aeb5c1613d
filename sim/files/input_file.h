// Whole files as text.
#pragma once

#include <filesystem>
#include <string>

namespace dodgesim {

// Throws IoError with the path.
std::string read_file(const std::filesystem::path& path);

}  // namespace dodgesim

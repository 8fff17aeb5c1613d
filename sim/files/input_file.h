// Whole files as text.
#pragma once

#include <filesystem>
#include <string>

namespace dodgesim {

// Throws IoError with the path, also for what is no regular file: to open a pipe may take for ever.
std::string read_file(const std::filesystem::path& path);

}  // namespace dodgesim

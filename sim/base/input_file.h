// Files that are read.
#pragma once

#include <filesystem>
#include <fstream>
#include <string>

namespace dodgesim {

// Throw IoError with the path, also for what is no regular file: to open a pipe may take for ever.
std::ifstream open_file(const std::filesystem::path& path);
// The whole text.
std::string read_file(const std::filesystem::path& path);

}  // namespace dodgesim

// Directories for results.
#pragma once

#include <filesystem>
#include <vector>

namespace dodgesim {

// Makes it, and what it lies in, when it is missing, and returns it. Throws IoError with its name
// and the reason.
std::filesystem::path make_directory(const std::filesystem::path& directory);

// Removes the file, if it is there. Throws IoError with its name and the reason.
void remove_file(const std::filesystem::path& file);

// Makes a directory like make_directory(); what it has made, but for what holds files by then, is
// removed again at its end.
class NewDirectory {
 public:
  explicit NewDirectory(const std::filesystem::path& directory);
  NewDirectory(const NewDirectory&) = delete;
  NewDirectory& operator=(const NewDirectory&) = delete;
  ~NewDirectory();

 private:
  std::vector<std::filesystem::path> made_;  // the inner ones first
};

}  // namespace dodgesim

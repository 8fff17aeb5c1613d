#include "sim/files/directory.h"

#include <system_error>

#include "sim/base/error.h"

namespace dodgesim {

std::filesystem::path make_directory(const std::filesystem::path& directory) {
  if (directory.empty()) throw IoError("The name of the directory for the results is empty.");
  std::error_code error, unknown;
  std::filesystem::create_directories(directory, error);
  if (std::filesystem::is_directory(directory, unknown)) return directory;
  throw IoError(directory.string() + " could not be created: " +
                (std::filesystem::exists(directory, unknown) ? "a file of that name exists"
                                                             : error.message()) +
                ".");
}

void remove_file(const std::filesystem::path& file) {
  std::error_code error;
  std::filesystem::remove(file, error);
  if (error) throw IoError(file.string() + " could not be removed: " + error.message() + ".");
}

NewDirectory::NewDirectory(const std::filesystem::path& directory) {
  std::error_code ignored;
  for (std::filesystem::path path = directory;
       !path.empty() && !std::filesystem::exists(path, ignored); path = path.parent_path()) {
    made_.push_back(path);
  }
  make_directory(directory);
}

NewDirectory::~NewDirectory() {
  std::error_code not_empty;
  for (const std::filesystem::path& path : made_) std::filesystem::remove(path, not_empty);
}

}  // namespace dodgesim

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

}  // namespace dodgesim

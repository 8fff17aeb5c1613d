#include "sim/files/input_file.h"

#include <fstream>
#include <iterator>

#include "sim/base/error.h"

namespace dodgesim {

std::string read_file(const std::filesystem::path& path) {
  std::error_code error;
  const auto kind = std::filesystem::status(path, error).type();
  if (kind == std::filesystem::file_type::not_found) {
    throw IoError(path.string() + " is missing.");
  }
  if (!error && kind != std::filesystem::file_type::regular) {
    throw IoError(path.string() + " is not a regular file.");
  }
  std::ifstream file(path, std::ios::binary);
  std::string text;
  if (file) text.assign(std::istreambuf_iterator<char>(file), {});
  if (!file || file.bad()) throw IoError(path.string() + " could not be read.");
  return text;
}

}  // namespace dodgesim

#include "sim/files/input_file.h"

#include <fstream>
#include <sstream>
#include <utility>

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
  std::ostringstream text;
  // An empty file has nothing to put in, which is a failure of the text's.
  if (file && file.peek() != std::ifstream::traits_type::eof()) text << file.rdbuf();
  if (!file.is_open() || file.bad() || text.fail()) {
    throw IoError(path.string() + " could not be read.");
  }
  return std::move(text).str();
}

}  // namespace dodgesim

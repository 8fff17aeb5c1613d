#include "sim/files/input_file.h"

#include <fstream>
#include <iterator>

#include "sim/base/error.h"

namespace dodgesim {

std::string read_file(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  std::string text;
  if (file) text.assign(std::istreambuf_iterator<char>(file), {});
  if (!file || file.bad() || std::filesystem::is_directory(path)) {
    throw IoError(path.string() + " could not be read.");
  }
  return text;
}

}  // namespace dodgesim

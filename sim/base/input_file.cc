#include "sim/base/input_file.h"

#include <array>
#include <cerrno>
#include <cstring>

#include "sim/base/error.h"

namespace dodgesim {

namespace {

[[noreturn]] void fail(const std::filesystem::path& path) {
  throw IoError(path.string() + " could not be read: " + std::strerror(errno) + ".");
}

}  // namespace

std::ifstream open_file(const std::filesystem::path& path) {
  std::error_code error;
  const auto kind = std::filesystem::status(path, error).type();
  if (kind == std::filesystem::file_type::not_found) {
    throw IoError(path.string() + " is missing.");
  }
  if (!error && kind != std::filesystem::file_type::regular) {
    throw IoError(path.string() + " is not a regular file.");
  }
  std::ifstream file(path, std::ios::binary);
  if (!file) fail(path);
  return file;
}

std::string read_file(const std::filesystem::path& path) {
  std::ifstream file = open_file(path);
  std::string text;
  std::array<char, 1 << 16> block;
  while (file.read(block.data(), block.size()) || file.gcount() > 0) {
    text.append(block.data(), static_cast<std::size_t>(file.gcount()));
  }
  if (file.bad()) fail(path);
  return text;
}

}  // namespace dodgesim

#include "sim/files/npy_reader.h"

#include <sys/stat.h>

#include <array>
#include <cerrno>
#include <cstring>
#include <stdexcept>

#include "sim/base/error.h"

namespace dodgesim {

namespace {

constexpr std::size_t kLongestHeader = 64 * 1024;  // NumPy refuses more than 10,000 bytes

std::string bytes_text(std::uint64_t bytes) {
  return std::to_string(bytes) + (bytes == 1 ? " byte" : " bytes");
}

}  // namespace

NpyReader::NpyReader(const std::string& path) : path_(path) {
  const auto not_opened = [this] {
    return IoError(path_ + " could not be opened: " + std::strerror(errno) + ".");
  };
  struct stat status {};
  if (::stat(path.c_str(), &status) != 0) throw not_opened();
  // A pipe has no size, and to open one may take for ever.
  if (!S_ISREG(status.st_mode)) refuse("is not a regular file, which an array must be");
  file_.reset(std::fopen(path.c_str(), "rb"));
  if (!file_) throw not_opened();
  file_bytes_ = static_cast<std::uint64_t>(status.st_size);
  read_header();
}

void NpyReader::read_header() {
  std::array<unsigned char, 12> start{};  // magic, version, length of 2 or 4 bytes
  const std::size_t n = std::fread(start.data(), 1, 8, file_.get());
  if (n < 8 || std::memcmp(start.data(), "\x93NUMPY", 6) != 0) {
    refuse("is not a .npy file: it does not begin with \\x93NUMPY and a version");
  }
  const int major = start[6];
  if (major < 1 || major > 3) {
    refuse("is of version " + std::to_string(major) + " of the .npy format; known are 1, 2 and 3");
  }
  const std::size_t length_bytes = major == 1 ? 2 : 4;
  if (std::fread(start.data() + 8, 1, length_bytes, file_.get()) < length_bytes) {
    refuse("is truncated within its header");
  }
  std::size_t length = 0;
  for (std::size_t i = 0; i < length_bytes; ++i) length |= std::size_t{start[8 + i]} << (8 * i);
  front_bytes_ = 8 + length_bytes + length;
  if (front_bytes_ > file_bytes_) refuse("is truncated within its header");
  if (length > kLongestHeader)
    refuse("has a header of " + bytes_text(length) + ", which is absurd");
  std::string text(length, '\0');
  if (std::fread(text.data(), 1, length, file_.get()) < length) {
    refuse("is truncated within its header");
  }
  try {
    header_ = parse_npy_header(text);
  } catch (const std::invalid_argument& error) {
    refuse(std::string("has a header that cannot be read: ") + error.what());
  }
}

void NpyReader::require_size(std::size_t item_bytes) const {
  std::uint64_t bytes = item_bytes;
  bool overflow = false;
  for (const std::uint64_t n : header_.shape) {
    overflow = __builtin_mul_overflow(bytes, n, &bytes) || overflow;
  }
  const std::uint64_t present = file_bytes_ - front_bytes_;
  const std::string array = "its array of shape " + shape_text(header_.shape);
  if (overflow || bytes > present) {
    refuse("is truncated: " + array + " needs " + (overflow ? "more" : bytes_text(bytes)) +
           ", but " + bytes_text(present) + " follow the header");
  }
  if (bytes < present) {
    refuse("holds " + bytes_text(present - bytes) + " too many: " + array + " has " +
           bytes_text(bytes) + ", but " + bytes_text(present) + " follow the header");
  }
}

void NpyReader::read(void* to, std::size_t bytes) {
  errno = 0;
  if (std::fread(to, 1, bytes, file_.get()) == bytes) return;
  // The size was right at the beginning.
  throw IoError(path_ + " could not be read to its end: " +
                (errno != 0 ? std::strerror(errno) : "it became shorter meanwhile") + ".");
}

void NpyReader::rewind() {
  if (::fseeko(file_.get(), static_cast<off_t>(front_bytes_), SEEK_SET) == 0) return;
  throw IoError(path_ + " could not be read: " + std::strerror(errno) + ".");
}

void NpyReader::refuse(const std::string& complaint) const {
  throw ScenarioError(path_ + " " + complaint + ".");
}

}  // namespace dodgesim

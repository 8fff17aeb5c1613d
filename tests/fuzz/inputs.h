// What the targets share.
#pragma once

#include <sys/mman.h>
#include <unistd.h>

#include <cstdlib>
#include <iostream>
#include <string>
#include <string_view>

#include "sim/base/error.h"
#include "tests/fuzz/targets.h"

namespace dodgesim::fuzz {

inline std::string_view text_of(Bytes bytes) {
  return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

// A broken promise: ends the process, as libFuzzer wants it.
inline void require(bool holds, const char* promise) {
  if (holds) return;
  std::cerr << "Broken promise: " << promise << "\n";
  std::abort();
}

// Whether the reader accepts its input; it may refuse it with an error of ours only.
template <class Reader>
bool accepts(Reader read) {
  try {
    read();
    return true;
  } catch (const ScenarioError&) {
  } catch (const IoError&) {
  }
  return false;
}

// A file that only has a path, not a place on a disk.
class MemoryFile {
 public:
  explicit MemoryFile(std::string_view contents) : fd_(::memfd_create("fuzz", MFD_CLOEXEC)) {
    require(fd_ >= 0, "a file in memory can be made");
    const auto size = static_cast<ssize_t>(contents.size());
    require(::write(fd_, contents.data(), contents.size()) == size, "it can be written");
  }
  ~MemoryFile() { ::close(fd_); }
  MemoryFile(const MemoryFile&) = delete;
  MemoryFile& operator=(const MemoryFile&) = delete;

  std::string path() const { return "/proc/self/fd/" + std::to_string(fd_); }

 private:
  int fd_;
};

}  // namespace dodgesim::fuzz

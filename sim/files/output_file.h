// Files of text or bytes that are either whole or absent (see staged_file.h), written through a
// buffer.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <utility>

#include "sim/files/staged_file.h"

namespace dodgesim {

class OutputFile {
 public:
  // All functions throw IoError with the path and the system's reason. Without commit() nothing is
  // left behind.
  explicit OutputFile(std::filesystem::path path) : staged_(std::move(path)) {}

  void write(std::string_view text);
  // Replaces what stands at the beginning of the file, of the same length.
  void rewrite_front(std::string_view text);
  // Flushes everything to the disk; what is left for commit() is to rename the file.
  void finish();
  void commit();

 private:
  void flush();

  StagedFile staged_;
  std::string buffer_;
};

void write_file(const std::filesystem::path& path, std::string_view text);

}  // namespace dodgesim

// Files that are either whole or absent: written under a temporary name, flushed to the disk,
// checked, and only then renamed.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

namespace dodgesim {

class OutputFile {
 public:
  // Opens PATH.partial. All functions throw IoError with the path and the system's reason.
  explicit OutputFile(std::filesystem::path path);
  OutputFile(const OutputFile&) = delete;
  OutputFile& operator=(const OutputFile&) = delete;
  ~OutputFile();  // without commit() the temporary file is removed

  void write(std::string_view text);
  void commit();

 private:
  void flush();
  [[noreturn]] void fail(const std::string& what) const;

  std::filesystem::path path_, partial_;
  int fd_ = -1;
  std::string buffer_;
};

void write_file(const std::filesystem::path& path, std::string_view text);

}  // namespace dodgesim

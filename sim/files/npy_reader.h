// Reads an array from a .npy file (see npy_header.h).
#pragma once

#include <cstdint>
#include <cstdio>
#include <memory>
#include <string>

#include "sim/files/npy_header.h"

namespace dodgesim {

// Reads an array from its beginning to its end, without ever holding more of it than was asked for.
// Throws IoError for what the system refuses, ScenarioError for a file that is not as it should be;
// both in one sentence that opens with the path.
class NpyReader {
 public:
  // Opens the file and reads its header.
  explicit NpyReader(const std::string& path);

  const std::string& path() const { return path_; }
  const NpyHeader& header() const { return header_; }

  // Throws unless the file holds exactly the header and an array of items of item_bytes.
  void require_size(std::size_t item_bytes) const;

  // The next `bytes` of the array.
  void read(void* to, std::size_t bytes);
  // Back to the array's first byte.
  void rewind();

 private:
  struct Close {
    void operator()(std::FILE* file) const { std::fclose(file); }
  };

  void read_header();
  [[noreturn]] void refuse(const std::string& complaint) const;

  std::string path_;
  std::unique_ptr<std::FILE, Close> file_;
  std::uint64_t file_bytes_ = 0;
  std::uint64_t front_bytes_ = 0;  // in front of the array
  NpyHeader header_;
};

}  // namespace dodgesim

// Makes the files of small videos.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "sim/files/npy_header.h"
#include "tests/sim/files/temporary_directory.h"

namespace dodgesim::testing {

// A .npy file of any version with any header, as its bytes.
inline std::string npy(int version, const std::string& header, const std::string& array) {
  std::string file = std::string("\x93NUMPY") + static_cast<char>(version) + '\0';
  for (int i = 0; i < (version == 1 ? 2 : 4); ++i) {
    file += static_cast<char>(header.size() >> (8 * i) & 0xff);
  }
  return file + header + array;
}

inline std::string header(const std::string& dtype, const std::string& shape,
                          const std::string& fortran_order = "False") {
  return "{'descr': '" + dtype + "', 'fortran_order': " + fortran_order + ", 'shape': " + shape +
         ", }\n";
}

// An array of shape (n, height, width) or, with height 0, (n).
template <class T>
std::string npy_array(const char* dtype, const std::vector<T>& values, std::uint64_t height = 0,
                      std::uint64_t width = 0) {
  const std::uint64_t n = values.size();
  std::string descr = "'";
  descr += dtype;
  descr += "'";
  const auto shape =
      height == 0 ? std::vector{n} : std::vector{n / (height * width), height, width};
  return npy_front(descr, shape) + bytes_of(values);
}

}  // namespace dodgesim::testing

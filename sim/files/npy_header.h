// NumPy's file format .npy (NEP 1; versions 1.0, 2.0 and 3.0): the bytes \x93NUMPY, the version,
// the length of the header, the header, which is a Python dictionary as text, and the array's
// bytes.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace dodgesim {

struct NpyHeader {
  std::string dtype;  // "<f4", as NumPy writes it; of an array of records their list as it stands
                      // in the file
  bool fortran_order = false;
  std::vector<std::uint64_t> shape;
};

// Parses the dictionary. Throws std::invalid_argument that says what is wrong.
NpyHeader parse_npy_header(std::string_view text);

// "(100, 240, 320)", as Python writes it.
std::string shape_text(const std::vector<std::uint64_t>& shape);

// Everything in front of the array's bytes, in version 1.0 and padded to a multiple of 64 bytes,
// and to no less than min_bytes. `descr` is a Python literal: "'<f4'".
std::string npy_front(const std::string& descr, const std::vector<std::uint64_t>& shape,
                      std::size_t min_bytes = 0);

}  // namespace dodgesim

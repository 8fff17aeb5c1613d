// Pictures for people.
#pragma once

#include <cstdint>
#include <string>

namespace dodgesim {

enum class PngPixels { kGrey, kBgr };

// The bytes of a PNG file of 8 bits a channel. `pixels`: rows from the top, without gaps. Throws
// IoError if libpng makes none.
std::string png_of(const std::uint8_t* pixels, int width, int height, PngPixels format);

}  // namespace dodgesim

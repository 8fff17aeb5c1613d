#include "sim/files/png.h"

#include <png.h>

#include "sim/base/error.h"

namespace dodgesim {

std::string png_of(const std::uint8_t* pixels, int width, int height, PngPixels format) {
  png_image image{};
  image.version = PNG_IMAGE_VERSION;
  image.width = static_cast<png_uint_32>(width);
  image.height = static_cast<png_uint_32>(height);
  image.format = format == PngPixels::kGrey ? PNG_FORMAT_GRAY : PNG_FORMAT_BGR;
  image.flags = PNG_IMAGE_FLAG_FAST;
  constexpr int kNoGaps = 0;
  png_alloc_size_t size = PNG_IMAGE_PNG_SIZE_MAX(image);
  std::string bytes(size, '\0');
  if (png_image_write_to_memory(&image, bytes.data(), &size, 0, pixels, kNoGaps, nullptr) == 0) {
    throw IoError("A picture could not be made: " + std::string(image.message) + ".");
  }
  bytes.resize(size);
  return bytes;
}

}  // namespace dodgesim

#include "sim/files/png.h"

#include <png.h>

#include "sim/base/error.h"

namespace dodgesim {

std::string png_of(const cv::Mat& picture) {
  png_image image{};
  image.version = PNG_IMAGE_VERSION;
  image.width = static_cast<png_uint_32>(picture.cols);
  image.height = static_cast<png_uint_32>(picture.rows);
  image.format = picture.type() == CV_8UC1 ? PNG_FORMAT_GRAY : PNG_FORMAT_BGR;
  image.flags = PNG_IMAGE_FLAG_FAST;
  if (picture.empty() || (picture.type() != CV_8UC1 && picture.type() != CV_8UC3)) {
    throw IoError("A picture could not be made: it is empty or of another type.");
  }
  const auto row_bytes = static_cast<png_int_32>(picture.step[0]);
  png_alloc_size_t size = PNG_IMAGE_PNG_SIZE_MAX(image);
  std::string bytes(size, '\0');
  if (png_image_write_to_memory(&image, bytes.data(), &size, 0, picture.data, row_bytes, nullptr) ==
      0) {
    throw IoError("A picture could not be made: " + std::string(image.message) + ".");
  }
  bytes.resize(size);
  return bytes;
}

}  // namespace dodgesim

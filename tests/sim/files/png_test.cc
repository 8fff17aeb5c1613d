#include "sim/files/png.h"

#include <gtest/gtest.h>
#include <png.h>

#include <vector>

#include "sim/base/error.h"

namespace dodgesim {
namespace {

// As any reader sees it: rows of RGB from the top.
std::vector<std::uint8_t> rgb_of(const std::string& png, int width, int height) {
  png_image image{};
  image.version = PNG_IMAGE_VERSION;
  EXPECT_NE(png_image_begin_read_from_memory(&image, png.data(), png.size()), 0) << image.message;
  EXPECT_EQ(image.width, static_cast<unsigned>(width));
  EXPECT_EQ(image.height, static_cast<unsigned>(height));
  image.format = PNG_FORMAT_RGB;
  std::vector<std::uint8_t> pixels(PNG_IMAGE_SIZE(image));
  EXPECT_NE(png_image_finish_read(&image, nullptr, pixels.data(), 0, nullptr), 0);
  return pixels;
}

TEST(Png, KeepsEveryPixelAndColour) {
  const std::vector<std::uint8_t> bgr = {1, 2, 3,  4,  5,  6,  255, 0, 7,
                                         8, 9, 10, 11, 12, 13, 0,   0, 0};
  const std::vector<std::uint8_t> rgb = rgb_of(png_of(bgr.data(), 3, 2, PngPixels::kBgr), 3, 2);
  ASSERT_EQ(rgb.size(), bgr.size());
  for (std::size_t i = 0; i < rgb.size(); ++i) EXPECT_EQ(rgb[i], bgr[i - i % 3 + 2 - i % 3]) << i;
}

TEST(Png, OfGreyIsGrey) {
  const std::vector<std::uint8_t> grey = {0, 100, 255, 3};
  const std::vector<std::uint8_t> rgb = rgb_of(png_of(grey.data(), 2, 2, PngPixels::kGrey), 2, 2);
  for (std::size_t i = 0; i < rgb.size(); ++i) EXPECT_EQ(rgb[i], grey[i / 3]) << i;
}

TEST(Png, WithoutPixelsIsRefused) {
  EXPECT_THROW(png_of(nullptr, 0, 0, PngPixels::kGrey), IoError);
}

}  // namespace
}  // namespace dodgesim

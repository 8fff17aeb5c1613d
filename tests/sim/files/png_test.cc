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
  cv::Mat3b bgr(2, 3);
  std::uint8_t value = 0;
  for (cv::Vec3b& pixel : bgr) pixel = {value++, value++, static_cast<std::uint8_t>(255 - value)};
  const std::vector<std::uint8_t> rgb = rgb_of(png_of(bgr), 3, 2);
  for (int i = 0; i < 18; ++i) {
    EXPECT_EQ(rgb[static_cast<std::size_t>(i)], bgr(i / 9, i / 3 % 3)[2 - i % 3]) << i;
  }
}

TEST(Png, OfGreyIsGrey) {
  const cv::Mat1b grey = (cv::Mat1b(2, 2) << 0, 100, 255, 3);
  const std::vector<std::uint8_t> rgb = rgb_of(png_of(grey), 2, 2);
  for (int i = 0; i < 12; ++i) {
    EXPECT_EQ(rgb[static_cast<std::size_t>(i)], grey(i / 6, i / 3 % 2)) << i;
  }
}

TEST(Png, OfAPartOfAPictureIsThatPart) {
  cv::Mat1b whole(4, 5);
  for (int i = 0; i < 20; ++i) whole(i / 5, i % 5) = static_cast<std::uint8_t>(i);
  const cv::Mat1b part = whole(cv::Rect(1, 2, 3, 2));
  const std::vector<std::uint8_t> rgb = rgb_of(png_of(part), 3, 2);
  for (int i = 0; i < 18; ++i) {
    EXPECT_EQ(rgb[static_cast<std::size_t>(i)], whole(2 + i / 9, 1 + i / 3 % 3)) << i;
  }
}

TEST(Png, WithoutPixelsOrOfAnotherTypeIsRefused) {
  EXPECT_THROW(png_of(cv::Mat1b()), IoError);
  EXPECT_THROW(png_of(cv::Mat1f(2, 2, 0.0F)), IoError);
}

}  // namespace
}  // namespace dodgesim

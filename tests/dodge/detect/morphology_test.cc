#include "dodge/detect/morphology.h"

#include <gtest/gtest.h>

#include <opencv2/imgproc.hpp>

#include "tests/dodge/generator.h"

namespace dodge {
namespace {

struct Case {
  cv::Size size;
  double share = 0;  // of pixels that are not 0
  bool grey = false;
};

cv::Mat1b random_image(Generator& random, const Case& c) {
  cv::Mat1b image(c.size, std::uint8_t{0});
  for (std::uint8_t& pixel : image) {
    if (random.uniform(0, 1) >= c.share) continue;
    pixel = c.grey ? static_cast<std::uint8_t>(random.uniform(0, 256)) : std::uint8_t{255};
  }
  // A block, which erosion leaves something of, and which touches the border.
  const cv::Rect block(c.size.width / 2, c.size.height / 2, c.size.width, c.size.height / 3);
  image(block & cv::Rect({0, 0}, c.size)) = 255;
  return image;
}

TEST(Morphology, EqualsOpencv) {
  Generator random(1);
  constexpr int kLargest = 15;
  for (const Case& c : {Case{{320, 240}, 0.002}, Case{{320, 240}, 0.5}, Case{{320, 240}, 0.9, true},
                        Case{{37, 23}, 0.05}, Case{{5, 40}, 0.8}, Case{{9, 1}, 0.5}}) {
    Morphology morphology(c.size.width, c.size.height, kLargest);
    for (int size_px = 1; size_px <= kLargest; ++size_px) {
      const cv::Mat1b square(size_px, size_px, std::uint8_t{1});
      for (const int anchor : {0, (size_px - 1) / 2, size_px / 2, size_px - 1}) {
        const cv::Mat1b image = random_image(random, c);
        cv::Mat1b eroded = image.clone(), dilated = image.clone(), expected;
        morphology.erode(eroded, size_px, anchor);
        cv::erode(image, expected, square, {anchor, anchor});
        EXPECT_EQ(cv::countNonZero(eroded != expected), 0) << c.size << size_px << " " << anchor;
        morphology.dilate(dilated, size_px, anchor);
        cv::dilate(image, expected, square, {anchor, anchor});
        EXPECT_EQ(cv::countNonZero(dilated != expected), 0) << c.size << size_px << " " << anchor;
      }
    }
  }
}

TEST(Morphology, OutsideOfTheImageNeitherErodesNorDilates) {
  Morphology morphology(10, 10, 5);
  cv::Mat1b full(10, 10, std::uint8_t{255}), none(10, 10, std::uint8_t{0});
  morphology.erode(full, 5, 2);
  EXPECT_EQ(cv::countNonZero(full), 100);
  morphology.dilate(none, 5, 2);
  EXPECT_EQ(cv::countNonZero(none), 0);
}

}  // namespace
}  // namespace dodge

#include "dodge/detect/binomial_filter.h"

#include <gtest/gtest.h>

#include <array>
#include <opencv2/imgproc.hpp>

#include "tests/dodge/generator.h"

namespace dodge {
namespace {

// As sparse as an image of rho.
cv::Mat1f random_image(Generator& random, int width, int height) {
  cv::Mat1f image(height, width, 0.0F);
  for (float& pixel : image) {
    if (random.uniform(0, 1) < 0.3) pixel = static_cast<float>(random.uniform(-0.5, 0.5));
  }
  return image;
}

cv::Mat1f averaged(const cv::Mat1f& image, int size_px) {
  BinomialFilter filter(size_px, image.cols);
  cv::Mat1f out(image.size(), 7.0F);
  filter.apply(image, out);
  filter.apply(image, out);  // twice: nothing is left behind
  return out;
}

cv::Mat1f averaged_by_opencv(const cv::Mat1f& image, int size_px) {
  const cv::Mat1f pair(1, 2, 0.5F);
  cv::Mat1f kernel(1, 1, 1.0F);
  for (int size = 2; size <= size_px; ++size) {
    cv::Mat1f wider(1, size, 0.0F);
    for (int i = 0; i < size; ++i) {
      wider(0, i) = 0.5F * ((i > 0 ? kernel(0, i - 1) : 0) + (i + 1 < size ? kernel(0, i) : 0));
    }
    kernel = wider;
  }
  cv::Mat1f out;
  cv::sepFilter2D(image, out, CV_32F, kernel, kernel, {-1, -1}, 0, cv::BORDER_CONSTANT);
  return out;
}

TEST(BinomialFilter, EqualsOpencvToTheBitWhereWeightsArePowersOfTwo) {
  Generator random(1);
  for (const cv::Size size :
       {cv::Size(320, 240), cv::Size(37, 23), cv::Size(3, 2), cv::Size(1, 1)}) {
    const cv::Mat1f image = random_image(random, size.width, size.height);
    for (const int size_px : {1, 3}) {
      EXPECT_EQ(cv::countNonZero(averaged(image, size_px) != averaged_by_opencv(image, size_px)), 0)
          << size << " " << size_px;
    }
  }
}

// There, OpenCV fuses multiplications and additions on processors that can.
TEST(BinomialFilter, EqualsOpencvButForRoundingWithLargerKernels) {
  Generator random(2);
  for (const cv::Size size : {cv::Size(320, 240), cv::Size(37, 23), cv::Size(4, 3)}) {
    const cv::Mat1f image = random_image(random, size.width, size.height);
    for (const int size_px : {5, 7, 9, 15}) {
      EXPECT_LT(
          cv::norm(averaged(image, size_px), averaged_by_opencv(image, size_px), cv::NORM_INF),
          2e-7)
          << size << " " << size_px;
    }
  }
}

TEST(BinomialFilter, HasTheWeightsOfPascalsTriangle) {
  cv::Mat1f image(21, 21, 0.0F);
  image(10, 10) = 1;
  const cv::Mat1f out = averaged(image, 7);
  const std::array<float, 4> weights = {20.0F / 64, 15.0F / 64, 6.0F / 64, 1.0F / 64};
  for (int dy = -4; dy <= 4; ++dy) {
    for (int dx = -4; dx <= 4; ++dx) {
      const auto x = static_cast<std::size_t>(std::abs(dx)),
                 y = static_cast<std::size_t>(std::abs(dy));
      const float expected = x > 3 || y > 3 ? 0 : weights[x] * weights[y];
      EXPECT_EQ(out(10 + dy, 10 + dx), expected);
    }
  }
}

}  // namespace
}  // namespace dodge

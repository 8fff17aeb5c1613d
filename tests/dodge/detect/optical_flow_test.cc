#include "dodge/detect/optical_flow.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace dodge {
namespace {

// A smooth blob of rho; negative on its trailing side.
cv::Mat1f blob(double x0, double y0) {
  cv::Mat1f image(60, 80);
  for (int y = 0; y < image.rows; ++y) {
    for (int x = 0; x < image.cols; ++x) {
      const double dx = x - x0, dy = y - y0;
      image(y, x) =
          static_cast<float>(0.2 * (dx + 0.5 * dy) / 4 * std::exp(-(dx * dx + dy * dy) / (2 * 16)));
    }
  }
  return image;
}

TEST(OpticalFlow, MeasuresASmallDisplacement) {
  const cv::Mat1f before = blob(40, 30), now = blob(40.4, 29.7);
  OpticalFlow flow({});
  flow.set_images(before, now, 1);
  for (const cv::Point& pixel : {cv::Point(40, 30), cv::Point(43, 31), cv::Point(37, 28)}) {
    const Eigen::Vector2d v = flow.velocity(pixel);
    EXPECT_NEAR(v.x(), 0.4, 0.04);
    EXPECT_NEAR(v.y(), -0.3, 0.04);
  }
}

TEST(OpticalFlow, CountsPerEventWindow) {
  const cv::Mat1f before = blob(40, 30), now = blob(40.4, 29.7);
  OpticalFlow flow({});
  flow.set_images(before, now, 0.25);  // updates every quarter of a window
  EXPECT_NEAR(flow.velocity({40, 30}).x(), 1.6, 0.16);
}

TEST(OpticalFlow, IsZeroWhereItIsUndetermined) {
  const cv::Mat1f flat(60, 80, 0.1F);
  cv::Mat1f edge(60, 80, 0.0F), moved_edge(60, 80, 0.0F);
  edge.colRange(30, 80) = 0.3F;
  moved_edge.colRange(31, 80) = 0.3F;
  OpticalFlow flow({});
  flow.set_images(flat, flat, 1);
  EXPECT_EQ(flow.velocity({40, 30}), Eigen::Vector2d::Zero());
  flow.set_images(edge, moved_edge, 1);  // the aperture problem
  EXPECT_EQ(flow.velocity({30, 30}), Eigen::Vector2d::Zero());
  const cv::Mat1f before = blob(40, 30), now = blob(41, 30);
  flow.set_images(before, now, 0);  // no previous window
  EXPECT_EQ(flow.velocity({40, 30}), Eigen::Vector2d::Zero());
}

TEST(OpticalFlow, LimitsIncredibleVelocities) {
  const cv::Mat1f before = blob(40, 30), now = blob(41, 30);
  OpticalFlow flow({.max_px = 5});
  flow.set_images(before, now, 0.01);
  EXPECT_NEAR(flow.velocity({40, 30}).norm(), 5, 1e-9);
}

TEST(OpticalFlow, WorksAtTheBorder) {
  const cv::Mat1f before = blob(4, 4), now = blob(4.3, 4.2);
  OpticalFlow flow({});
  flow.set_images(before, now, 1);
  for (const cv::Point& corner :
       {cv::Point(0, 0), cv::Point(79, 0), cv::Point(0, 59), cv::Point(79, 59)}) {
    EXPECT_TRUE(flow.velocity(corner).allFinite());
  }
  EXPECT_NEAR(flow.velocity({4, 4}).x(), 0.3, 0.06);
}

TEST(OpticalFlow, AveragesOverThePixelsOfAGroup) {
  const cv::Mat1f before = blob(40, 30), now = blob(40.4, 29.7);
  OpticalFlow flow({.samples = 4});
  flow.set_images(before, now, 1);
  std::vector<cv::Point> pixels;
  pixels.reserve(11);
  for (int i = 0; i < 10; ++i) pixels.emplace_back(36 + i, 30);
  pixels.emplace_back(5, 5);  // undetermined there
  const Eigen::Vector2d v = flow.mean_velocity(pixels);
  EXPECT_NEAR(v.x(), 0.4, 0.05);
  EXPECT_NEAR(v.y(), -0.3, 0.05);
  EXPECT_EQ(flow.mean_velocity({}), Eigen::Vector2d::Zero());
}

TEST(OpticalFlow, AveragesOverNoMoreThanTheSetNumberOfPixels) {
  const cv::Mat1f before = blob(40, 30), now = blob(40.4, 29.7);
  OpticalFlow flow({.samples = 16});
  flow.set_images(before, now, 1);
  // 31 pixels: every second one, from the middle of the first two.
  std::vector<cv::Point> pixels;
  Eigen::Vector2d of_all = Eigen::Vector2d::Zero(), of_every_second = Eigen::Vector2d::Zero();
  for (int i = 0; i < 31; ++i) {
    pixels.emplace_back(36 + i % 8, 28 + i / 8);
    const Eigen::Vector2d v = flow.velocity(pixels.back());
    ASSERT_FALSE(v.isZero(0));
    of_all += v / 31;
    if (i % 2 == 1) of_every_second += v / 15;
  }
  EXPECT_GT((of_all - of_every_second).norm(), 1e-6);
  EXPECT_TRUE(flow.mean_velocity(pixels).isApprox(of_every_second, 1e-12));
}

}  // namespace
}  // namespace dodge

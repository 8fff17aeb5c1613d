#include "dodge/detect/time_image.h"

#include <gtest/gtest.h>

namespace dodge {
namespace {

constexpr int kColumns = 40;
constexpr int kRows = 30;

Event at(int x, int y, TimeUs t_us) {
  return {.t_us = t_us, .x = static_cast<std::uint16_t>(x), .y = static_cast<std::uint16_t>(y)};
}

TimeImageConfig plain() {
  return {.threshold_a_s = 0,
          .threshold_b = 0.1,
          .blur_px = 1,
          .open_px = 0,
          .close_px = 0,
          .dilate_px = 0};
}

class TimeImageTest : public ::testing::Test {
 protected:
  static CameraModel camera() { return {.width = kColumns, .height = kRows, .cx = 20, .cy = 15}; }

  // The window is (0, 10000].
  void process(TimeImage& image, const std::vector<Event>& events, double rate_radps = 0) {
    const std::span<const Event> all(events);
    const std::array<std::span<const Event>, 2> pieces = {all.first(events.size() / 2),
                                                          all.subspan(events.size() / 2)};
    image.accumulate(pieces, still_, 0, 10000);
    image.threshold(rate_radps);
    image.clean();
  }

  EgoMotion still_{{}, camera()};
};

TEST_F(TimeImageTest, CountsAveragesAndNormalisesAsIn2To4) {
  TimeImage image(plain(), kColumns, kRows);
  process(image, {at(5, 6, 1000), at(5, 6, 3000), at(7, 8, 6000), at(9, 9, 10000)});
  // T = 0.2, 0.6, 1.0 of the window; their mean over the three active pixels is 0.6.
  EXPECT_EQ(image.count()(6, 5), 2);
  EXPECT_EQ(image.count()(8, 7), 1);
  EXPECT_NEAR(image.rho()(6, 5), -0.4, 1e-6);
  EXPECT_NEAR(image.rho()(8, 7), 0.0, 1e-6);
  EXPECT_NEAR(image.rho()(9, 9), 0.4, 1e-6);
  EXPECT_EQ(cv::countNonZero(image.rho()), 2);
  EXPECT_EQ(cv::countNonZero(image.threshold_mask()), 1);
  EXPECT_EQ(image.threshold_mask()(9, 9), 255);
}

TEST_F(TimeImageTest, OfAPixelThatFiresWithoutEndTakesAsManyAsItCanCount) {
  TimeImage image(plain(), kColumns, kRows);
  std::vector<Event> events(70000, at(5, 6, 5000));
  events.push_back(at(7, 8, 5000));
  process(image, events);
  EXPECT_EQ(image.count()(6, 5), 65535);
  EXPECT_NEAR(image.mean_time(), 0.5, 1e-3);
}

TEST_F(TimeImageTest, ForgetsTheWindowBefore) {
  TimeImage image(plain(), kColumns, kRows);
  process(image, {at(5, 6, 1000), at(5, 6, 9000), at(7, 8, 6000)});
  process(image, {at(1, 1, 2000), at(2, 2, 8000)});
  EXPECT_EQ(cv::countNonZero(image.count()), 2);
  EXPECT_NEAR(image.rho()(2, 2), 0.3, 1e-6);
  process(image, {});
  EXPECT_EQ(cv::countNonZero(image.count()), 0);
  EXPECT_EQ(cv::countNonZero(image.rho()), 0);
  EXPECT_EQ(cv::countNonZero(image.threshold_mask()), 0);
}

TEST_F(TimeImageTest, ThresholdGrowsWithTheAngularRate) {
  TimeImageConfig config = plain();
  config.threshold_a_s = 0.1;
  TimeImage image(config, kColumns, kRows);
  const std::vector<Event> events = {at(5, 6, 1000), at(7, 8, 7000)};  // rho -0.3, 0.3
  process(image, events, 1.9);
  EXPECT_EQ(cv::countNonZero(image.threshold_mask()), 1);
  process(image, events, 2.1);
  EXPECT_EQ(cv::countNonZero(image.threshold_mask()), 0);
}

TEST_F(TimeImageTest, WithoutAThresholdEmptyPixelsAreNoObstacle) {
  TimeImageConfig config = plain();
  config.threshold_b = 0;
  TimeImage image(config, kColumns, kRows);
  process(image, {at(5, 6, 1000), at(7, 8, 9000)});
  EXPECT_EQ(cv::countNonZero(image.threshold_mask()), 1);
  EXPECT_EQ(image.threshold_mask()(8, 7), 255);
}

TEST_F(TimeImageTest, AveragingKeepsTheSumAndTreatsEmptyPixelsAsNeutral) {
  TimeImageConfig config = plain();
  config.blur_px = 5;
  TimeImage image(config, kColumns, kRows);
  process(image, {at(10, 10, 1000), at(25, 20, 9000)});
  EXPECT_NEAR(cv::sum(image.averaged()(cv::Rect(20, 15, 11, 11)))[0], 0.4, 1e-5);
  EXPECT_NEAR(image.averaged()(20, 25), 0.4 * 36.0 / 256.0, 1e-5);  // binomial 1 4 6 4 1
  EXPECT_NEAR(image.averaged()(20, 27), 0.4 * 6.0 / 256.0, 1e-5);
  EXPECT_EQ(image.averaged()(0, 0), 0);
}

TEST_F(TimeImageTest, KeepsTheAveragedImageOfTheWindowBefore) {
  TimeImage image(plain(), kColumns, kRows);
  process(image, {at(5, 6, 1000), at(7, 8, 7000)});
  const cv::Mat1f first = image.averaged().clone();
  process(image, {at(15, 6, 1000), at(17, 8, 7000)});
  EXPECT_EQ(cv::countNonZero(image.previous_averaged() != first), 0);
}

TEST_F(TimeImageTest, OpeningRemovesALineAndKeepsABlock) {
  TimeImageConfig config = plain();
  config.open_px = 3;
  TimeImage image(config, kColumns, kRows);
  std::vector<Event> events;
  events.reserve(100);
  for (int i = 0; i < 20; ++i) events.push_back(at(i, 29, 1000));
  for (int y = 2; y < 20; ++y) events.push_back(at(3, y, 9000));
  for (int y = 10; y < 14; ++y) {
    for (int x = 20; x < 24; ++x) events.push_back(at(x, y, 9000));
  }
  process(image, events);
  EXPECT_EQ(cv::countNonZero(image.threshold_mask()), 18 + 16);
  EXPECT_EQ(cv::countNonZero(image.obstacle_mask()), 16);
}

TEST_F(TimeImageTest, EvenKernelsLeaveTheMaskInPlace) {
  std::vector<Event> events;
  events.reserve(100);
  for (int i = 0; i < 20; ++i) events.push_back(at(i, 29, 1000));
  for (int y = 10; y < 14; ++y) {
    for (int x = 20; x < 24; ++x) events.push_back(at(x, y, 9000));
  }
  TimeImageConfig config = plain();
  config.open_px = 2;
  TimeImage opened(config, kColumns, kRows);
  process(opened, events);
  EXPECT_EQ(cv::countNonZero(opened.obstacle_mask() != opened.threshold_mask()), 0);
  config.open_px = 0;
  config.close_px = 4;
  TimeImage closed(config, kColumns, kRows);
  process(closed, events);
  EXPECT_EQ(cv::countNonZero(closed.obstacle_mask() != closed.threshold_mask()), 0);
}

TEST_F(TimeImageTest, ClosingAndDilationFillAndGrow) {
  TimeImageConfig config = plain();
  config.close_px = 3;
  TimeImage closed(config, kColumns, kRows);
  config.dilate_px = 3;
  TimeImage dilated(config, kColumns, kRows);
  const std::vector<Event> events = {at(5, 5, 1000), at(20, 10, 9000), at(22, 10, 9000)};
  process(closed, events);
  EXPECT_EQ(cv::countNonZero(closed.obstacle_mask()), 3);  // the gap is filled
  process(dilated, events);
  EXPECT_EQ(cv::countNonZero(dilated.obstacle_mask()), 15);
}

TEST_F(TimeImageTest, DropsEventsOutsideOfTheImageBeforeAndAfterTheWarp) {
  TimeImage image(plain(), kColumns, kRows);
  process(image, {at(kColumns, 3, 1000), at(3, kRows, 2000), at(65535, 65535, 3000)});
  EXPECT_EQ(cv::countNonZero(image.count()), 0);

  EgoMotion fast({}, camera());
  fast.set_motion({0, 30, 0}, 0, 10000);  // 0.3 rad: some 60 px
  const std::vector<Event> events = {at(0, 5, 1), at(39, 5, 1), at(39, 5, 10000)};
  const std::array<std::span<const Event>, 1> pieces = {std::span<const Event>(events)};
  image.accumulate(pieces, fast, 0, 10000);
  EXPECT_EQ(cv::sum(image.count())[0], 1);
  EXPECT_EQ(image.count()(5, 39), 1);
}

}  // namespace
}  // namespace dodge

#include "dodge/detect/cluster.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "sim/base/random.h"

namespace dodge {
namespace {

constexpr int kWidth = 120;
constexpr int kHeight = 90;

// An image whose obstacle mask is exactly the given pixels, each with `events` events, all with the
// rho of their time; as many early pixels in the corner keep the mean in the middle.
class MaskImage {
 public:
  MaskImage()
      : image_({.threshold_a_s = 0,
                .threshold_b = 0.01,
                .blur_px = 1,
                .open_px = 0,
                .close_px = 0,
                .dilate_px = 0},
               kWidth, kHeight) {}

  void add(int x, int y, TimeUs t_us = 10000, int events = 2) {
    for (int i = 0; i < events; ++i) {
      events_.push_back(
          {.t_us = t_us, .x = static_cast<std::uint16_t>(x), .y = static_cast<std::uint16_t>(y)});
    }
    const int n = early_++;
    events_.push_back({.t_us = 0,
                       .x = static_cast<std::uint16_t>(n % kWidth),
                       .y = static_cast<std::uint16_t>(kHeight - 1 - n / kWidth)});
  }

  void add_block(int x0, int y0, int width, int height, TimeUs t_us = 10000) {
    for (int y = y0; y < y0 + height; ++y) {
      for (int x = x0; x < x0 + width; ++x) add(x, y, t_us);
    }
  }

  const TimeImage& build() {
    const CameraModel camera{.width = kWidth, .height = kHeight, .cx = 60, .cy = 45};
    const EgoMotion still({}, camera);
    const std::array<std::span<const Event>, 1> pieces = {std::span<const Event>(events_)};
    image_.accumulate(pieces, still, 0, 10000);
    image_.threshold(0);
    image_.clean();
    return image_;
  }

 private:
  TimeImage image_;
  std::vector<Event> events_;
  int early_ = 0;
};

std::vector<Cluster> find(MaskImage& image, const ClusterConfig& config) {
  Clusterer clusterer(config, kWidth, kHeight);
  OpticalFlow flow({});
  const TimeImage& built = image.build();
  flow.set_images(built.averaged(), built.averaged(), 0);
  clusterer.find(built, flow);
  return clusterer.find(built, flow);  // twice: nothing is left behind
}

// Pre-clusters only.
ClusterConfig separate() {
  return {.min_group_pixels = 1, .eps = 0, .min_pixels = 1, .min_events = 1, .max_aspect = 1000};
}

TEST(RectangleDistance, AgreesWithABruteForceSearch) {
  dodgesim::RandomStream random(3, 0, "rectangles");
  for (int trial = 0; trial < 200; ++trial) {
    std::array<cv::RotatedRect, 2> r;
    for (cv::RotatedRect& one : r) {
      one = cv::RotatedRect(cv::Point2f(static_cast<float>(random.uniform(0, 30)),
                                        static_cast<float>(random.uniform(0, 30))),
                            cv::Size2f(static_cast<float>(random.uniform(0.5, 15)),
                                       static_cast<float>(random.uniform(0.5, 15))),
                            static_cast<float>(random.uniform(0, 90)));
    }
    // Points inside of one in the axes of the other.
    double nearest = 1e9;
    const auto point = [](const cv::RotatedRect& q, double a, double b) {
      const double angle = q.angle * CV_PI / 180;
      const double dx = a * q.size.width, dy = b * q.size.height;
      return Eigen::Vector2d(q.center.x + dx * std::cos(angle) - dy * std::sin(angle),
                             q.center.y + dx * std::sin(angle) + dy * std::cos(angle));
    };
    const double angle = r[1].angle * CV_PI / 180;
    for (int i = 0; i <= 100; ++i) {
      for (int k = 0; k <= 100; ++k) {
        const Eigen::Vector2d d = point(r[0], 0.01 * i - 0.5, 0.01 * k - 0.5) -
                                  Eigen::Vector2d(r[1].center.x, r[1].center.y);
        const double u = std::abs(d.x() * std::cos(angle) + d.y() * std::sin(angle));
        const double v = std::abs(-d.x() * std::sin(angle) + d.y() * std::cos(angle));
        nearest = std::min(nearest, std::hypot(std::max(0.0, u - 0.5 * r[1].size.width),
                                               std::max(0.0, v - 0.5 * r[1].size.height)));
      }
    }
    EXPECT_NEAR(rectangle_distance(r[0], r[1]), nearest, 0.08);
    EXPECT_NEAR(rectangle_distance(r[0], r[1]), rectangle_distance(r[1], r[0]), 1e-4);
    if (nearest == 0) {
      EXPECT_EQ(rectangle_distance(r[0], r[1]), 0);
    }
  }
}

TEST(RectangleDistance, IsZeroWhenOneContainsTheOtherAndWhenTheyCross) {
  const cv::RotatedRect outer({10, 10}, {20, 20}, 30), inner({11, 9}, {2, 2}, 10);
  const cv::RotatedRect bar({10, 10}, {60, 2}, 0);
  EXPECT_EQ(rectangle_distance(outer, inner), 0);
  EXPECT_EQ(rectangle_distance(outer, bar), 0);
}

TEST(Clusterer, ConnectsDiagonalsAndSeparatesWhatDoesNotTouch) {
  MaskImage image;
  for (int i = 0; i < 5; ++i) image.add(10 + i, 10 + i);
  image.add_block(40, 10, 4, 3);
  image.add_block(0, 0, 2, 2);    // touches the border
  image.add_block(45, 10, 2, 2);  // one empty column between
  const std::vector<Cluster> clusters = find(image, separate());
  ASSERT_EQ(clusters.size(), 4U);
  EXPECT_EQ(clusters[0].pixels, 4);
  EXPECT_EQ(clusters[1].pixels, 5);
  EXPECT_EQ(clusters[2].pixels, 12);
  EXPECT_EQ(clusters[3].pixels, 4);
  EXPECT_EQ(clusters[2].events, 24);
}

TEST(Clusterer, FollowsAGroupUpAndToTheLeft) {
  MaskImage image;
  for (int i = 0; i < 10; ++i) {
    image.add(20 + i, 20 + i);  // down to the right ...
    image.add(40 - i, 20 + i);  // ... and up again
    image.add(20 - i, 30 + i);  // a tail that leaves to the left
  }
  image.add(30, 30);
  image.add(21, 29);
  for (int x = 22; x < 30; ++x) image.add(x, 30);
  const std::vector<Cluster> clusters = find(image, separate());
  ASSERT_EQ(clusters.size(), 1U);
  EXPECT_EQ(clusters[0].pixels, 40);
}

TEST(Clusterer, RectangleCoversWholePixels) {
  MaskImage image;
  image.add_block(40, 20, 8, 4);
  const std::vector<Cluster> clusters = find(image, separate());
  ASSERT_EQ(clusters.size(), 1U);
  const cv::RotatedRect& r = clusters[0].rectangle;
  EXPECT_NEAR(r.center.x, 43.5, 1e-3);
  EXPECT_NEAR(r.center.y, 21.5, 1e-3);
  const cv::Rect2f box = r.boundingRect2f();  // from the outer edges of its outermost pixels
  EXPECT_NEAR(box.x, 39.5, 1e-3);
  EXPECT_NEAR(box.y, 19.5, 1e-3);
  EXPECT_NEAR(box.width, 8, 1e-3);
  EXPECT_NEAR(box.height, 4, 1e-3);
  EXPECT_NEAR(clusters[0].centroid.x(), 43.5, 1e-9);
  EXPECT_NEAR(clusters[0].rho, 0.5, 1e-6);
  EXPECT_NEAR(clusters[0].time, 1, 1e-6);  // its events are the window's last
}

TEST(Clusterer, RectangleFollowsASlantedObject) {
  MaskImage image;
  for (int i = 0; i < 20; ++i) {
    for (int k = 0; k < 4; ++k) image.add(30 + i, 20 + i + k);
  }
  const std::vector<Cluster> clusters = find(image, separate());
  ASSERT_EQ(clusters.size(), 1U);
  cv::Point2f corners[4];
  clusters[0].rectangle.points(corners);
  double along_least = 1e9, along_most = -1e9, across_least = 1e9, across_most = -1e9;
  for (const cv::Point2f& c : corners) {
    const double along = (c.x + c.y) / std::numbers::sqrt2;  // down to the right
    const double across = (c.y - c.x) / std::numbers::sqrt2;
    along_least = std::min(along_least, along), along_most = std::max(along_most, along);
    across_least = std::min(across_least, across), across_most = std::max(across_most, across);
  }
  EXPECT_NEAR(along_most - along_least, 41 / std::numbers::sqrt2 + 1, 0.5);
  EXPECT_NEAR(across_most - across_least, 3 / std::numbers::sqrt2 + 1, 0.5);
  EXPECT_EQ(clusters[0].top_row, 19.5);  // the rectangle's corners go beyond
  EXPECT_EQ(clusters[0].bottom_row, 42.5);
}

TEST(Clusterer, MergesNearGroupsOfLikeRhoOnly) {
  ClusterConfig config = separate();
  config.eps = 3;
  config.weight_position_1ppx = 0.2;
  MaskImage image;
  image.add_block(20, 20, 5, 5, 10000);
  image.add_block(34, 22, 5, 5, 10000);  // 9 px away: cost 0.2 * 9 = 1.8
  image.add_block(53, 20, 5, 5, 10000);  // 14 px away: 2.8
  image.add_block(76, 20, 5, 5, 10000);  // 18 px away: 3.6
  image.add_block(20, 34, 5, 5, 7500);   // 9 px away, but rho differs by 0.25: 5.5
  const std::vector<Cluster> clusters = find(image, config);
  ASSERT_EQ(clusters.size(), 3U);
  EXPECT_EQ(clusters[0].pixels, 75);
  EXPECT_NEAR(clusters[0].rectangle.center.x, 38.5, 1e-3);
  EXPECT_EQ(clusters[0].top_row, 19.5);
  EXPECT_EQ(clusters[0].bottom_row, 26.5);
  EXPECT_NEAR(clusters[0].centroid.x(), (22 + 36 + 55) / 3.0, 1e-6);
  EXPECT_EQ(clusters[1].pixels, 25);
  EXPECT_EQ(clusters[2].pixels, 25);
}

TEST(Clusterer, LoneGroupsAreNoiseWhenACoreNeedsNeighbours) {
  ClusterConfig config = separate();
  config.eps = 2;
  config.weight_position_1ppx = 0.2;  // 10 px
  config.min_points = 3;
  MaskImage image;
  for (int i = 0; i < 4; ++i) image.add_block(10 + 12 * i, 20, 4, 4);  // a chain of four
  image.add_block(90, 20, 4, 4);                                       // alone
  image.add_block(90, 32, 4, 4);                                       // a pair: still no core
  const std::vector<Cluster> clusters = find(image, config);
  ASSERT_EQ(clusters.size(), 1U);
  EXPECT_EQ(clusters[0].pixels, 64);  // the chain's ends are border points of its cores
}

TEST(Clusterer, DropsSmallClustersAndLongEdges) {
  MaskImage image;
  image.add_block(10, 10, 3, 3);
  image.add_block(30, 10, 2, 2);
  image.add_block(50, 10, 40, 3);
  ClusterConfig config = separate();
  config.min_pixels = 6;
  config.max_aspect = 4;
  EXPECT_EQ(find(image, config).size(), 1U);
  config.min_events = 19;  // the block has 18
  EXPECT_EQ(find(image, config).size(), 0U);
  config = separate();
  config.min_group_pixels = 5;
  EXPECT_EQ(find(image, config).size(), 2U);
}

TEST(Clusterer, KeepsTheGroupsWithMostEventsWhenThereAreTooMany) {
  MaskImage image;
  for (int i = 0; i < 20; ++i) image.add_block(4 * i, 10, 2, 1 + i % 3);
  ClusterConfig config = separate();
  config.max_groups = 6;
  const std::vector<Cluster> clusters = find(image, config);
  ASSERT_EQ(clusters.size(), 6U);
  for (const Cluster& cluster : clusters) EXPECT_EQ(cluster.pixels, 6);
}

TEST(Clusterer, CostIs6) {
  const Clusterer clusterer({.weight_position_1ppx = 2, .weight_velocity_1ppx = 3, .weight_rho = 5},
                            10, 10);
  Cluster a, b;
  a.rectangle = {{0, 0}, {2, 2}, 0};
  b.rectangle = {{10, 0}, {4, 2}, 0};
  a.velocity = {1, 1};
  b.velocity = {4, 5};
  a.rho = 0.3;
  b.rho = 0.1;
  EXPECT_NEAR(clusterer.cost(a, b), 2 * 7 + 3 * 5 + 5 * 0.2, 1e-5);
}

}  // namespace
}  // namespace dodge

#include "dodge/detect/min_area_rectangle.h"

#include <gtest/gtest.h>

#include <opencv2/imgproc.hpp>

#include "tests/dodge/generator.h"

namespace dodge {
namespace {

using Points = std::vector<cv::Point2f>;

// Other versions order the hull in another way, other processors round in another way.
bool comparable() {
#if defined(__x86_64__)
  return CV_VERSION_MAJOR == 4 && CV_VERSION_MINOR == 6;
#else
  return false;
#endif
}

// As OpenCV, to the bit.
void expect_same(MinAreaRectangle& finder, const Points& points) {
  if (!comparable()) GTEST_SKIP() << "OpenCV " << CV_VERSION;
  const cv::RotatedRect own = finder.around(points), expected = cv::minAreaRect(points);
  ASSERT_TRUE(own.center == expected.center && own.size == expected.size &&
              own.angle == expected.angle)
      << own.center << own.size << own.angle << " differs from " << expected.center << expected.size
      << expected.angle << " around " << points;
}

int whole(Generator& random, int low, int high) {  // below high
  return static_cast<int>(std::floor(random.uniform(low, high)));
}

// The ends of the rows of a group of pixels, as a cluster's outline.
void add_outline(Generator& random, int most_rows, Points& points) {
  const int rows = whole(random, 1, most_rows + 1), top = whole(random, 0, 200);
  const int middle = whole(random, 30, 290);
  const double radius = 0.5 * rows;
  for (int row = 0; row < rows; ++row) {
    const double dy = row + 0.5 - radius;
    const int half = static_cast<int>(std::sqrt(std::max(0.0, radius * radius - dy * dy)));
    const int left = middle - half - whole(random, 0, 3);
    const int right = std::max(left, middle + half - whole(random, 0, 3));
    points.emplace_back(static_cast<float>(left), static_cast<float>(top + row));
    points.emplace_back(static_cast<float>(right), static_cast<float>(top + row));
  }
}

TEST(MinAreaRectangle, EqualsOpencvAroundOutlinesOfPixels) {
  Generator random(1);
  MinAreaRectangle finder(1);  // grows
  for (int trial = 0; trial < 20000; ++trial) {
    Points points;
    for (int groups = whole(random, 1, 4); groups > 0; --groups) {
      add_outline(random, trial % 2 == 0 ? 6 : 40, points);
    }
    expect_same(finder, points);
  }
}

TEST(MinAreaRectangle, EqualsOpencvAroundPointsAnywhere) {
  Generator random(2);
  MinAreaRectangle finder(50);
  for (int trial = 0; trial < 10000; ++trial) {
    Points points(static_cast<std::size_t>(whole(random, 1, 50)));
    for (cv::Point2f& p : points) {
      p = {static_cast<float>(random.uniform(0, 320)), static_cast<float>(random.uniform(0, 240))};
    }
    expect_same(finder, points);
  }
}

// Parallel sides: several rectangles have the same area but for rounding.
TEST(MinAreaRectangle, EqualsOpencvAroundTwoRectangles) {
  Generator random(3);
  MinAreaRectangle finder(8);
  for (int trial = 0; trial < 20000; ++trial) {
    Points points;
    const auto angle_deg = static_cast<float>(random.uniform(-180, 180));
    for (int i = 0; i < 2; ++i) {
      const cv::Point2f centre(static_cast<float>(random.uniform(0, 20)),
                               static_cast<float>(random.uniform(0, 20)));
      const auto other_deg = static_cast<float>(random.uniform(-180, 180));
      const cv::RotatedRect one(
          centre,
          {static_cast<float>(whole(random, 1, 20)), static_cast<float>(whole(random, 1, 20))},
          trial % 2 == 0 ? angle_deg : other_deg);
      std::array<cv::Point2f, 4> corners;
      one.points(corners.data());
      points.insert(points.end(), corners.begin(), corners.end());
    }
    expect_same(finder, points);
  }
}

TEST(MinAreaRectangle, OfPointsOnALineHasNoHeight) {
  MinAreaRectangle finder(10);
  for (const Points& points :
       {Points{{3, 4}}, Points{{3, 4}, {3, 4}, {3, 4}}, Points{{0, 0}, {5, 0}, {3, 0}},
        Points{{0, 7}, {0, 2}, {0, 2}}, Points{{1, 1}, {2, 2}, {4, 4}, {3, 3}}}) {
    expect_same(finder, points);
    EXPECT_EQ(finder.around(points).size.height, 0);
  }
  EXPECT_EQ(finder.around(Points{{3, 4}, {3, 4}}).center, cv::Point2f(3, 4));
  EXPECT_NEAR(finder.around(Points{{1, 1}, {2, 2}, {4, 4}}).size.width, std::sqrt(18), 1e-6);
}

TEST(MinAreaRectangle, IsSmallerThanAnyOtherAroundThePoints) {
  Generator random(4);
  MinAreaRectangle finder(100);
  for (int trial = 0; trial < 200; ++trial) {
    Points points;
    add_outline(random, 20, points);
    points.emplace_back(static_cast<float>(random.uniform(0, 320)), 100.0F);
    const cv::RotatedRect found = finder.around(points);
    double least = 1e9;
    for (int i = 0; i < 9000; ++i) {
      const double angle = i * CV_PI / 18000;
      double u0 = 1e9, u1 = -1e9, v0 = 1e9, v1 = -1e9;
      for (const cv::Point2f& p : points) {
        const double u = p.x * std::cos(angle) + p.y * std::sin(angle);
        const double v = -p.x * std::sin(angle) + p.y * std::cos(angle);
        u0 = std::min(u0, u), u1 = std::max(u1, u), v0 = std::min(v0, v), v1 = std::max(v1, v);
      }
      least = std::min(least, (u1 - u0) * (v1 - v0));
    }
    EXPECT_LE(found.size.area(), least * (1 + 1e-6) + 1e-3);
    cv::Point2f corners[4];
    found.points(corners);
    const std::vector<cv::Point2f> outline(corners, corners + 4);
    for (const cv::Point2f& p : points) {
      EXPECT_GT(cv::pointPolygonTest(outline, p, true), -0.01);
    }
  }
}

}  // namespace
}  // namespace dodge

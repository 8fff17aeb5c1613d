// The smallest rectangle around points in the image: convex hull by monotone chains (Andrew 1979),
// then rotating calipers (Toussaint 1983). Not cv::minAreaRect, which allocates in every call.
#pragma once

#include <algorithm>
#include <array>
#include <opencv2/core.hpp>
#include <span>
#include <vector>

namespace dodge {

inline float longer_side(const cv::RotatedRect& r) { return std::max(r.size.width, r.size.height); }

class MinAreaRectangle {
 public:
  // Memory is allocated here, and later only for more than max_points points.
  explicit MinAreaRectangle(std::size_t max_points);

  // A rectangle with a side along an edge of the hull; the last one that the calipers meet if
  // several have the least area. Points on a line give a height of 0, a single one a width of 0,
  // too. Requires at least one point.
  //
  // The calipers start and calculate as those of OpenCV 4.6: the rectangle is that of
  // cv::minAreaRect, to the bit. Only where points coincide that do not follow one another may the
  // choice among several be another one.
  cv::RotatedRect around(std::span<const cv::Point2f> points);

 private:
  struct Vertex {
    cv::Point2f p;
    std::size_t index;  // of the point
  };
  // The vertices that the sides touch: least y, greatest x, greatest y, least x at the start.
  using Touched = std::array<std::size_t, 4>;

  void find_hull(std::span<const cv::Point2f> points);
  template <class Iterator>
  void add_chain(Iterator begin, Iterator end);
  void choose_start();
  cv::RotatedRect turn_calipers() const;
  Touched extremes() const;
  std::size_t next_side(const Touched& touched) const;
  cv::Point2f edge(std::size_t vertex) const;

  std::vector<Vertex> sorted_;  // by x, then y
  std::vector<Vertex> hull_;    // in the direction in which x turns to y
};

}  // namespace dodge

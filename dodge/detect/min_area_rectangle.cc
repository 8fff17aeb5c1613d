#include "dodge/detect/min_area_rectangle.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <tuple>

namespace dodge {

namespace {

// Positive if the way from a over b to c turns in the direction in which x turns to y.
double turn(const cv::Point2f& a, const cv::Point2f& b, const cv::Point2f& c) {
  const cv::Point2f ab = b - a, bc = c - b;
  return static_cast<double>(ab.x) * bc.y - static_cast<double>(ab.y) * bc.x;
}

// v turned by right angles in that direction.
cv::Point2f turned(const cv::Point2f& v, std::size_t right_angles) {
  switch (right_angles % 4) {
    case 1:
      return {-v.y, v.x};
    case 2:
      return {-v.x, -v.y};
    case 3:
      return {v.y, -v.x};
    default:
      return v;
  }
}

double length(const cv::Point2f& v) {
  const double x = v.x, y = v.y;
  return std::sqrt(x * x + y * y);
}

cv::RotatedRect rectangle(const cv::Point2f& centre, const cv::Point2f& along_width,
                          const cv::Point2f& along_height) {
  const auto angle_rad = static_cast<float>(
      std::atan2(static_cast<double>(along_width.y), static_cast<double>(along_width.x)));
  return {centre,
          {static_cast<float>(length(along_width)), static_cast<float>(length(along_height))},
          static_cast<float>(angle_rad * 180.0F / CV_PI)};
}

}  // namespace

MinAreaRectangle::MinAreaRectangle(std::size_t max_points) {
  sorted_.reserve(max_points);
  hull_.reserve(max_points + 1);  // the chains share a vertex
}

cv::RotatedRect MinAreaRectangle::around(std::span<const cv::Point2f> points) {
  find_hull(points);
  if (hull_.size() > 2) return turn_calipers();
  const cv::Point2f a = hull_.front().p, b = hull_.back().p;
  return rectangle((a + b) * 0.5F, b - a, {0, 0});
}

void MinAreaRectangle::find_hull(std::span<const cv::Point2f> points) {
  sorted_.clear();
  for (std::size_t i = 0; i < points.size(); ++i) sorted_.push_back({points[i], i});
  std::sort(sorted_.begin(), sorted_.end(), [](const Vertex& a, const Vertex& b) {
    return std::tie(a.p.x, a.p.y, a.index) < std::tie(b.p.x, b.p.y, b.index);
  });
  hull_.clear();
  if (sorted_.front().p == sorted_.back().p) {
    hull_.push_back(sorted_.front());
    return;
  }
  add_chain(sorted_.rbegin(), sorted_.rend());
  add_chain(sorted_.begin(), sorted_.end());
  choose_start();
}

// Appends one side of the hull, without its last vertex: the other side begins there.
template <class Iterator>
void MinAreaRectangle::add_chain(Iterator begin, Iterator end) {
  const std::size_t first = hull_.size();
  for (; begin != end; ++begin) {
    while (hull_.size() >= first + 2 &&
           turn(hull_[hull_.size() - 2].p, hull_.back().p, begin->p) <= 0) {
      hull_.pop_back();
    }
    hull_.push_back(*begin);
  }
  hull_.pop_back();
}

// The rightmost vertex is the first, or, where the vertices follow one another as in `points`
// forwards (backwards), the first (last) of the points.
void MinAreaRectangle::choose_start() {
  if (hull_.size() < 3) return;
  const auto earlier = [](const Vertex& a, const Vertex& b) { return a.index < b.index; };
  std::size_t forwards = earlier(hull_.back(), hull_.front()) ? 1 : 0;
  for (std::size_t i = 1; i < hull_.size(); ++i) {
    forwards += earlier(hull_[i - 1], hull_[i]) ? 1 : 0;
  }
  if (forwards == hull_.size() - 1) {
    std::rotate(hull_.begin(), std::min_element(hull_.begin(), hull_.end(), earlier), hull_.end());
  } else if (forwards == 1) {
    std::rotate(hull_.begin(), std::max_element(hull_.begin(), hull_.end(), earlier), hull_.end());
  }
}

cv::Point2f MinAreaRectangle::edge(std::size_t vertex) const {
  return hull_[vertex + 1 == hull_.size() ? 0 : vertex + 1].p - hull_[vertex].p;
}

MinAreaRectangle::Touched MinAreaRectangle::extremes() const {
  Touched at{};
  for (std::size_t i = 1; i < hull_.size(); ++i) {
    const cv::Point2f& p = hull_[i].p;
    if (p.y < hull_[at[0]].p.y) at[0] = i;
    if (p.x > hull_[at[1]].p.x) at[1] = i;
    if (p.y > hull_[at[2]].p.y) at[2] = i;
    if (p.x < hull_[at[3]].p.x) at[3] = i;
  }
  return at;
}

// The side that meets an edge first when all four turn.
std::size_t MinAreaRectangle::next_side(const Touched& touched) const {
  std::size_t next = 0;
  cv::Point2f nearest = edge(touched[0]);
  for (std::size_t side = 1; side < 4; ++side) {
    const cv::Point2f other = turned(edge(touched[side]), 4 - side);
    if (other.y * nearest.x - other.x * nearest.y >= 0) continue;
    next = side;
    nearest = other;
  }
  return next;
}

cv::RotatedRect MinAreaRectangle::turn_calipers() const {
  Touched touched = extremes();
  cv::Point2f u, left, bottom;  // u: along the width, of length 1 but for rounding
  float width = 0, height = 0, least_area = std::numeric_limits<float>::max();
  for (std::size_t i = 0; i < hull_.size(); ++i) {
    const std::size_t side = next_side(touched);
    const cv::Point2f met = edge(touched[side]);
    const cv::Point2f u_now = turned(met * static_cast<float>(1 / length(met)), 4 - side);
    touched[side] = (touched[side] + 1) % hull_.size();

    const auto corner = [&](std::size_t k) { return hull_[touched[k]].p; };
    const float width_now = (corner(1) - corner(3)).dot(u_now);
    const float height_now = (corner(2) - corner(0)).dot(turned(u_now, 1));
    if (width_now * height_now > least_area) continue;
    least_area = width_now * height_now;
    std::tie(u, width, height) = std::tie(u_now, width_now, height_now);
    left = corner(3);
    bottom = corner(0);
  }
  // The corner where the sides through `left` and through `bottom` meet.
  const cv::Point2f v = turned(u, 1);
  const float along_u = u.dot(left), along_v = v.dot(bottom), scale = 1 / u.dot(u);
  const cv::Point2f corner((along_u * u.x - along_v * u.y) * scale,
                           (along_u * u.y + along_v * u.x) * scale);
  return rectangle(corner + (u * width + v * height) * 0.5F, u * width, v * height);
}

}  // namespace dodge

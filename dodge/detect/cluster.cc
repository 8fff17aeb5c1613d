#include "dodge/detect/cluster.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <tuple>
#include <utility>

namespace dodge {

namespace {

using Corners = std::array<Eigen::Vector2f, 4>;

Corners corners_of(const cv::RotatedRect& rectangle) {
  cv::Point2f points[4];
  rectangle.points(points);
  Corners corners;
  for (std::size_t i = 0; i < 4; ++i) corners[i] = {points[i].x, points[i].y};
  return corners;
}

// Is there a side of `a` that separates the two rectangles?
bool separated_by_side(const Corners& a, const Corners& b) {
  for (std::size_t side = 0; side < 2; ++side) {
    const Eigen::Vector2f axis = a[side + 1] - a[side];
    float a_min = axis.dot(a[side]), a_max = axis.dot(a[side + 1]);
    if (a_min > a_max) std::swap(a_min, a_max);
    float b_min = std::numeric_limits<float>::max(), b_max = std::numeric_limits<float>::lowest();
    for (const Eigen::Vector2f& corner : b) {
      b_min = std::min(b_min, axis.dot(corner));
      b_max = std::max(b_max, axis.dot(corner));
    }
    if (b_min > a_max || b_max < a_min) return true;
  }
  return false;
}

float squared_distance(const Eigen::Vector2f& p, const Eigen::Vector2f& a,
                       const Eigen::Vector2f& b) {
  const Eigen::Vector2f side = b - a;
  const float length2 = side.squaredNorm();
  const float s = length2 > 0 ? std::clamp(side.dot(p - a) / length2, 0.0F, 1.0F) : 0.0F;
  return (p - a - s * side).squaredNorm();
}

// Groups do not touch: a square of 2 x 2 pixels has one at most, and a row every second pixel, with
// two ends in the outlines.
std::size_t most_groups(int width, int height) {
  return static_cast<std::size_t>((width + 1) / 2) * static_cast<std::size_t>((height + 1) / 2);
}
std::size_t longest_outlines(int width, int height) {
  return 2 * static_cast<std::size_t>((width + 1) / 2) * static_cast<std::size_t>(height);
}

// The first pixel from `from` on that the mask holds; `size` if there is none. A mask is nearly
// empty: looks at eight pixels at a time.
int next_set(const std::uint8_t* mask, int from, int size) {
  for (std::uint64_t eight = 0; from + 8 <= size; from += 8) {
    std::memcpy(&eight, mask + from, sizeof eight);
    if (eight != 0) break;
  }
  while (from < size && mask[from] == 0) ++from;
  return from;
}

float shorter_side(const cv::RotatedRect& r) { return std::min(r.size.width, r.size.height); }

}  // namespace

double rectangle_distance(const cv::RotatedRect& a, const cv::RotatedRect& b) {
  const Corners ca = corners_of(a), cb = corners_of(b);
  if (!separated_by_side(ca, cb) && !separated_by_side(cb, ca)) return 0;
  // Of two disjoint convex polygons the nearest pair contains a corner.
  float nearest = std::numeric_limits<float>::max();
  for (std::size_t i = 0; i < 4; ++i) {
    for (std::size_t j = 0; j < 4; ++j) {
      nearest = std::min(nearest, squared_distance(ca[i], cb[j], cb[(j + 1) % 4]));
      nearest = std::min(nearest, squared_distance(cb[i], ca[j], ca[(j + 1) % 4]));
    }
  }
  return std::sqrt(nearest);
}

Clusterer::Clusterer(const ClusterConfig& config, int width, int height)
    : config_(config),
      width_(width),
      height_(height),
      visited_(static_cast<std::size_t>(width) * static_cast<std::size_t>(height)),
      row_left_(static_cast<std::size_t>(height)),
      row_right_(static_cast<std::size_t>(height)),
      min_area_rectangle_(longest_outlines(width, height)) {
  // What a window may need at most, so that none allocates. Pages that are never used cost nothing.
  region_.reserve(visited_.size());
  points_.reserve(visited_.size());
  outline_.reserve(longest_outlines(width, height));
  merged_outline_.reserve(longest_outlines(width, height));
  groups_.reserve(most_groups(width, height));
  const auto kept = static_cast<std::size_t>(config.max_groups);
  queue_.reserve(kept);
  neighbours_.reserve(kept);
  clusters_.reserve(kept);
}

const std::vector<Cluster>& Clusterer::find(const TimeImage& image, const OpticalFlow& flow) {
  group_connected_pixels(image, flow);
  merge_groups(label_groups());
  return clusters_;
}

double Clusterer::cost(const Cluster& a, const Cluster& b) const {
  return config_.weight_position_1ppx * rectangle_distance(a.rectangle, b.rectangle) +
         cost_without_position(a, b);
}

double Clusterer::cost_without_position(const Cluster& a, const Cluster& b) const {
  return config_.weight_velocity_1ppx * (a.velocity - b.velocity).norm() +
         config_.weight_rho * std::abs(a.rho - b.rho);
}

void Clusterer::group_connected_pixels(const TimeImage& image, const OpticalFlow& flow) {
  groups_.clear();
  outline_.clear();
  const std::uint8_t* mask = image.obstacle_mask().ptr<std::uint8_t>();
  const int size = width_ * height_;
  for (int pixel = next_set(mask, 0, size); pixel < size; pixel = next_set(mask, pixel + 1, size)) {
    if (visited_[static_cast<std::size_t>(pixel)] != 0) continue;
    // Groups share region_, so that visited_ can be cleared at the end.
    flood(image, pixel);
    summarise(image, flow);
  }
  for (const int pixel : region_) visited_[static_cast<std::size_t>(pixel)] = 0;
  region_.clear();

  if (groups_.size() > static_cast<std::size_t>(config_.max_groups)) {
    std::sort(groups_.begin(), groups_.end(), [](const Group& a, const Group& b) {
      return std::tie(b.features.events, a.outline_begin) <
             std::tie(a.features.events, b.outline_begin);
    });
    groups_.resize(static_cast<std::size_t>(config_.max_groups));
  }
}

// Appends all pixels connected with the seed to region_, and sets points_ to those with events.
void Clusterer::flood(const TimeImage& image, int seed) {
  const std::uint8_t* mask = image.obstacle_mask().ptr<std::uint8_t>();
  const std::uint16_t* count = image.count().ptr<std::uint16_t>();
  points_.clear();
  std::size_t next = region_.size();
  region_.push_back(seed);
  visited_[static_cast<std::size_t>(seed)] = 1;
  for (; next < region_.size(); ++next) {
    const int x = region_[next] % width_, y = region_[next] / width_;
    if (count[region_[next]] > 0) points_.emplace_back(x, y);
    for (int v = std::max(0, y - 1); v <= std::min(height_ - 1, y + 1); ++v) {
      for (int u = std::max(0, x - 1); u <= std::min(width_ - 1, x + 1); ++u) {
        const int neighbour = v * width_ + u;
        if (mask[neighbour] == 0 || visited_[static_cast<std::size_t>(neighbour)] != 0) continue;
        visited_[static_cast<std::size_t>(neighbour)] = 1;
        region_.push_back(neighbour);
      }
    }
  }
}

// Turns points_ into a group, unless they are too few.
void Clusterer::summarise(const TimeImage& image, const OpticalFlow& flow) {
  if (points_.size() < static_cast<std::size_t>(config_.min_group_pixels)) return;
  Group group;
  Cluster& features = group.features;
  int top = height_, bottom = -1;
  for (const cv::Point& p : points_) {
    top = std::min(top, p.y);
    bottom = std::max(bottom, p.y);
  }
  std::fill(row_left_.begin() + top, row_left_.begin() + bottom + 1, width_);
  std::fill(row_right_.begin() + top, row_right_.begin() + bottom + 1, -1);
  for (const cv::Point& p : points_) {
    const int events = image.count()(p);
    features.events += events;
    features.rho += image.rho()(p);
    features.centroid += events * Eigen::Vector2d(p.x, p.y);
    const auto row = static_cast<std::size_t>(p.y);
    row_left_[row] = std::min(row_left_[row], p.x);
    row_right_[row] = std::max(row_right_[row], p.x);
  }
  features.pixels = static_cast<int>(points_.size());
  features.rho /= features.pixels;
  features.time = features.rho + image.mean_time();
  features.centroid /= features.events;
  features.velocity = flow.mean_velocity(points_);
  // The ends of the rows have the same bounding rectangle as all pixels.
  group.outline_begin = outline_.size();
  for (int y = top; y <= bottom; ++y) {
    const auto row = static_cast<std::size_t>(y);
    if (row_right_[row] < 0) continue;
    outline_.emplace_back(static_cast<float>(row_left_[row]), static_cast<float>(y));
    outline_.emplace_back(static_cast<float>(row_right_[row]), static_cast<float>(y));
  }
  group.outline_end = outline_.size();
  features.rectangle = bounding_rectangle(
      std::span(outline_).subspan(group.outline_begin, group.outline_end - group.outline_begin));
  groups_.push_back(group);
}

// The rectangle around pixel centres, grown by half a pixel on each side to their borders.
cv::RotatedRect Clusterer::bounding_rectangle(std::span<const cv::Point2f> points) {
  cv::RotatedRect rectangle = min_area_rectangle_.around(points);
  rectangle.size += cv::Size2f(1, 1);
  return rectangle;
}

// Whether the cost is at most eps. The distance of rectangles takes long, and often decides
// nothing.
bool Clusterer::are_near(const Cluster& a, const Cluster& b) const {
  return cost_without_position(a, b) <= config_.eps && cost(a, b) <= config_.eps;
}

// The group itself and those near it; once they make it a core, those with a label are left out.
void Clusterer::neighbours(std::size_t i, std::vector<std::size_t>& out) const {
  const auto enough = static_cast<std::size_t>(config_.min_points);
  out.assign(1, i);
  for (std::size_t j = 0; j < groups_.size(); ++j) {
    if (j == i || (groups_[j].label >= 0 && out.size() >= enough)) continue;
    if (are_near(groups_[i].features, groups_[j].features)) out.push_back(j);
  }
}

// DBSCAN. Returns the number of labels; groups_ are labelled 0.. or -1 for noise.
int Clusterer::label_groups() {
  const auto min_points = static_cast<std::size_t>(config_.min_points);
  int labels = 0;
  for (std::size_t i = 0; i < groups_.size(); ++i) {
    if (groups_[i].label >= 0) continue;
    neighbours(i, neighbours_);
    if (neighbours_.size() < min_points) continue;
    groups_[i].label = labels;
    queue_.clear();
    take_neighbours(labels);
    for (std::size_t next = 0; next < queue_.size(); ++next) {
      neighbours(queue_[next], neighbours_);
      if (neighbours_.size() < min_points) continue;  // a border point: does not reach further
      take_neighbours(labels);
    }
    ++labels;
  }
  return labels;
}

// Labels and queues those of neighbours_ that have no label yet.
void Clusterer::take_neighbours(int label) {
  for (const std::size_t neighbour : neighbours_) {
    if (groups_[neighbour].label >= 0) continue;
    groups_[neighbour].label = label;
    queue_.push_back(neighbour);
  }
}

void Clusterer::merge_groups(int label_count) {
  clusters_.clear();
  for (int label = 0; label < label_count; ++label) {
    Cluster merged;
    merged_outline_.clear();
    for (const Group& group : groups_) {
      if (group.label != label) continue;
      const Cluster& part = group.features;
      merged.pixels += part.pixels;
      merged.events += part.events;
      merged.rho += part.rho * part.pixels;
      merged.time += part.time * part.pixels;
      merged.velocity += part.velocity * part.pixels;
      merged.centroid += part.centroid * part.events;
      merged_outline_.insert(merged_outline_.end(),
                             outline_.begin() + static_cast<std::ptrdiff_t>(group.outline_begin),
                             outline_.begin() + static_cast<std::ptrdiff_t>(group.outline_end));
    }
    if (merged.pixels < config_.min_pixels || merged.events < config_.min_events) continue;
    merged.rho /= merged.pixels;
    merged.time /= merged.pixels;
    merged.velocity /= merged.pixels;
    merged.centroid /= merged.events;
    merged.rectangle = bounding_rectangle(merged_outline_);
    const auto higher = [](const cv::Point2f& a, const cv::Point2f& b) { return a.y < b.y; };
    const auto [top, bottom] = std::ranges::minmax_element(merged_outline_, higher);
    merged.top_row = top->y - 0.5;
    merged.bottom_row = bottom->y + 0.5;
    if (longer_side(merged.rectangle) > config_.max_aspect * shorter_side(merged.rectangle))
      continue;
    clusters_.push_back(merged);
  }
}

}  // namespace dodge

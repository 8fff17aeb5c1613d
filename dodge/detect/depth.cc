#include "dodge/detect/depth.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <tuple>

#include "dodge/detect/disparity.h"
#include "dodge/detect/min_area_rectangle.h"

namespace dodge {

namespace {

// An object this near to the border of the image may go on beyond it: a turn by 1 rad/s moves the
// compensated border by 2 px in a window of 10 ms.
constexpr double kBorder_px = 3;

// How much the greater of two positive numbers exceeds the smaller, as a ratio; 0 if equal.
double excess_ratio(double a, double b) { return std::max(a / b, b / a) - 1; }

Eigen::Vector3d back_project(const CameraModel& camera, double u, double v, double depth_m) {
  // Compensated pixels are undistorted: the inverse of K alone (10).
  return depth_m * Eigen::Vector3d((u - camera.cx) / camera.fx, (v - camera.cy) / camera.fy, 1);
}

// A little more than the rectangle, so that the neutral surroundings take part.
cv::Rect patch_around(const cv::RotatedRect& rectangle) {
  const cv::Rect tight = rectangle.boundingRect();
  return {tight.x - 1, tight.y - 1, tight.width + 2, tight.height + 2};
}

}  // namespace

DepthEstimator::DepthEstimator(const DepthConfig& config, std::span<const CameraModel> cameras,
                               std::int64_t window_us, int max_clusters)
    : config_(config),
      window_us_(static_cast<double>(window_us)),
      camera_(cameras[0]),
      min_area_rectangle_(8),
      assignment_(static_cast<std::size_t>(max_clusters)) {
  const auto most = static_cast<std::size_t>(max_clusters);
  costs_.reserve(most * most);
  matches_.reserve(most);
  if (cameras.size() > 1) {
    const Eigen::Vector3d baseline = cameras[1].X_BC.translation() - cameras[0].X_BC.translation();
    focal_baseline_ = camera_.fy * baseline.norm();  // a vertical pair
  }
}

void DepthEstimator::locate(std::span<const View> views, const StateEstimate& state,
                            std::vector<Detection>& detections) {
  if (!config_.stereo_depth()) {
    locate_by_size(*views[0].clusters, state, detections);
  } else {
    locate_by_stereo(views[0], views[1], state, detections);
  }
}

Eigen::Vector2d DepthEstimator::centre(const Cluster& cluster) const {
  if (config_.centre == "centroid") return cluster.centroid;
  return {cluster.rectangle.center.x, cluster.rectangle.center.y};
}

// Of what goes on above the image the bottom camera sees less, of what goes on below it the top
// one: their centres are nearer to each other then than the object's are. What both see of it ends
// at the end away from the border; but each may have seen another edge of it.
double DepthEstimator::cluster_disparity_px(const Cluster& top, const Cluster& bottom) const {
  const double lowest_px = camera_.height - 1 - kBorder_px;
  const bool cut_above = std::min(top.top_row, bottom.top_row) < kBorder_px;
  const bool cut_below = std::max(top.bottom_row, bottom.bottom_row) > lowest_px;
  const double centres_px = centre(top).y() - centre(bottom).y();
  if (cut_above == cut_below) return centres_px;
  const double ends_px =
      cut_above ? top.bottom_row - bottom.bottom_row : top.top_row - bottom.top_row;
  return std::max(centres_px, ends_px);
}

double DepthEstimator::matching_cost(const Cluster& top, const Cluster& bottom) const {
  return config_.stereo.weight_position_1ppx * std::abs(centre(top).x() - centre(bottom).x()) +
         config_.stereo.weight_area *
             excess_ratio(top.rectangle.size.area(), bottom.rectangle.size.area()) +
         config_.stereo.weight_count * excess_ratio(top.pixels, bottom.pixels);
}

void DepthEstimator::locate_by_size(const std::vector<Cluster>& clusters,
                                    const StateEstimate& state,
                                    std::vector<Detection>& detections) const {
  for (const Cluster& cluster : clusters) {
    const double side_px = longer_side(cluster.rectangle);
    const double depth_m = camera_.mean_focal_px() * config_.known_size_m / side_px;  // (7)
    append(cluster, depth_m, depth_m * config_.side_sigma_px / side_px, state, detections);
  }
}

// Fills matches_, the cheapest first: the pairs with the least sum of costs, where a cluster
// without a partner costs as much as the dearest pair. The cheapest pair alone may be the upper of
// two objects in one camera and the lower one in the other.
void DepthEstimator::match_clusters(const std::vector<Cluster>& top,
                                    const std::vector<Cluster>& bottom) {
  costs_.clear();
  for (const Cluster& above : top) {
    for (const Cluster& below : bottom) {
      const bool in_front = cluster_disparity_px(above, below) > 0;
      costs_.push_back(in_front ? matching_cost(above, below)
                                : std::numeric_limits<double>::infinity());
    }
  }
  const std::span<const int> partners =
      assignment_.solve(costs_, top.size(), bottom.size(), config_.stereo.max_cost);
  matches_.clear();
  for (std::size_t i = 0; i < top.size(); ++i) {
    if (partners[i] < 0) continue;
    const auto j = static_cast<std::size_t>(partners[i]);
    matches_.push_back({costs_[i * bottom.size() + j], i, j});
  }
  std::sort(matches_.begin(), matches_.end(), [](const Match& a, const Match& b) {
    return std::tie(a.cost, a.top, a.bottom) < std::tie(b.cost, b.top, b.bottom);
  });
}

void DepthEstimator::locate_by_stereo(const View& top, const View& bottom,
                                      const StateEstimate& state,
                                      std::vector<Detection>& detections) {
  match_clusters(*top.clusters, *bottom.clusters);
  for (const Match& match : matches_) {
    Cluster object = (*top.clusters)[match.top];
    const Cluster& below = (*bottom.clusters)[match.bottom];
    double disparity_px = cluster_disparity_px(object, below);
    if (config_.stereo.disparity == "correlation") {
      const std::optional<double> found = correlated_disparity(top, bottom, match);
      if (!found) continue;
      disparity_px = *found;
      // Its time stays the top cluster's, which is a little off where the bottom one's differs.
      object.rectangle = joined(object.rectangle, below.rectangle, disparity_px);
    }
    const double depth_m = focal_baseline_ / disparity_px;
    append(object, depth_m, depth_m * config_.stereo.disparity_sigma_px / disparity_px, state,
           detections);
  }
}

// The rectangle around the top camera's and the bottom camera's, moved by the disparity: each may
// have seen another part of the object.
cv::RotatedRect DepthEstimator::joined(const cv::RotatedRect& top, const cv::RotatedRect& bottom,
                                       double disparity_px) {
  std::array<cv::Point2f, 8> corners;
  top.points(corners.data());
  bottom.points(corners.data() + 4);
  for (std::size_t i = 4; i < 8; ++i) corners[i].y += static_cast<float>(disparity_px);
  return min_area_rectangle_.around(corners);
}

// The smaller cluster is the pattern: what it shows, the other camera is likely to see as well.
std::optional<double> DepthEstimator::correlated_disparity(const View& top, const View& bottom,
                                                           const Match& match) const {
  const StereoConfig& stereo = config_.stereo;
  const Cluster& above = (*top.clusters)[match.top];
  const Cluster& below = (*bottom.clusters)[match.bottom];
  const double guess_px = cluster_disparity_px(above, below);
  const int least_px = std::max(1, static_cast<int>(std::floor(guess_px - stereo.search_px)));
  const int most_px = static_cast<int>(std::ceil(guess_px + stereo.search_px));
  const bool from_top = above.pixels <= below.pixels;
  const cv::Mat1f& pattern = from_top ? *top.averaged_rho : *bottom.averaged_rho;
  const cv::Mat1f& image = from_top ? *bottom.averaged_rho : *top.averaged_rho;
  const cv::Rect patch = patch_around(from_top ? above.rectangle : below.rectangle);

  const std::optional<RowShift> found =
      from_top ? find_row_shift(pattern, patch, image, -most_px, -least_px)
               : find_row_shift(pattern, patch, image, least_px, most_px);
  if (!found || found->correlation < stereo.min_correlation) return std::nullopt;
  const double disparity_px = from_top ? -found->shift_px : found->shift_px;
  if (disparity_px <= 0) return std::nullopt;
  if (stereo.min_share_of_best > 0) {
    const int farthest_px = image.rows - 1;
    const double best = from_top ? best_correlation(pattern, patch, image, -farthest_px, -1)
                                 : best_correlation(pattern, patch, image, 1, farthest_px);
    if (found->correlation < stereo.min_share_of_best * best) return std::nullopt;
  }
  return disparity_px;
}

void DepthEstimator::append(const Cluster& cluster, double depth_m, double depth_sigma_m,
                            const StateEstimate& state, std::vector<Detection>& detections) const {
  const double size_m = depth_m * longer_side(cluster.rectangle) / camera_.mean_focal_px();  // (9)
  const Eigen::Vector2d middle = centre(cluster);
  const double range_m = back_project(camera_, middle.x(), middle.y(), depth_m).norm();
  if (range_m < config_.min_range_m || range_m > config_.max_range_m) return;
  if (size_m < config_.min_size_m || size_m > config_.max_size_m) return;

  // The events were rotated to the window's end, but seen from where the vehicle was before.
  const auto age_us = static_cast<TimeUs>(std::llround((1 - cluster.time) * window_us_));
  Eigen::Isometry3d X_WB = Eigen::Isometry3d::Identity();
  X_WB.linear() = state.q_WB.toRotationMatrix();
  X_WB.translation() = state.p_WB - seconds(age_us) * state.v_WB;
  const Eigen::Isometry3d X_WC = X_WB * camera_.X_BC;  // (11)

  Detection detection;
  detection.t_us = state.t_us - age_us;
  detection.depth_m = depth_m;
  detection.depth_sigma_m = depth_sigma_m;
  detection.distance_per_depth = range_m / depth_m;
  detection.size_m = size_m;
  cv::Point2f corners[4];
  cluster.rectangle.points(corners);
  for (std::size_t i = 0; i < 4; ++i) {
    detection.p_W[i] = X_WC * back_project(camera_, corners[i].x, corners[i].y, depth_m);
  }
  const double near_m = std::max(depth_m - size_m, 0.0);  // never behind the camera (12)
  detection.p_W[4] = X_WC * back_project(camera_, middle.x(), middle.y(), near_m);
  detection.p_W[5] = X_WC * back_project(camera_, middle.x(), middle.y(), depth_m + size_m);
  detection.centre_W = X_WC * back_project(camera_, middle.x(), middle.y(), depth_m);
  detections.push_back(detection);
}

}  // namespace dodge

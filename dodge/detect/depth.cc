#include "dodge/detect/depth.h"

#include <algorithm>
#include <cmath>

namespace dodge {

namespace {

// How much the greater of two positive numbers exceeds the smaller, as a ratio; 0 if equal.
double excess_ratio(double a, double b) { return std::max(a / b, b / a) - 1; }

double longer_side(const cv::RotatedRect& r) { return std::max(r.size.width, r.size.height); }

Eigen::Vector3d back_project(const CameraModel& camera, double u, double v, double depth_m) {
  // Compensated pixels are undistorted: the inverse of K alone (10).
  return depth_m * Eigen::Vector3d((u - camera.cx) / camera.fx, (v - camera.cy) / camera.fy, 1);
}

}  // namespace

DepthEstimator::DepthEstimator(const DepthConfig& config, std::span<const CameraModel> cameras)
    : config_(config), camera_(cameras[0]) {
  if (cameras.size() > 1) {
    const Eigen::Vector3d baseline = cameras[1].X_BC.translation() - cameras[0].X_BC.translation();
    focal_baseline_ = camera_.mean_focal_px() * baseline.norm();
  }
}

void DepthEstimator::locate(std::span<const std::vector<Cluster>* const> clusters,
                            const StateEstimate& state, std::vector<Detection>& detections) {
  if (config_.depth == "mono") {
    locate_by_size(*clusters[0], state, detections);
  } else {
    locate_by_stereo(*clusters[0], *clusters[1], state, detections);
  }
}

Eigen::Vector2d DepthEstimator::centre(const Cluster& cluster) const {
  if (config_.centre == "centroid") return cluster.centroid;
  return {cluster.rectangle.center.x, cluster.rectangle.center.y};
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

void DepthEstimator::locate_by_stereo(const std::vector<Cluster>& top,
                                      const std::vector<Cluster>& bottom,
                                      const StateEstimate& state,
                                      std::vector<Detection>& detections) {
  matches_.clear();
  for (std::size_t i = 0; i < top.size(); ++i) {
    for (std::size_t j = 0; j < bottom.size(); ++j) {
      if (centre(top[i]).y() <= centre(bottom[j]).y()) continue;  // disparity must be positive
      const double cost = matching_cost(top[i], bottom[j]);
      if (cost <= config_.stereo.max_cost) matches_.push_back({cost, i, j});
    }
  }
  // The cheapest pairs first, each cluster in one pair only. Ties keep the order of the scan.
  std::sort(matches_.begin(), matches_.end(), [](const Match& a, const Match& b) {
    return std::tie(a.cost, a.top, a.bottom) < std::tie(b.cost, b.top, b.bottom);
  });
  top_taken_.assign(top.size(), false);
  bottom_taken_.assign(bottom.size(), false);
  for (const Match& match : matches_) {
    if (top_taken_[match.top] || bottom_taken_[match.bottom]) continue;
    top_taken_[match.top] = bottom_taken_[match.bottom] = true;
    const double disparity_px = centre(top[match.top]).y() - centre(bottom[match.bottom]).y();
    const double depth_m = focal_baseline_ / disparity_px;
    append(top[match.top], depth_m, depth_m * config_.stereo.disparity_sigma_px / disparity_px,
           state, detections);
  }
}

void DepthEstimator::append(const Cluster& cluster, double depth_m, double depth_sigma_m,
                            const StateEstimate& state, std::vector<Detection>& detections) const {
  const double size_m = depth_m * longer_side(cluster.rectangle) / camera_.mean_focal_px();  // (9)
  if (depth_m < config_.min_range_m || depth_m > config_.max_range_m) return;
  if (size_m < config_.min_size_m || size_m > config_.max_size_m) return;

  Eigen::Isometry3d X_WB = Eigen::Isometry3d::Identity();
  X_WB.linear() = state.q_WB.toRotationMatrix();
  X_WB.translation() = state.p_WB;
  const Eigen::Isometry3d X_WC = X_WB * camera_.X_BC;  // (11)

  Detection detection;
  detection.t_us = state.t_us;
  detection.camera = 0;
  detection.depth_m = depth_m;
  detection.depth_sigma_m = depth_sigma_m;
  detection.size_m = size_m;
  cv::Point2f corners[4];
  cluster.rectangle.points(corners);
  for (std::size_t i = 0; i < 4; ++i) {
    detection.p_W[i] = X_WC * back_project(camera_, corners[i].x, corners[i].y, depth_m);
  }
  const Eigen::Vector2d middle = centre(cluster);
  const double margin_m = config_.depth_margin == "size" ? size_m : size_m + depth_sigma_m;
  const double near_m = std::max(depth_m - margin_m, 0.0);  // never behind the camera (12)
  detection.p_W[4] = X_WC * back_project(camera_, middle.x(), middle.y(), near_m);
  detection.p_W[5] = X_WC * back_project(camera_, middle.x(), middle.y(), depth_m + margin_m);
  detection.centre_W = X_WC * back_project(camera_, middle.x(), middle.y(), depth_m);
  detections.push_back(detection);
}

}  // namespace dodge

// From clusters in the image to obstacles in the world: depth by known size (7) or by stereo
// matching (8), size (9), projection (10, 11) and the six points (12) of Falanga et al. 2020.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "dodge/camera_model.h"
#include "dodge/detect/assignment.h"
#include "dodge/detect/cluster.h"
#include "dodge/detect/min_area_rectangle.h"
#include "dodge/types.h"

namespace dodge {

struct StereoConfig {
  std::string disparity = "correlation";
  double search_px = 16;
  double min_correlation = 0.4;
  double min_share_of_best = 0;
  double weight_position_1ppx = 0.1;
  double weight_area = 0.5;
  double weight_count = 0.5;
  double max_cost = 5;
  double disparity_sigma_px = 0.25;

  template <class Visitor>
  void visit(Visitor& v) {
    v("disparity", disparity, {"centres", "correlation"},
      "Disparity of a matched pair: the shift at which the rho images of the two cameras agree "
      "best, starting from the disparity of the clusters' centres, or the latter alone. (Of what "
      "the upper or lower border of an image cuts off, that of the other end if it is greater.) "
      "The two cameras see different parts of an object's outline move: centres alone err by 10 cm "
      "at 1 m and match noise with noise, the correlation errs by 2 to 4 cm. The paper says no "
      "more than 'the cluster's disparity' and 'the cluster's centers'.");
    v("search_px", search_px, 0, 100,
      "How far from the centres' disparity the correlation looks, and on while it grows: about the "
      "size of an object.");
    v("min_correlation", min_correlation, 0, 1, "A pair whose rho images agree less is no match.");
    v("min_share_of_best", min_share_of_best, 0, 0.99,
      "A pair whose rho images agree less than this share of the best agreement along the whole "
      "columns is no match: one with another part of the scene, which looks like it. 0: not looked "
      "for, as nothing of the kind is in the paper.");
    v("weight_position_1ppx", weight_position_1ppx, 0, 100,
      "Weight w_p of the horizontal distance of the centres in eq. (8).");
    v("weight_area", weight_area, 0, 100, "Weight w_a of the ratio of the areas in eq. (8).");
    v("weight_count", weight_count, 0, 100, "Weight w_n of the ratio of the pixels in eq. (8).");
    v("max_cost", max_cost, 0, 1000, "Pairs of a greater cost (8) are not the same object.");
    v("disparity_sigma_px", disparity_sigma_px, 0.01, 20,
      "Standard deviation of the disparity, which gives the depth's: measured on synthetic throws "
      "0.7 px (3 m) to 5 px (1 m) for centres, 0.1 to 0.25 px for correlation.");
  }
};

struct DepthConfig {
  std::string depth = "stereo";
  double known_size_m = 0.2;
  double side_sigma_px = 2;
  StereoConfig stereo;
  std::string centre = "rectangle";
  double min_range_m = 0.2;
  double max_range_m = 1.5;
  double min_size_m = 0.03;
  double max_size_m = 0.8;

  bool stereo_depth() const { return depth == "stereo"; }
  std::size_t cameras() const { return stereo_depth() ? 2 : 1; }  // the first of the vehicle's

  template <class Visitor>
  void visit(Visitor& v) {
    v("depth", depth, {"mono", "stereo"},
      "How depth is measured: from the object's known size with the first camera, or from the "
      "disparity of two cameras one above the other.");
    v("known_size_m", known_size_m, 0.01, 10, "Size of every object; used by mono only.");
    v("side_sigma_px", side_sigma_px, 0.01, 20,
      "Standard deviation of the rectangle's longer side; gives the depth's in mono.");
    v("stereo", stereo, "Matching of clusters between the two cameras.");
    v("centre", centre, {"rectangle", "centroid"},
      "The point of a cluster whose disparity is taken: its rectangle's centre as in the paper, or "
      "the centroid of its events.");
    v("min_range_m", min_range_m, 0.01, 100, "Nearer detections are dropped.");
    v("max_range_m", max_range_m, 0.1, 100,
      "Detections farther from the camera are dropped; 1.5 m in the paper, as they are too noisy.");
    v("min_size_m", min_size_m, 0, 100, "Smaller objects are not credible.");
    v("max_size_m", max_size_m, 0, 100, "Larger objects are not credible.");
  }
};

// What a camera contributes: its stages' results of the last window.
struct View {
  const std::vector<Cluster>* clusters;  // of Clusterer
  const cv::Mat1f* averaged_rho;         // of TimeImage
};

class DepthEstimator {
 public:
  // One camera for mono; for stereo camera 0 on top and camera 1 below it, rectified (validate()
  // in dodge/config.h checks this). max_clusters: clusters of a camera for which memory is
  // reserved.
  DepthEstimator(const DepthConfig& config, std::span<const CameraModel> cameras,
                 std::int64_t window_us, int max_clusters);

  // Appends the obstacles among the clusters of the cameras (indexed as the cameras) to detections,
  // best match first. Pixels are those of the window's end, the instant of `state`; a detection's
  // instant is the mean of its cluster's pixels' mean times, some ms before.
  void locate(std::span<const View> views, const StateEstimate& state,
              std::vector<Detection>& detections);

  // Eq. (8), with both ratios counted from 1; the second camera's cluster below the first's.
  double matching_cost(const Cluster& top, const Cluster& bottom) const;

 private:
  struct Match {
    double cost;
    std::size_t top, bottom;
  };

  void locate_by_size(const std::vector<Cluster>& clusters, const StateEstimate& state,
                      std::vector<Detection>& detections) const;
  void locate_by_stereo(const View& top, const View& bottom, const StateEstimate& state,
                        std::vector<Detection>& detections);
  double cluster_disparity_px(const Cluster& top, const Cluster& bottom) const;
  void match_clusters(const std::vector<Cluster>& top, const std::vector<Cluster>& bottom);
  cv::RotatedRect joined(const cv::RotatedRect& top, const cv::RotatedRect& bottom,
                         double disparity_px);
  std::optional<double> correlated_disparity(const View& top, const View& bottom,
                                             const Match& match) const;
  void append(const Cluster& cluster, double depth_m, double depth_sigma_m,
              const StateEstimate& state, std::vector<Detection>& detections) const;
  Eigen::Vector2d centre(const Cluster& cluster) const;

  DepthConfig config_;
  double window_us_;
  CameraModel camera_;         // the reference camera
  double focal_baseline_ = 0;  // focal length times baseline [px m]
  MinAreaRectangle min_area_rectangle_;
  Assignment assignment_;
  std::vector<double> costs_;  // of each top cluster with each bottom one, row-major
  std::vector<Match> matches_;
};

}  // namespace dodge

// From the mask of moving pixels to obstacles in the image: 8-connected pre-clusters with their
// mean velocity, mean rho and rotated rectangle, then DBSCAN (Ester et al. 1996) over the
// pre-clusters with the cost of Falanga et al. 2020, eq. (6).
#pragma once

#include <Eigen/Dense>
#include <opencv2/core.hpp>
#include <span>
#include <vector>

#include "dodge/detect/min_area_rectangle.h"
#include "dodge/detect/optical_flow.h"
#include "dodge/detect/time_image.h"

namespace dodge {

struct ClusterConfig {
  int min_group_pixels = 3;
  int max_groups = 64;
  double eps = 7;
  int min_points = 1;
  double weight_position_1ppx = 0.2;
  double weight_velocity_1ppx = 0.1;
  double weight_rho = 15;
  int min_pixels = 6;
  int min_events = 30;
  double max_aspect = 4;

  template <class Visitor>
  void visit(Visitor& v) {
    v("min_group_pixels", min_group_pixels, 1, 10000,
      "Connected groups with fewer pixels that hold events are noise and dropped before DBSCAN.");
    v("max_groups", max_groups, 1, 1000,
      "DBSCAN sees at most this many groups, those with most events: bounds the time of a frame "
      "full of flicker.");
    v("eps", eps, 0, 1000, "DBSCAN's largest cost between neighbours.");
    v("min_points", min_points, 1, 100,
      "Groups in the eps neighbourhood, itself included, that make a group a core of a cluster.");
    v("weight_position_1ppx", weight_position_1ppx, 0, 1000,
      "Weight w_p of the distance between rectangles [1/px] in eq. (6); from the authors' group's "
      "open code. With eps 7 it joins groups up to 35 px apart: the two edges of a 20 cm ball that "
      "crosses at 1.1 m, but also a ball and the edges of a cluttered background. A greater weight "
      "sees more of the ball by itself, and takes more of the scene for an object.");
    v("weight_velocity_1ppx", weight_velocity_1ppx, 0, 1000,
      "Weight w_v of the velocity difference [1/(px per event window)] in eq. (6).");
    v("weight_rho", weight_rho, 0, 1000, "Weight w_rho of the difference in mean rho in eq. (6).");
    v("min_pixels", min_pixels, 1, 100000, "A cluster with fewer pixels with events is noise.");
    v("min_events", min_events, 1, 100000,
      "A cluster with fewer events is noise. A ball of 10 cm at 1.5 m makes some 200 in a window, "
      "a patch of background noise a dozen.");
    v("max_aspect", max_aspect, 1, 1000,
      "Clusters whose rectangle is longer than this times its width are taken for edges of the "
      "background. So is what moves of a frisbee seen edge-on or of a box that rises.");
  }
};

// A group of pixels that move together, in compensated pixels.
struct Cluster {
  cv::RotatedRect rectangle;           // around the outer borders of its pixels with events [px]
  double top_row = 0, bottom_row = 0;  // the upper and lower ends of those borders [px]
  Eigen::Vector2d centroid = Eigen::Vector2d::Zero();  // of its events [px]
  Eigen::Vector2d velocity = Eigen::Vector2d::Zero();  // [px per event window]
  double rho = 0;                                      // mean over its pixels
  double time = 0;  // mean T of its pixels (3), in window lengths after the window's start
  int pixels = 0;   // pixels with events
  int events = 0;
};

// Smallest distance between the borders of two rectangles; 0 if they overlap [px].
double rectangle_distance(const cv::RotatedRect& a, const cv::RotatedRect& b);

class Clusterer {
 public:
  Clusterer(const ClusterConfig& config, int width, int height);

  // Clusters of the image's obstacle mask, in the order of the scan; where max_groups leaves some
  // out, those of most events first. Valid until the next call.
  const std::vector<Cluster>& find(const TimeImage& image, const OpticalFlow& flow);

  // Those of the last call.
  const std::vector<Cluster>& clusters() const { return clusters_; }

  // Eq. (6).
  double cost(const Cluster& a, const Cluster& b) const;

 private:
  struct Group {
    Cluster features;
    std::size_t outline_begin = 0, outline_end = 0;  // its part of outline_
    int label = -1;                                  // of DBSCAN; -1: none yet or noise
  };

  void group_connected_pixels(const TimeImage& image, const OpticalFlow& flow);
  void flood(const TimeImage& image, int seed);
  void summarise(const TimeImage& image, const OpticalFlow& flow);
  cv::RotatedRect bounding_rectangle(std::span<const cv::Point2f> points);
  int label_groups();
  double cost_without_position(const Cluster& a, const Cluster& b) const;
  bool are_near(const Cluster& a, const Cluster& b) const;
  void neighbours(std::size_t i, std::vector<std::size_t>& out) const;
  void take_neighbours(int label);
  void merge_groups(int label_count);

  ClusterConfig config_;
  int width_, height_;
  std::vector<std::uint8_t> visited_;  // all zero between calls
  std::vector<int> region_;            // pixels of the group being filled
  std::vector<cv::Point> points_;      // those of them with events
  std::vector<int> row_left_, row_right_;
  std::vector<cv::Point2f> outline_, merged_outline_;
  MinAreaRectangle min_area_rectangle_;
  std::vector<Group> groups_;
  std::vector<std::size_t> queue_, neighbours_;
  std::vector<Cluster> clusters_;
};

}  // namespace dodge

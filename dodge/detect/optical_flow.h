// Image velocity of the averaged, unthresholded rho image by Lucas and Kanade's least squares
// (Falanga et al. 2020, "Optical flow"), only at the pixels that need it.
#pragma once

#include <Eigen/Dense>
#include <opencv2/core.hpp>
#include <span>

namespace dodge {

struct FlowConfig {
  int window_px = 11;
  int samples = 16;
  double min_eigenvalue = 1e-5;
  double max_px = 20;

  template <class Visitor>
  void visit(Visitor& v) {
    v("window_px", window_px, 3, 31,
      "Side of the square window of the least squares, an odd number; 11 as in the paper's "
      "authors' later code.");
    v("samples", samples, 1, 256,
      "The velocity of a group of pixels is averaged over at most this many of them, evenly "
      "chosen: the averaging of the velocity field, at a bounded cost.");
    v("min_eigenvalue", min_eigenvalue, 0, 1,
      "A pixel counts only where the smaller eigenvalue of the structure tensor, per pixel of the "
      "window, exceeds this: elsewhere the flow is undetermined.");
    v("max_px", max_px, 0.1, 100,
      "Displacements over one event window are limited to this; greater ones are not credible.");
  }
};

class OpticalFlow {
 public:
  explicit OpticalFlow(const FlowConfig& config) : config_(config) {}

  // The two averaged rho images and how many event windows lie between them (the time between
  // their ends over the window's length). The images must outlive the calls below. Without a
  // previous image (elapsed_windows <= 0) all velocities are zero.
  void set_images(const cv::Mat1f& previous, const cv::Mat1f& current, double elapsed_windows);

  // Velocity at a pixel [px per event window]; zero where it is undetermined. Common motion of the
  // whole image (the camera's rotation between the windows) is contained.
  Eigen::Vector2d velocity(const cv::Point& pixel) const;

  // Mean of velocity() over the pixels where it is determined.
  Eigen::Vector2d mean_velocity(std::span<const cv::Point> pixels) const;

 private:
  bool solve(const cv::Point& pixel, Eigen::Vector2d& displacement) const;

  FlowConfig config_;
  const cv::Mat1f* previous_ = nullptr;
  const cv::Mat1f* current_ = nullptr;
  double elapsed_windows_ = 0;
};

}  // namespace dodge

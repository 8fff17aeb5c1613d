// From the compensated events of one window to the mask of what moves by itself: event count (2),
// time image (3), normalised mean time stamp rho (4), averaging, threshold a|w| + b, morphology.
// Falanga et al. 2020. All images have the camera's size.
#pragma once

#include <array>
#include <cstdint>
#include <opencv2/core.hpp>
#include <span>
#include <vector>

#include "dodge/detect/binomial_filter.h"
#include "dodge/detect/ego_motion.h"
#include "dodge/detect/morphology.h"
#include "dodge/types.h"

namespace dodge {

struct TimeImageConfig {
  double threshold_a_s = 0.1;
  double threshold_b = 0.1;
  int blur_px = 3;
  int open_px = 2;
  int close_px = 3;
  int dilate_px = 1;

  template <class Visitor>
  void visit(Visitor& v) {
    v("threshold_a_s", threshold_a_s, 0.0, 1.0,
      "Slope a [1/(rad/s)] of the threshold a|w| + b on the averaged rho. Not given by the paper; "
      "0.1 (the authors' group's open code) leaves nothing static of a real scene seen by a camera "
      "turning at 2 to 3 rad/s; 0.05 leaves a few edges.");
    v("threshold_b", threshold_b, 0.0, 1.0,
      "Threshold b of a still camera. A lone noise event reaches 0.12 after averaging over 3 px. "
      "In flight 0.05 lets twelve false obstacles a second pass, 0.1 one in ten seconds, and 0.15 "
      "halves the detections.");
    v("blur_px", blur_px, 1, 15,
      "Size of the binomial averaging of rho before the cut, an odd number; 1 is off. Averaging "
      "over more than the object moves in a window cancels its new pixels with its old ones.");
    v("open_px", open_px, 0, 15,
      "Square kernel of the opening of the mask; 0 or 1 is off. 3 removes whatever is narrower "
      "than 3 px, that is, all objects that move less than some 3 px per window.");
    v("close_px", close_px, 0, 15, "Square kernel of the closing of the mask; 0 or 1 is off.");
    v("dilate_px", dilate_px, 0, 15,
      "Square kernel of the final dilation of the mask; 0 or 1 is off. Clusters keep only pixels "
      "with events, so that it joins groups without making them larger.");
  }
};

// The pixel that a place in an image of width x height lies in, as y * width + x; -1 outside.
inline int pixel_at(float x, float y, int width, int height) {
  // Rounds to the nearest pixel; the test on the shifted value also catches NaN.
  const float u = x + 0.5F, v = y + 0.5F;
  const bool inside =
      (u >= 0) & (v >= 0) & (u < static_cast<float>(width)) & (v < static_cast<float>(height));
  return inside ? static_cast<int>(v) * width + static_cast<int>(u) : -1;
}

// The compensated pixel of an event in an image of width x height, as y * width + x; -1 if that is
// outside of the image, or the event's own pixel is.
inline int compensated_pixel(const EgoMotion& ego_motion, const Event& event, int width,
                             int height) {
  if (event.x >= width || event.y >= height) return -1;
  const Eigen::Vector2f warped = ego_motion.warp(event);
  return pixel_at(warped.x(), warped.y(), width, height);
}

class TimeImage {
 public:
  TimeImage(const TimeImageConfig& config, int width, int height);

  // Eqs. (2), (3): empties the images and takes the events of (begin_us, end_us], given in pieces.
  // The pixel is the warped one, the time the event's own. Events outside of the image, before or
  // after the warp, are dropped, and of one pixel all after the first 65,535.
  void accumulate(std::span<const std::span<const Event>> pieces, const EgoMotion& ego_motion,
                  TimeUs begin_us, TimeUs end_us);

  // Eq. (4), the averaging, and the cut at a|w| + b. rate_radps is |w|.
  void threshold(double rate_radps);

  // Opening, closing and dilation.
  void clean();

  // mean(T) of (4), in window lengths after the window's start.
  double mean_time() const { return mean_time_; }

  const cv::Mat1w& count() const { return count_; }        // events per pixel (2)
  const cv::Mat1f& rho() const { return rho_; }            // (4); 0 where there is no event
  const cv::Mat1f& averaged() const { return averaged_; }  // rho after the blur
  const cv::Mat1f& previous_averaged() const { return previous_; }     // of the window before
  const cv::Mat1b& threshold_mask() const { return threshold_mask_; }  // 0 or 255
  const cv::Mat1b& obstacle_mask() const { return obstacle_mask_; }    // 0 or 255, cleaned

 private:
  static constexpr std::size_t kBlock = 256;  // events that are warped together
  static constexpr std::uint16_t kMostOfPixel = 65535;

  void add(std::span<const Event> block, const EgoMotion& ego_motion, TimeUs begin_us,
           float per_us);
  void place(std::span<const Event> block, const EgoMotion& ego_motion);
  std::span<const int> active() const { return std::span(active_).first(active_count_); }

  TimeImageConfig config_;
  std::array<float, kBlock> u_, v_;
  std::array<int, kBlock> pixel_;
  cv::Mat1w count_;
  cv::Mat1f rho_;  // holds the sum of times until threshold() normalises it
  cv::Mat1f averaged_, previous_;
  cv::Mat1b threshold_mask_, obstacle_mask_;
  double mean_time_ = 0;
  BinomialFilter blur_;
  Morphology morphology_;
  std::vector<int> active_;  // its first active_count_ entries are the pixels with events
  std::size_t active_count_ = 0;
};

}  // namespace dodge

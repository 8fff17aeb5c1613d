// Erosion and dilation of an image by a square, for masks that are nearly empty. Not cv::erode and
// cv::dilate, which allocate in every call.
#pragma once

#include <cstdint>
#include <opencv2/core.hpp>
#include <vector>

namespace dodge {

class Morphology {
 public:
  Morphology(int width_px, int height_px, int max_size_px);

  // Replaces every pixel by the least (erosion) or the greatest (dilation) within a square of
  // size_px whose pixel (anchor_px, anchor_px) lies on it; 0 <= anchor_px < size_px <= max_size_px.
  // Pixels outside of the image do not count. The image has the size given above.
  void erode(cv::Mat1b& image, int size_px, int anchor_px);
  void dilate(cv::Mat1b& image, int size_px, int anchor_px);

 private:
  template <class Extreme>
  void filter(cv::Mat1b& image, int size_px, int anchor_px);
  std::uint8_t* row(int y) { return rows_.data() + static_cast<std::ptrdiff_t>(y) * width_; }

  int width_, height_;
  std::vector<std::uint8_t> padded_;  // a row and its surroundings
  std::vector<std::uint8_t> rows_;    // the image after the filter along x; empty rows are not set
  std::vector<std::uint8_t> empty_;   // rows of zeros only
};

}  // namespace dodge

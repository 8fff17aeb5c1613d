// Averaging of an image by a square binomial kernel: a row of Pascal's triangle, normalised, along
// x and along y. Not cv::GaussianBlur, which allocates in every call.
#pragma once

#include <opencv2/core.hpp>
#include <vector>

namespace dodge {

class BinomialFilter {
 public:
  // size_px: side of the kernel, odd; 1 copies. width_px: of the images.
  BinomialFilter(int size_px, int width_px);

  // Writes the averaged image to `out`, another image of the same size. Pixels outside of the image
  // count as 0. Products are rounded, and summed from the centre outwards, on all processors alike.
  void apply(const cv::Mat1f& image, cv::Mat1f& out);

 private:
  float* averaged_along_x(int y);

  int radius_, width_;
  std::vector<float> weights_;  // of the centre and of the neighbours at 1 .. radius px
  std::vector<float> padded_;   // a row between zeros
  std::vector<float> rows_;     // the last 2 radius + 1 rows, averaged along x
};

}  // namespace dodge

// Disparity of a patch between two images whose rows are shifted against each other.
#pragma once

#include <opencv2/core.hpp>
#include <optional>

namespace dodge {

struct RowShift {
  double shift_px = 0;     // found at (x, y + shift) what is at (x, y), to a fraction of a pixel
  double correlation = 0;  // normalised, at most 1
};

// The shift within [min_shift_px, max_shift_px] at which `image` looks most like the patch of
// `pattern`, by normalised cross-correlation of their positive parts: of rho, these are where the
// object is now, the negative ones are where it was. Where it is best at an end of the range, the
// peak beyond counts. Empty if no shift within correlates. Pixels outside of `image` count as 0.
std::optional<RowShift> find_row_shift(const cv::Mat1f& pattern, const cv::Rect& patch,
                                       const cv::Mat1f& image, int min_shift_px, int max_shift_px);

// The greatest of those correlations over all shifts within [min_shift_px, max_shift_px].
double best_correlation(const cv::Mat1f& pattern, const cv::Rect& patch, const cv::Mat1f& image,
                        int min_shift_px, int max_shift_px);

}  // namespace dodge

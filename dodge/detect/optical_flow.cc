#include "dodge/detect/optical_flow.h"

#include <algorithm>
#include <cmath>

namespace dodge {

void OpticalFlow::set_images(const cv::Mat1f& previous, const cv::Mat1f& current,
                             double elapsed_windows) {
  previous_ = &previous;
  current_ = &current;
  elapsed_windows_ = elapsed_windows;
}

bool OpticalFlow::solve(const cv::Point& pixel, Eigen::Vector2d& displacement) const {
  // Windows are cut off at the border, where the central difference has no neighbour.
  const int radius = config_.window_px / 2;
  const int x0 = std::max(1, pixel.x - radius), x1 = std::min(current_->cols - 2, pixel.x + radius);
  const int y0 = std::max(1, pixel.y - radius), y1 = std::min(current_->rows - 2, pixel.y + radius);
  float xx = 0, xy = 0, yy = 0, xt = 0, yt = 0;
  for (int y = y0; y <= y1; ++y) {
    const float* now = current_->ptr<float>(y);
    const float* above = current_->ptr<float>(y - 1);
    const float* below = current_->ptr<float>(y + 1);
    const float* before = previous_->ptr<float>(y);
    for (int x = x0; x <= x1; ++x) {
      const float gx = 0.5F * (now[x + 1] - now[x - 1]);
      const float gy = 0.5F * (below[x] - above[x]);
      const float gt = now[x] - before[x];
      xx += gx * gx;
      xy += gx * gy;
      yy += gy * gy;
      xt += gx * gt;
      yt += gy * gt;
    }
  }
  const float half_trace = 0.5F * (xx + yy);
  const float determinant = xx * yy - xy * xy;
  const float smaller =
      half_trace - std::sqrt(std::max(0.0F, half_trace * half_trace - determinant));
  const auto area = static_cast<float>((x1 - x0 + 1) * (y1 - y0 + 1));
  if (!(smaller > static_cast<float>(config_.min_eigenvalue) * area) || determinant <= 0) {
    return false;
  }
  displacement = {(xy * yt - yy * xt) / determinant, (xy * xt - xx * yt) / determinant};
  return true;
}

Eigen::Vector2d OpticalFlow::velocity(const cv::Point& pixel) const {
  Eigen::Vector2d displacement;
  if (elapsed_windows_ <= 0 || !solve(pixel, displacement)) return Eigen::Vector2d::Zero();
  const Eigen::Vector2d per_window = displacement / elapsed_windows_;
  const double length = per_window.norm();
  return length > config_.max_px ? per_window * (config_.max_px / length) : per_window;
}

Eigen::Vector2d OpticalFlow::mean_velocity(std::span<const cv::Point> pixels) const {
  const auto samples = static_cast<std::size_t>(config_.samples);
  const std::size_t step = std::max<std::size_t>(1, (pixels.size() + samples - 1) / samples);
  Eigen::Vector2d sum = Eigen::Vector2d::Zero();
  int determined = 0;
  for (std::size_t i = step / 2; i < pixels.size(); i += step) {
    const Eigen::Vector2d v = velocity(pixels[i]);
    if (v.isZero(0)) continue;
    sum += v;
    ++determined;
  }
  return determined > 0 ? Eigen::Vector2d(sum / determined) : sum;
}

}  // namespace dodge

#include "dodge/detect/time_image.h"

#include <algorithm>
#include <limits>

namespace dodge {

TimeImage::TimeImage(const TimeImageConfig& config, int width, int height)
    : config_(config),
      count_(height, width, static_cast<std::uint16_t>(0)),
      rho_(height, width, 0.0F),
      averaged_(height, width, 0.0F),
      previous_(height, width, 0.0F),
      threshold_mask_(height, width, static_cast<std::uint8_t>(0)),
      obstacle_mask_(height, width, static_cast<std::uint8_t>(0)),
      blur_(config.blur_px, width),
      morphology_(width, height, std::max({config.open_px, config.close_px, config.dilate_px})) {
  // One more than pixels: accumulate() writes before it knows whether the entry counts.
  active_.resize(static_cast<std::size_t>(width) * static_cast<std::size_t>(height) + 1);
}

void TimeImage::accumulate(std::span<const std::span<const Event>> pieces,
                           const EgoMotion& ego_motion, TimeUs begin_us, TimeUs end_us) {
  std::uint16_t* count = count_.ptr<std::uint16_t>();
  float* time_sum = rho_.ptr<float>();
  for (const int pixel : active()) {
    count[pixel] = 0;
    time_sum[pixel] = 0;
  }
  active_count_ = 0;

  const float per_us = 1.0F / static_cast<float>(end_us - begin_us);
  for (std::span<const Event> piece : pieces) {
    while (!piece.empty()) {
      const std::size_t size = std::min(piece.size(), kBlock);
      add(piece.first(size), ego_motion, begin_us, per_us);
      piece = piece.subspan(size);
    }
  }
}

void TimeImage::add(std::span<const Event> block, const EgoMotion& ego_motion, TimeUs begin_us,
                    float per_us) {
  std::uint16_t* count = count_.ptr<std::uint16_t>();
  float* time_sum = rho_.ptr<float>();
  place(block, ego_motion);
  for (std::size_t i = 0; i < block.size(); ++i) {
    const int pixel = pixel_[i];
    if (pixel < 0 || count[pixel] == kMostOfPixel) continue;
    // Without a branch: whether a pixel is new cannot be predicted.
    active_[active_count_] = pixel;
    active_count_ += count[pixel] == 0 ? 1 : 0;
    ++count[pixel];
    time_sum[pixel] += per_us * static_cast<float>(block[i].t_us - begin_us);
  }
}

// The compensated pixels of the events.
void TimeImage::place(std::span<const Event> block, const EgoMotion& ego_motion) {
  const int width = count_.cols, height = count_.rows;
  bool inside = true;
  for (const Event& event : block) inside &= event.x < width && event.y < height;
  if (!inside) {
    for (std::size_t i = 0; i < block.size(); ++i) {
      pixel_[i] = compensated_pixel(ego_motion, block[i], width, height);
    }
    return;
  }
  ego_motion.warp(block, u_.data(), v_.data());
  for (std::size_t i = 0; i < block.size(); ++i) {
    pixel_[i] = pixel_at(u_[i], v_[i], width, height);
  }
}

void TimeImage::threshold(double rate_radps) {
  const std::uint16_t* count = count_.ptr<std::uint16_t>();
  float* rho = rho_.ptr<float>();
  double sum = 0;
  for (const int pixel : active()) {
    rho[pixel] /= static_cast<float>(count[pixel]);
    sum += rho[pixel];
  }
  mean_time_ = sum / static_cast<double>(std::max<std::size_t>(1, active_count_));
  const auto mean = static_cast<float>(mean_time_);
  for (const int pixel : active()) rho[pixel] -= mean;

  cv::swap(averaged_, previous_);
  blur_.apply(rho_, averaged_);
  // Above 0, which is what empty pixels have.
  const float cut =
      std::max(static_cast<float>(config_.threshold_a_s * rate_radps + config_.threshold_b),
               std::numeric_limits<float>::min());
  const float* averaged = averaged_.ptr<float>();
  std::transform(averaged, averaged + averaged_.total(), threshold_mask_.ptr<std::uint8_t>(),
                 [cut](float value) { return static_cast<std::uint8_t>(value >= cut ? 255 : 0); });
}

void TimeImage::clean() {
  threshold_mask_.copyTo(obstacle_mask_);
  // For an even size the anchor of the second step of an opening or closing must be mirrored, or
  // the mask would move by a pixel.
  if (const int size = config_.open_px; size > 1) {
    morphology_.erode(obstacle_mask_, size, size / 2);
    morphology_.dilate(obstacle_mask_, size, (size - 1) / 2);
  }
  if (const int size = config_.close_px; size > 1) {
    morphology_.dilate(obstacle_mask_, size, size / 2);
    morphology_.erode(obstacle_mask_, size, (size - 1) / 2);
  }
  if (const int size = config_.dilate_px; size > 1) {
    morphology_.dilate(obstacle_mask_, size, size / 2);
  }
}

}  // namespace dodge

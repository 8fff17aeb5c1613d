#include "sim/playback/rate_check.h"

#include <algorithm>
#include <cmath>
#include <iterator>

#include "dodge/detect/time_image.h"
#include "sim/base/body_axes.h"
#include "sim/bridge/to_dodge.h"

namespace dodgesim {

namespace {

// A window ends when a pixel in the middle of the image would have moved so far and there are
// enough events, and begins anew when that takes too long.
constexpr double kTurnPx = 6;
constexpr TimeUs kLongestUs = 50'000, kCheckedEveryUs = 1000;
constexpr std::size_t kFewestEvents = 200, kMostEvents = 5000;  // the latter are thinned out

// Between two windows passes that part of the time since the first event: a long recording is
// looked at from its beginning to its end, and costs not much more than a short one.
constexpr TimeUs kPartRested = 50;

constexpr TimeUs kShiftStepUs = 10'000, kMostShiftUs = 500'000;

// What is surely better is so by a tenth and by so many standard errors of the mean over at least
// kFewestWindows, and by a half than not turning back: what is passed closely can be turned back a
// little by axes that are wrong.
const double kLeastGain = std::log(1.1), kLeastSharpening = std::log(1.5);
constexpr double kStandardErrors = 4;

// Within cells of so many pixels events are spread evenly when chance alone has them share pixels.
constexpr int kCellPx = 16;

// Means of logarithms that differ by less are taken for the same.
constexpr double kSameGain = 0.03;

constexpr double kMaxErrorPx = 0.1;

}  // namespace

RateCheck::RateCheck(const dodge::CameraModel& camera, const std::vector<ImuReading>& rates,
                     const Eigen::Matrix3d& R_BG)
    : R_GB_(R_BG.transpose()),
      R_CB_(camera.X_BC.linear().transpose()),
      width_(camera.width),
      height_(camera.height),
      px_per_rad_(std::min(camera.fx, camera.fy)),
      ego_motion_({.max_error_px = kMaxErrorPx}, camera),
      counts_(static_cast<std::size_t>(camera.width) * static_cast<std::size_t>(camera.height)) {
  for (const ImuReading& rate : rates) {
    Eigen::Vector3d turned = Eigen::Vector3d::Zero();
    if (!turns_.empty()) {
      const ImuReading& before = rates[turns_.size() - 1];
      turned = turns_.back() +
               0.5 * seconds(rate.t_us - before.t_us) * (before.w_B_radps + rate.w_B_radps);
    }
    stamps_us_.push_back(rate.t_us);
    turns_.push_back(turned);
  }
  for (const Eigen::Matrix3d& axes : all_axes()) axes_.push_back({axes});
  for (TimeUs shift_us = -kMostShiftUs; shift_us <= kMostShiftUs; shift_us += kShiftStepUs) {
    if (shift_us != 0) shifts_.push_back({R_BG, shift_us});
  }
}

// The integral of the rates, which are linear between their stamps and 0 outside of them.
Eigen::Vector3d RateCheck::turned_until(TimeUs t_us) const {
  if (turns_.empty()) return Eigen::Vector3d::Zero();
  const auto after = std::ranges::upper_bound(stamps_us_, t_us);
  if (after == stamps_us_.begin()) return turns_.front();
  if (after == stamps_us_.end()) return turns_.back();
  const auto i = static_cast<std::size_t>(after - stamps_us_.begin());
  const double part = static_cast<double>(t_us - stamps_us_[i - 1]) /
                      static_cast<double>(stamps_us_[i] - stamps_us_[i - 1]);
  return turns_[i - 1] + part * (turns_[i] - turns_[i - 1]);
}

// In the window, of B [rad], if the stamps of the rates were later by shift_us.
Eigen::Vector3d RateCheck::turn(TimeUs shift_us) const {
  return turned_until(end_us_ - shift_us) - turned_until(begin_us_ - shift_us);
}

void RateCheck::add(std::span<const Event> events) {
  for (const Event& event : events) {
    if (event.x >= width_ || event.y >= height_) continue;
    if (!started_) first_us_ = rest_until_us_ = end_us_ = event.t_us;
    started_ = true;
    const bool late = event.t_us < end_us_;
    if (late || event.t_us < rest_until_us_) continue;
    if (window_.empty()) begin_us_ = checked_us_ = event.t_us;
    end_us_ = event.t_us;
    window_.push_back(to_dodge(event));
    if (end_us_ >= checked_us_ + kCheckedEveryUs) end_window_if_due();
  }
}

void RateCheck::end_window_if_due() {
  checked_us_ = end_us_;
  if (window_.size() >= kFewestEvents && px_per_rad_ * turn(0).norm() >= kTurnPx) {
    look_at_window();
    rest_until_us_ = end_us_ + (end_us_ - first_us_) / kPartRested;
    window_.clear();
  } else if (end_us_ - begin_us_ > kLongestUs) {
    window_.clear();
  }
}

void RateCheck::look_at_window() {
  if (const std::size_t step = window_.size() / kMostEvents + 1; step > 1) {
    std::size_t kept = 0;
    for (std::size_t i = 0; i < window_.size(); i += step) window_[kept++] = window_[i];
    window_.resize(kept);
  }
  by_chance_ = pairs_by_chance();
  const double given = contrast(turn(0));
  gain_ += std::log(given / contrast(Eigen::Vector3d::Zero()));
  for (std::vector<Reading>* const readings : {&axes_, &shifts_}) {
    for (Reading& reading : *readings) {
      const double gain = std::log(contrast(reading.R_BG * R_GB_ * turn(reading.shift_us)) / given);
      reading.sum += gain;
      reading.sum_of_squares += gain * gain;
    }
  }
  ++windows_;
}

// Of the window, turned back by turn_B.
double RateCheck::contrast(const Eigen::Vector3d& turn_B) {
  ego_motion_.set_motion(R_CB_ * turn_B / seconds(end_us_ - begin_us_), begin_us_, end_us_);
  u_.resize(window_.size());
  v_.resize(window_.size());
  ego_motion_.warp(window_, u_.data(), v_.data());
  pixels_.clear();
  double pairs = 0;
  for (std::size_t i = 0; i < window_.size(); ++i) {
    const int pixel = dodge::pixel_at(u_[i], v_[i], width_, height_);
    if (pixel < 0) continue;
    pixels_.push_back(pixel);
    pairs += counts_[static_cast<std::size_t>(pixel)]++;
  }
  for (const int pixel : pixels_) counts_[static_cast<std::size_t>(pixel)] = 0;
  return std::max(pairs, by_chance_);
}

// Where hardly a pixel has two events, anything that scatters them has more.
double RateCheck::pairs_by_chance() const {
  const int columns = width_ / kCellPx + 1;
  std::vector<double> counts(static_cast<std::size_t>(columns * (height_ / kCellPx + 1)));
  double pairs = 1;  // never none
  for (const dodge::Event& event : window_) {
    const int cell = event.y / kCellPx * columns + event.x / kCellPx;
    pairs += counts[static_cast<std::size_t>(cell)]++ / (kCellPx * kCellPx);
  }
  return pairs;
}

bool RateCheck::Reading::surely_better(int windows) const {
  if (windows < kFewestWindows) return false;
  const double variance = std::max(0.0, sum_of_squares / windows - mean(windows) * mean(windows));
  return mean(windows) > kLeastGain &&
         mean(windows) > kStandardErrors * std::sqrt(variance / (windows - 1));
}

const RateCheck::Reading* RateCheck::best(std::span<const Reading> readings) const {
  const auto found = std::ranges::max_element(readings, {}, &Reading::sum);
  // Rates that hardly turn blur least where the events hardly move, and explain nothing.
  const bool sharpens = gain_ + found->sum > kLeastSharpening * windows_;
  return sharpens && found->surely_better(windows_) ? &*found : nullptr;
}

RateCheck::Fit RateCheck::fit() const {
  Fit fit;
  fit.windows = windows_;
  if (windows_ == 0) return fit;
  const double given = gain_ / windows_;
  fit.given = std::exp(given);
  if (const Reading* axes = best(axes_)) {
    const auto as_good = [&, most = axes->sum](const Reading& other) {
      return other.sum > most - kSameGain * windows_;
    };
    axes = &*std::ranges::find_if(axes_, as_good);  // a right-handed frame if there is one
    fit.axes = names_of_axes(axes->R_BG);
    fit.right_handed = axes->R_BG.determinant() > 0;
    fit.with_axes = std::exp(given + axes->mean(windows_));
    fit.as_good = static_cast<int>(std::ranges::count_if(axes_, as_good)) - 1;
  }
  if (const Reading* const shift = best(shifts_)) {
    fit.shift_us = shift->shift_us;
    fit.with_shift = std::exp(given + shift->mean(windows_));
  }
  return fit;
}

}  // namespace dodgesim

// A pilot of one's own, as short as one can be that dodges at all: when a part of the upper
// camera's image suddenly has many more events than usual, it steps aside. Its plugin_parameters
// are a number: how many times as many, 3 when the text is empty.
#include <algorithm>
#include <cstdlib>
#include <deque>
#include <stdexcept>
#include <vector>

#include "dodge/plugin.h"

namespace {

class Sidestepper : public dodge::Pilot {
 public:
  Sidestepper(const dodge::CameraModel& camera, double alarm_ratio)
      : columns_(static_cast<std::size_t>(camera.width) / kBlockPx + 1),
        alarm_ratio_(alarm_ratio),
        count_(columns_ * (static_cast<std::size_t>(camera.height) / kBlockPx + 1)),
        usual_(count_.size()) {}

  void add_events(int camera, std::span<const dodge::Event> events) override {
    if (camera != 0) return;
    for (const dodge::Event& event : events) {
      window_.push_back(event);
      ++count_[block_of(event)];
    }
  }
  void add_imu(const dodge::ImuSample& sample) override { w_radps_ = sample.w_WB_B.norm(); }
  void add_state(const dodge::StateEstimate& state) override { state_ = state; }
  void set_goal(const dodge::Goal& goal) override { goal_ = goal; }

  dodge::VelocityCommand update(dodge::TimeUs now_us) override {
    if (alert_from_us_ < 0) alert_from_us_ = now_us + kLearnUs;
    for (; !window_.empty() && window_.front().t_us < now_us - kWindowUs; window_.pop_front()) {
      --count_[block_of(window_.front())];
    }
    if (now_us > step_end_us_) look(now_us);
    dodge::VelocityCommand command;
    command.t_us = now_us;
    command.evading = now_us <= step_end_us_;
    command.v_W = command.evading ? step_W_ : towards_goal();
    return command;
  }

  // For logs and tables; this one does not know where an obstacle is.
  std::span<const dodge::Detection> detections() const override { return {}; }
  std::span<const dodge::Obstacle> obstacles() const override { return {}; }

 private:
  static constexpr std::size_t kBlockPx = 20;        // of the image, in which events are counted
  static constexpr dodge::TimeUs kWindowUs = 10000;  // for so long
  static constexpr dodge::TimeUs kLearnUs = 300000;  // what is usual, before the first step
  static constexpr dodge::TimeUs kStepUs = 400000;   // how long it steps aside
  static constexpr double kStepMps = 5;
  static constexpr double kTurningRadps = 0.5;  // above, the whole image moves
  static constexpr double kFewest = 50;         // more than usual
  static constexpr double kLearning = 0.02;     // a cycle

  std::size_t block_of(const dodge::Event& event) const {
    return event.y / kBlockPx * columns_ + event.x / kBlockPx;
  }

  // For a block with too many events; then steps away from its side of the image, level.
  void look(dodge::TimeUs now_us) {
    const bool alert = now_us > alert_from_us_ && w_radps_ < kTurningRadps;
    for (std::size_t i = 0; i < count_.size(); ++i) {
      if (alert && count_[i] > kFewest + alarm_ratio_ * usual_[i]) {
        const bool on_the_right = i % columns_ >= columns_ / 2;
        const Eigen::Vector3d left_W = state_.q_WB * Eigen::Vector3d::UnitY();
        step_W_ = (on_the_right ? kStepMps : -kStepMps) *
                  Eigen::Vector3d(left_W.x(), left_W.y(), 0).normalized();
        step_end_us_ = now_us + kStepUs;
        return;
      }
      usual_[i] += kLearning * (count_[i] - usual_[i]);
    }
  }

  Eigen::Vector3d towards_goal() const {
    const Eigen::Vector3d way_W = goal_.p_WG - state_.p_WB;
    return way_W * std::min(1.0, goal_.speed_mps / std::max(way_W.norm(), 1e-9));
  }

  std::size_t columns_;
  double alarm_ratio_;
  std::deque<dodge::Event> window_;
  std::vector<int> count_;     // of the window, in each block
  std::vector<double> usual_;  // the same, usually
  double w_radps_ = 0;
  dodge::StateEstimate state_;
  dodge::Goal goal_;
  dodge::TimeUs alert_from_us_ = -1;
  dodge::TimeUs step_end_us_ = -1;
  Eigen::Vector3d step_W_ = Eigen::Vector3d::Zero();
};

std::unique_ptr<dodge::Pilot> make_sidestepper(const dodge::Config& config,
                                               const std::string& parameters) {
  char* end = nullptr;
  const double alarm_ratio = parameters.empty() ? 3 : std::strtod(parameters.c_str(), &end);
  if (!(alarm_ratio >= 1) || (end != nullptr && *end != '\0')) {
    throw std::invalid_argument("plugin_parameters is \"" + parameters +
                                "\", but must be a number of at least 1.");
  }
  return std::make_unique<Sidestepper>(config.cameras.at(0), alarm_ratio);
}

}  // namespace

DODGE_PLUGIN(make_sidestepper)

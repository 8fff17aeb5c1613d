// A plug-in that does what its parameters say.
#include <sys/wait.h>
#include <unistd.h>

#include <cfenv>
#include <cstdio>
#include <cstdlib>
#include <limits>
#include <new>
#include <stdexcept>
#include <vector>

#include "dodge/dodger.h"
#include "dodge/plugin.h"

namespace {

// Flies to its left, whatever comes.
class Leftward : public dodge::Pilot {
 public:
  explicit Leftward(std::string order) : order_(std::move(order)) {}

  void add_events(int, std::span<const dodge::Event>) override {}
  void add_imu(const dodge::ImuSample&) override {}
  void add_state(const dodge::StateEstimate&) override {}
  void set_goal(const dodge::Goal&) override {}
  dodge::VelocityCommand update(dodge::TimeUs now_us) override {
    if (order_ == "throw") throw std::runtime_error("I have lost my way,\nand my map");
    if (order_ == "throw Latin 1") throw std::runtime_error("Verst\xe4rker aus");
    if (order_ == "throw a number") throw 7;
    if (order_ == "round up") std::fesetround(FE_UPWARD);
    if (order_ == "die") std::abort();
    if (order_ == "exit") std::exit(0);
    if (order_ == "print") std::puts("Here I am.");
    if (order_ == "print, then die") std::printf("I am dying"), std::abort();
    if (order_ == "have a child that exits") have_a_child();
    dodge::VelocityCommand command{now_us, Eigen::Vector3d(0, 2, 0), true, false};
    if (order_ == "command nothing") command.v_W.x() = std::numeric_limits<double>::quiet_NaN();
    if (order_ == "race") command.v_W.z() = -1e200;
    if (order_ == "foresee") ++command.t_us;
    if (order_ == "take all memory") throw std::bad_alloc();
    if (order_.starts_with("detect ")) detect(order_.substr(7), now_us);
    return command;
  }
  std::span<const dodge::Detection> detections() const override { return detections_; }
  std::span<const dodge::Obstacle> obstacles() const override { return {}; }

 private:
  static void have_a_child() {
    const pid_t child = ::fork();
    if (child == 0) std::exit(0);
    int status = 0;
    ::waitpid(child, &status, 0);
    if (status != 0) throw std::runtime_error("My child did not end well");
  }

  // Something at the origin, with a fault.
  void detect(const std::string& fault, dodge::TimeUs now_us) {
    const double nan = std::numeric_limits<double>::quiet_NaN();
    dodge::Detection detection;
    detection.t_us = now_us;
    if (fault == "nowhere") detection.centre_W.y() = nan;
    if (fault == "tomorrow") ++detection.t_us;
    if (fault == "long ago") detection.t_us = std::numeric_limits<dodge::TimeUs>::min();
    if (fault == "without a stamp") detection.t_us = dodge::Detection().t_us;
    if (fault == "of the past") detection.t_us = now_us - 1000001;
    if (fault == "less than nothing") detection.size_m = -1;
    if (fault == "at no depth") detection.depth_m = nan;
    if (fault == "without certainty") detection.depth_sigma_m = nan;
    detections_ = {detection};
  }

  std::string order_;
  std::vector<dodge::Detection> detections_;
};

std::unique_ptr<dodge::Pilot> make(const dodge::Config& config, const std::string& parameters) {
  if (parameters == "print") std::puts("I am made.");
  if (parameters == "round up at once") std::fesetround(FE_UPWARD);
  if (parameters == "make nothing") return nullptr;
  if (parameters == "refuse") throw std::invalid_argument("I take no such parameters");
  if (parameters == "refuse with a number") throw 7;
  if (parameters == "die at once") std::abort();
  if (parameters == "exit at once") std::exit(0);
  if (parameters == "take all memory at once") throw std::bad_alloc();
  if (parameters == "be the dodger") return std::make_unique<dodge::Dodger>(config);
  return std::make_unique<Leftward>(parameters);
}

}  // namespace

DODGE_PLUGIN(make)

// A plug-in that does what its parameters say.
#include <cstdlib>
#include <stdexcept>

#include "dodge/dodger.h"
#include "dodge/plugin.h"

namespace {

// Flies to its left, whatever comes; or "fails": throws an exception.
class Leftward : public dodge::Pilot {
 public:
  explicit Leftward(bool fails) : fails_(fails) {}

  void add_events(int, std::span<const dodge::Event>) override {}
  void add_imu(const dodge::ImuSample&) override {}
  void add_state(const dodge::StateEstimate&) override {}
  void set_goal(const dodge::Goal&) override {}
  dodge::VelocityCommand update(dodge::TimeUs now_us) override {
    if (fails_) throw std::runtime_error("I have lost my way.");
    return {now_us, Eigen::Vector3d(0, 2, 0), true, false};
  }
  std::span<const dodge::Detection> detections() const override { return {}; }
  std::span<const dodge::Obstacle> obstacles() const override { return {}; }

 private:
  bool fails_;
};

std::unique_ptr<dodge::Pilot> make(const dodge::Config& config, const std::string& parameters) {
  if (parameters == "nothing") return nullptr;
  if (parameters == "refuse") throw std::invalid_argument("I take no such parameters.");
  if (parameters == "crash") std::abort();
  if (parameters == "dodger") return std::make_unique<dodge::Dodger>(config);
  return std::make_unique<Leftward>(parameters == "fail");
}

}  // namespace

DODGE_PLUGIN(make)

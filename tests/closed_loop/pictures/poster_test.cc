#include "sim/observers/poster.h"

#include <gtest/gtest.h>

#include <array>

#include "dodge/dodger.h"
#include "sim/base/gravity.h"
#include "sim/flight/setup.h"
#include "tests/closed_loop/flights.h"
#include "tests/closed_loop/pictures/decoded.h"
#include "tests/sim/files/temporary_directory.h"

namespace dodgesim {
namespace {

// Says that it detects something, whatever it sees.
class Dreamer : public dodge::Dodger {
 public:
  using dodge::Dodger::Dodger;
  std::span<const dodge::Detection> detections() const override { return dreams_; }

 private:
  std::array<dodge::Detection, 1> dreams_;
};

// A ball in front of a vehicle whose pilot the poster looks at.
class PosterTest : public ::testing::Test {
 protected:
  PosterTest()
      : world_({scenario_.models_dir, "room", "qav_rxl", {{"ball", 0.2}}}),
        pilot_(config()),
        poster_(intrinsics(scenario_.sensors.camera), scenario_.sensors.render) {
    world_.reset({-2, 0, 2}, 0, Eigen::Vector3d::Zero());
    poster_.on_start(pilot_);
    for (TimeUs t_us = 0; t_us <= 20000; t_us += 1000) {
      pilot_.add_imu({t_us, Eigen::Vector3d::Zero(), {0, 0, kGravityMps2}});
      dodge::StateEstimate state;
      state.t_us = t_us;
      pilot_.add_state(state);
    }
    pilot_.update(20000);  // whose images there are from now on
  }

  dodge::Config config() const {
    dodge::Config config = scenario_.dodger;
    config.cameras = camera_models(scenario_, world_.vehicle());
    return config;
  }

  // What the poster shows of the cameras after a cycle with the ball at that distance.
  cv::Mat strip_at(double distance_m) {
    BodyState ball;
    ball.p_W = {-2 + distance_m, 0.1, 2};
    world_.launch(0, ball);
    poster_.on_tick(world_);
    poster_.on_cycle(0, pilot_);
    const std::string file = (directory_ / "poster.png").string();
    OutputFile output(file);
    EXPECT_TRUE(poster_.save(output));
    const cv::Mat picture = testing::decoded(file).at(0);
    return picture.rowRange(600, picture.rows).clone();
  }

  const Scenario scenario_ = scenario("{}");
  World world_;
  Dreamer pilot_;
  Poster poster_;
  const testing::TemporaryDirectory directory_;
};

TEST_F(PosterTest, ShowsTheFirstDetectionOfATrueObject) {
  const auto equal = [](const cv::Mat& a, const cv::Mat& b) {
    return a.size() == b.size() && cv::norm(a, b, cv::NORM_INF) == 0;
  };
  const cv::Mat far = strip_at(3);
  const cv::Mat nearer = strip_at(2);
  EXPECT_FALSE(equal(nearer, far)) << "what was detected was no object";
  poster_.on_first_detection();
  const cv::Mat detected = strip_at(1.5);
  EXPECT_FALSE(equal(detected, nearer));
  EXPECT_TRUE(equal(strip_at(1), detected));
}

// Keeps the cycle that a flight says to be the first to detect an object.
class FirstDetection : public FlightObserver {
 public:
  void on_first_detection() override { ++count_; }
  void on_cycle(TimeUs now_us, const dodge::Pilot&) override {
    if (count_ > 0 && !cycle_us_) cycle_us_ = now_us;
  }

  int count_ = 0;
  std::optional<TimeUs> cycle_us_;
};

TEST(FlightObserver, HearsOfTheFirstDetectionBeforeItsCycle) {
  const Scenario s = scenario(
      "throw: {distance_m: 1.5, speed_mps: 6, size_m: 0.2, launch_s: 0.1}\nafter_s: 0.1\n"
      "sensors: {camera: {width: 160, height: 120}}\n");
  FirstDetection first;
  const FlightRecord record = fly(s, plan_throw(s, 0), &first);
  EXPECT_EQ(first.count_, 1);
  ASSERT_TRUE(first.cycle_us_ && record.detections.first);
  EXPECT_EQ(*first.cycle_us_ + s.delays.pilot_us(), record.detections.first->output_us);
}

}  // namespace
}  // namespace dodgesim

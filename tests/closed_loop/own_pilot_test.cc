// What the pilot dodgesim sees of balls over the open field, and how it flies back.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "tests/closed_loop/flights.h"

namespace dodgesim {
namespace {

constexpr double kBallM = 0.2;
constexpr int kThrows = 4;

struct Detections {
  int whole = 0;      // detections of about the ball's own size
  int too_large = 0;  // with a part of the background
};

// Of balls of 8 m/s that nobody evades.
Detections detections_of(const std::string& cluster) {
  const Scenario s = scenario(
      "room: field\n"
      "pilot: dodgesim\n"
      "seed: 77\n"
      "repeats: " +
      std::to_string(kThrows) +
      "\n"
      "mission: {start_m: [0, 0, 2]}\n"
      "throw: {size_m: 0.2, distance_m: !uniform [3, 4], speed_mps: 8,\n"
      "        bearing_deg: !uniform [-25, 25], launch_height_m: !uniform [1.2, 1.8],\n"
      "        launch_s: 0.1}\n"
      "dodger: {escape: {min_speed_mps: 100}, cluster: " +
      cluster + "}\n");
  Detections found;
  for (int i = 0; i < kThrows; ++i) {
    for (const DetectionRow& row : fly(s, plan_throw(s, i)).detections.rows) {
      if (row.object) ++(row.size_m < 1.5 * kBallM ? found.whole : found.too_large);
    }
  }
  return found;
}

TEST(OwnPilot, KeepsABallApartFromItsBackground) {
  const Detections own = detections_of("{}"), paper = detections_of("{weight_position_1ppx: 0.2}");
  EXPECT_GT(own.whole, 30 * kThrows);
  EXPECT_GT(own.whole, 1.1 * paper.whole);
  EXPECT_LT(own.too_large, paper.too_large);
}

// The greatest tilt [deg] from 0.2 to 0.5 s after an escape, while the vehicle brakes.
class TiltAfterEscape : public FlightObserver {
 public:
  void on_velocity(TimeUs now_us, const dodge::VelocityCommand& command) override {
    if (command.evading) last_us_ = now_us;
  }
  void on_tick(const World& world) override {
    const Snapshot& now = world.snapshot();
    if (last_us_ == 0 || now.t_us < last_us_ + 200000) return;
    whole_ = whole_ || now.t_us >= last_us_ + 500000;
    if (now.t_us > last_us_ + 500000) return;
    const double up_z = (now.vehicle.q_W * Eigen::Vector3d::UnitZ()).z();
    tilt_deg_ = std::max(tilt_deg_, std::acos(std::min(1.0, up_z)) * 180 / std::numbers::pi);
  }
  bool whole() const { return whole_; }  // it has evaded, and braked for so long
  double tilt_deg() const { return tilt_deg_; }

 private:
  TimeUs last_us_ = 0;
  bool whole_ = false;
  double tilt_deg_ = 0;
};

// Balls that the pilot is told of; it escapes mostly upward.
Scenario told_of(double calm_acceleration_mps2, const std::string& after_s) {
  return scenario(
      "room: field\n"
      "pilot: oracle\n"
      "repeats: 4\n"
      "mission: {start_m: [0, 0, 2]}\n"
      "throw: {distance_m: 4, speed_mps: 8, aim_offset_m: [!uniform [-0.15, 0.15], 0],\n"
      "        launch_s: 0.1}\n"
      "after_s: " +
      after_s +
      "\n"
      "dodger: {repulsive: {direction: away}, velocity_limit: {calm_acceleration_mps2: " +
      std::to_string(calm_acceleration_mps2) + "}}\n");
}

std::vector<double> tilts_after_escape(double calm_acceleration_mps2) {
  const Scenario s = told_of(calm_acceleration_mps2, "0.7");
  std::vector<double> tilts_deg;
  for (int i = 0; i < 4; ++i) {
    TiltAfterEscape observer;
    fly(s, plan_throw(s, i), &observer);
    EXPECT_TRUE(observer.whole());
    tilts_deg.push_back(observer.tilt_deg());
  }
  return tilts_deg;
}

TEST(GentleBraking, TiltsTheVehicleLittle) {
  EXPECT_THAT(tilts_after_escape(3), ::testing::Each(::testing::Lt(20)));
  EXPECT_THAT(tilts_after_escape(0), ::testing::Each(::testing::Gt(28)));
}

TEST(GentleBraking, BringsTheVehicleBackToItsPlace) {
  const Scenario s = told_of(3, "8");
  for (int i = 0; i < 4; ++i) {
    Diary diary;
    fly(s, plan_throw(s, i), &diary);
    double farthest_m = 0;
    for (const Snapshot& now : diary.snapshots())
      farthest_m = std::max(farthest_m, (now.vehicle.p_W - Eigen::Vector3d(0, 0, 2)).norm());
    const BodyState& last = diary.snapshots().back().vehicle;
    EXPECT_GT(farthest_m, 1);
    EXPECT_LT((last.p_W - Eigen::Vector3d(0, 0, 2)).norm(), 0.15);
    EXPECT_LT(last.v_W.norm(), 0.2);
  }
}

}  // namespace
}  // namespace dodgesim

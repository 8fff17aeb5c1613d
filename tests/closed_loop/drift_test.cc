// A state estimate that drifts in height, and one that does not: the monitor of the flight core in
// the loop.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "dodge/dodger.h"
#include "dodge/history.h"
#include "tests/closed_loop/flights.h"

namespace dodgesim {
namespace {

// One camera of few pixels costs little.
Scenario hover(double drift_mps, const std::string& monitor = "") {
  return scenario(
      "mission: {start_m: [-2, 0, 2]}\nduration_s: 14\n"
      "dodger: {position: {depth: mono}, height_monitor: {" +
      monitor +
      "}}\n"
      "sensors: {camera: {width: 48, height: 36}, state_estimate: {height_drift_start_s: 1, "
      "height_drift_mps: " +
      std::to_string(drift_mps) + "}}\n");
}

double tilt_rad(const Snapshot& now) {
  return std::acos((now.vehicle.q_W * Eigen::Vector3d::UnitZ()).z());
}

class DriftRate : public ::testing::TestWithParam<double> {};
INSTANTIATE_TEST_SUITE_P(Rates, DriftRate, ::testing::Values(-1.0, -0.3, 0.3, 1.0),
                         [](const auto& info) { return std::to_string(info.index); });

TEST_P(DriftRate, LandsTheVehicleGently) {
  const Scenario s = hover(GetParam());
  const FlightRecord record = fly_as("falanga2020", s);
  EXPECT_TRUE(record.verdict.landed);
  EXPECT_FALSE(record.verdict.crashed);
  EXPECT_EQ(record.last.t_us, record.verdict.landed_us);  // the flight ends there

  // The noise of the range sensor may break the discrepancy for as long as the drift takes to leave
  // four of its standard deviations behind.
  ASSERT_TRUE(record.landing_us);
  const dodge::HeightMonitorConfig& monitor = s.dodger.height_monitor;
  const double rate_mps = std::abs(GetParam());
  const double apart_s = 1 + monitor.threshold_m / rate_mps;
  const double noise_s = 4 * s.sensors.range.sigma_m / rate_mps;
  const double least_s = apart_s - noise_s + 1e-6 * static_cast<double>(monitor.persist_us);
  EXPECT_GT(seconds(*record.landing_us), least_s);
  EXPECT_LT(seconds(*record.landing_us), least_s + 2 * noise_s + 0.03);

  const BodyState& vehicle = record.last.vehicle;
  EXPECT_NEAR(vehicle.v_W.z(), -s.dodger.landing.touchdown_mps, 0.06);
  EXPECT_LT(vehicle.v_W.head<2>().norm(), 0.1);
  EXPECT_LT(tilt_rad(record.last), 0.05);
  EXPECT_LT((vehicle.p_W - s.mission.start_m).head<2>().norm(), 0.3);
  EXPECT_FALSE(record.first_command_us);
}

void expect_crash_at(double height_m, const FlightRecord& record) {
  EXPECT_TRUE(record.verdict.crashed);
  EXPECT_FALSE(record.verdict.landed || record.landing_us);
  EXPECT_NEAR(record.last.vehicle.p_W.z(), height_m, 0.05);
}

constexpr double kTouchingFloorM = 0.0925, kTouchingCeilingM = 5 - 0.0925;  // with the cameras

TEST_P(DriftRate, EndsAtFloorOrCeilingWithoutAMonitor) {
  const double where_m = GetParam() > 0 ? kTouchingFloorM : kTouchingCeilingM;
  expect_crash_at(where_m, fly_as("none", hover(GetParam())));
}

// A ball at a vehicle that believes to be 0.75 m higher than it is.
Scenario thrown_at_drifted() {
  return scenario(
      "mission: {start_m: [-2, 0, 2.75]}\n"
      "throw: {distance_m: 3, speed_mps: 5, size_m: 0.2, launch_height_m: 1.7, launch_s: 1.5}\n"
      "after_s: 0.1\n"
      "dodger: {position: {max_range_m: 3}, height_monitor: {enabled: false}}\n"
      "sensors: {state_estimate: {height_drift_mps: 0.5}}\n");
}

TEST(Drift, DetectionsAreHeldAgainstTheTruthWhereTheEstimateHasIt) {
  const Scenario s = thrown_at_drifted();
  FlightPlan plan = plan_throw(s, 0);
  plan.end_us = plan.launches.at(0).drawn.launch_us + 400000;  // at 1 m; what is near costs time
  Diary diary;
  const FlightRecord record = fly(s, plan, &diary);
  ASSERT_TRUE(record.detections.first);
  ASSERT_GT(record.detections.rows.size(), 2u);
  for (const DetectionRow& row : record.detections.rows) {
    EXPECT_LT(*row.position_error_m, 0.5);
    const Eigen::Map<const Eigen::Vector3d> logged_W(row.true_p_W->data());
    const Eigen::Vector3d drift_W = logged_W - diary.at(row.t_us).objects[0].p_W;
    EXPECT_NEAR(drift_W.z(), 0.5 * seconds(row.output_us), 0.02);
    EXPECT_LT(drift_W.head<2>().norm(), 0.02);
  }
}

TEST(Drift, TheOracleIsToldOfObjectsWhereTheEstimateHasThem) {
  const FlightRecord record = fly_as("oracle", thrown_at_drifted());
  EXPECT_TRUE(record.first_command_us);
  EXPECT_FALSE(record.verdict.nearest.hit);
  EXPECT_FALSE(record.verdict.crashed);
}

TEST(Drift, TheMonitorCanBeSwitchedOff) {
  expect_crash_at(kTouchingFloorM, fly_as("falanga2020", hover(0.9, "enabled: false")));
}

// The flight core's monitor beside any pilot, with what the sensors say.
class MonitorBeside : public FlightObserver {
 public:
  explicit MonitorBeside(const Scenario& scenario) : config_(scenario.dodger) {}

  void on_tick(const World& world) override {
    config_.p_BR = world.vehicle().X_BR.translation();
    largest_tilt_rad_ = std::max(largest_tilt_rad_, tilt_rad(world.snapshot()));
  }
  void on_state(const StateReading& s) override {
    states_.add({s.t_us, s.p_W, s.q_W, s.v_W, s.w_B});
  }
  void on_range(const RangeReading& reading) override {
    const dodge::RangeReading range{reading.t_us, reading.range_m};
    const dodge::StateEstimate state = *states_.at(range.t_us);
    const auto height_m =
        dodge::height_above_ground(config_.range_sensor, config_.p_BR, range, state);
    if (height_m) readings_.push_back({range.t_us, state.p_WB.z(), *height_m});
  }

  bool drifted() const { return drifted_by(config_.height_monitor); }
  // Whether the two heights were ever farther apart.
  bool discrepancy_exceeds(double threshold_m) const {
    dodge::HeightMonitorConfig at_once = config_.height_monitor;
    at_once.threshold_m = threshold_m;
    at_once.persist_us = 0;
    return drifted_by(at_once);
  }
  double largest_tilt_rad() const { return largest_tilt_rad_; }
  int readings() const { return static_cast<int>(readings_.size()); }

 private:
  struct Heights {
    TimeUs t_us;
    double estimated_m, measured_m;
  };

  bool drifted_by(const dodge::HeightMonitorConfig& config) const {
    dodge::HeightMonitor monitor(config);
    for (const Heights& h : readings_) monitor.add(h.t_us, h.estimated_m, h.measured_m);
    return monitor.drifted();
  }

  dodge::Config config_;
  dodge::StateHistory states_;
  std::vector<Heights> readings_;
  double largest_tilt_rad_ = 0;
};

TEST(NoDrift, AMinuteOfHoverStaysFarBelowTheThreshold) {
  const Scenario s = scenario("mission: {start_m: [-2, 0, 2]}\nduration_s: 60\n");
  MonitorBeside beside(s);
  fly_as("none", s, &beside);
  EXPECT_FALSE(beside.drifted());
  EXPECT_GT(beside.readings(), 60 * 200 - 10);
  EXPECT_TRUE(beside.discrepancy_exceeds(0.03));
  EXPECT_FALSE(beside.discrepancy_exceeds(0.15));
}

// Readings at too much tilt are not used, and those that look at furniture or a wall beside the
// vehicle do not last.
TEST(NoDrift, HardDodgesDoNotLandTheVehicle) {
  const Scenario s = scenario(
      "mission: {start_m: [0, 0, 2]}\noracle: {range_cap_m: 2}\n"
      "throw: {count: 6, interval_s: 0.7, launch_s: 0.5, size_m: 0.1, distance_m: 2.5,\n"
      "  speed_mps: 5, bearing_deg: !uniform [-180, 180], launch_height_m: !uniform [1, 2.5]}\n"
      "after_s: 0.5\n");
  int unharmed = 0;
  for (int n = 0; n < 5; ++n) {
    MonitorBeside beside(s);
    const FlightRecord record = fly_as("oracle", s, plan_throw(s, n), &beside);
    EXPECT_FALSE(beside.drifted()) << n;
    if (record.verdict.nearest.hit || record.verdict.crashed) continue;
    ++unharmed;
    EXPECT_GT(beside.largest_tilt_rad(), 0.9) << n;
    const double all = 200 * seconds(record.last.t_us);
    EXPECT_LT(beside.readings(), 0.8 * all) << n;
    EXPECT_GT(beside.readings(), 0.3 * all) << n;
  }
  EXPECT_GE(unharmed, 3);
}

// Each reading beside where a vertical ray meets the ball, if it does.
class RangeBesideBall : public FlightObserver {
 public:
  void on_tick(const World& world) override {
    const Snapshot& now = world.snapshot();
    sensor_W_ = now.vehicle.pose() * world.vehicle().X_BR.translation();
    ball_W_ = now.objects[0].p_W;
    beside_m_ = now.launched[0] ? (ball_W_ - sensor_W_).head<2>().norm() : 1e9;
  }
  void on_range(const RangeReading& reading) override {
    if (std::abs(beside_m_ - kRadiusM) < kTiltedByM) return;
    double first_z_m = 0;
    if (beside_m_ < kRadiusM) {
      ++over_ball_;
      first_z_m = ball_W_.z() + std::sqrt(kRadiusM * kRadiusM - beside_m_ * beside_m_);
    }
    EXPECT_NEAR(reading.range_m, sensor_W_.z() - first_z_m, 0.11) << reading.t_us;
  }

  int over_ball() const { return over_ball_; }

 private:
  static constexpr double kRadiusM = 0.1, kTiltedByM = 0.02;

  Eigen::Vector3d sensor_W_, ball_W_;
  double beside_m_ = 0;
  int over_ball_ = 0;
};

Scenario ball_below() {
  return scenario(
      "mission: {start_m: [-2, 0, 2]}\nthrow: {size_m: 0.2, distance_m: 2.5, speed_mps: 4, "
      "aim_offset_m: [0, -0.9], launch_s: 0.5}\nafter_s: 0.5\n");
}

TEST(NoDrift, ABallThatFliesBelowDoesNotLandTheVehicle) {
  const Scenario s = ball_below();
  MonitorBeside beside(s);
  fly_as("none", s, &beside);
  EXPECT_TRUE(beside.discrepancy_exceeds(2 * s.dodger.height_monitor.threshold_m));
  EXPECT_FALSE(beside.drifted());
}

TEST(RangeSensor, SeesTheBallThatFliesBelow) {
  RangeBesideBall beside;
  const FlightRecord record = fly_as("none", ball_below(), &beside);
  EXPECT_FALSE(record.verdict.nearest.hit);
  EXPECT_GE(beside.over_ball(), 6);  // 0.16 m at 4 m/s, 200 readings a second
}

// The throw comes while the vehicle lands, or has landed: nobody dodges it any more.
TEST(Drift, AThrowThatThePilotGaveUpOnIsNotDodged) {
  const auto fly_with = [](double drift_mps) {
    return fly_throw(
        scenario("fly_oracle: false\nmission: {start_m: [-2, 0, 2]}\n"
                 "throw: {size_m: 0.2, distance_m: 2.5, speed_mps: 5, launch_s: 1}\nafter_s: 0.1\n"
                 "sensors: {camera: {width: 48, height: 36}, state_estimate: {height_drift_mps: " +
                 std::to_string(drift_mps) + "}}\n"),
        0);
  };
  const ThrowResult drifts = fly_with(1), holds = fly_with(0);
  ASSERT_TRUE(drifts.flown.ok() && drifts.none.hit && holds.none.hit);
  ASSERT_TRUE(drifts.landing_us);
  EXPECT_LT(*drifts.landing_us, *drifts.none.hit_us);
  EXPECT_TRUE(drifts.gave_up());
  EXPECT_FALSE(drifts.evaded);
  EXPECT_FALSE(holds.landing_us || holds.landed_us || holds.gave_up());
}

}  // namespace
}  // namespace dodgesim

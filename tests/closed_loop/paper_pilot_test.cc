// The whole chain: pictures, events, packets, the paper's pilot, controller, motors.
#include <gtest/gtest.h>

#include <algorithm>
#include <map>

#include "tests/closed_loop/flights.h"

namespace dodgesim {
namespace {

constexpr const char* kThrow =
    "mission: {start_m: [-2, 0, 2]}\n"
    "throw: {distance_m: 3, speed_mps: 5, size_m: 0.2, launch_height_m: 1.7, launch_s: 0.2}\n"
    "after_s: 0.1\n"
    "dodger: {position: {max_range_m: 3}}\n";

TEST(PaperPilot, DetectsAThrowThenEvades) {
  Scenario s = scenario(kThrow);
  s.sensors.state_estimate.position_walk_m_sqrts = 0;  // then the world's frame is the estimate's
  FlightPlan plan = plan_throw(s, 0);
  plan.end_us = plan.launches.at(0).drawn.launch_us + 400000;  // at 1 m; what is near costs time
  const Throw& drawn = plan.launches.at(0).drawn;
  Diary diary;
  const FlightRecord record = fly(s, plan, &diary);
  ASSERT_TRUE(record.detections.first);
  ASSERT_TRUE(record.first_command_us);
  EXPECT_GT(record.events[0], 1000);
  EXPECT_GT(record.events[1], 1000);

  // Nothing acts before light, link, computer and command could have done their part.
  const DelaySpec& d = s.delays;
  const TimeUs latency_us = s.sensors.events.latency_us;
  EXPECT_GT(record.detections.first->output_us,
            drawn.launch_us + latency_us + d.transport_us + d.compute_us);
  EXPECT_GE(*record.first_command_us,
            record.detections.first->output_us + d.command_us + d.flight_controller_us);
  EXPECT_LT(*record.first_command_us, drawn.arrival_us());

  ASSERT_GT(record.detections.rows.size(), 2u);
  std::vector<double> errors_m;
  for (const DetectionRow& row : record.detections.rows) {
    EXPECT_GT(row.t_us, drawn.launch_us);
    EXPECT_GE(row.output_us, row.t_us + d.transport_us + d.compute_us);
    ASSERT_TRUE(row.object && row.true_p_W && row.position_error_m && row.true_depth_m);
    EXPECT_EQ(*row.object, 0);
    // The truth is that of the instant of which the detection speaks, to a tick's
    // motion.
    const Snapshot truth = diary.at(row.t_us);
    const Eigen::Map<const Eigen::Vector3d> logged_W(row.true_p_W->data());
    EXPECT_LT((logged_W - truth.objects[0].p_W).norm(), 2 * 5 * seconds(kTickUs));
    const Eigen::Map<const Eigen::Vector3d> p_W(row.p_W.data());
    EXPECT_NEAR((p_W - logged_W).norm(), *row.position_error_m, 1e-12);
    errors_m.push_back(*row.position_error_m);
  }
  // Detections of the ball, not of something else.
  std::sort(errors_m.begin(), errors_m.end());
  EXPECT_LT(errors_m[errors_m.size() / 2], 0.3);
}

// Whether the pilot has come to see an object, though it may not have said so yet.
class Seeing : public FlightObserver {
 public:
  void on_first_detection() override { seen = true; }
  bool seen = false;
};

TEST(PaperPilot, HasNotDetectedWhatItWouldHaveSaidAfterTheHit) {
  const std::string late = kThrow + std::string("delays: {perception_us: 600000}\n");
  const Scenario s = scenario(late + "fly_oracle: false\n");
  Seeing pilot;
  const FlightRecord record = fly(s, plan_throw(s, 0), &pilot);
  ASSERT_TRUE(record.verdict.nearest.hit);
  EXPECT_TRUE(pilot.seen);
  EXPECT_TRUE(record.detections.rows.empty());
  EXPECT_FALSE(record.detections.first);
  EXPECT_FALSE(record.detections.first_of_object.at(0));
}

// Ends the flight early: the plan says when.
FlightRecord first_part(const Scenario& scenario, FlightPlan plan) {
  plan.end_us = plan.launches.at(0).drawn.launch_us + 100000;
  return fly(scenario, plan);
}

TEST(PaperPilot, TheSameThrowGivesTheSameEventsAndDetections) {
  Scenario s = scenario(kThrow);
  s.throw_spec->launch_s = Distribution::constant(0.1);
  const FlightPlan plan = plan_throw(s, 0);
  const FlightRecord a = first_part(s, plan), b = first_part(s, plan);
  EXPECT_EQ(a.events_hash, b.events_hash);
  EXPECT_EQ(a.events, b.events);
  EXPECT_EQ(a.last.vehicle.p_W, b.last.vehicle.p_W);
  ASSERT_EQ(a.detections.rows.size(), b.detections.rows.size());
  EXPECT_GT(a.detections.rows.size(), 1u);
  for (std::size_t i = 0; i < a.detections.rows.size(); ++i) {
    EXPECT_EQ(a.detections.rows[i].t_us, b.detections.rows[i].t_us);
    EXPECT_EQ(a.detections.rows[i].p_W, b.detections.rows[i].p_W);
    EXPECT_EQ(a.detections.rows[i].size_m, b.detections.rows[i].size_m);
    EXPECT_EQ(a.detections.rows[i].position_error_m, b.detections.rows[i].position_error_m);
  }
  s.seed = 2;
  EXPECT_NE(first_part(s, plan).events_hash, a.events_hash);
}

TEST(PaperPilot, DodgesNothingInAQuietHover) {
  const Scenario s = scenario("mission: {start_m: [-2, 0, 2]}\nduration_s: 1\n");
  const FlightRecord record = fly(s, plan_throw(s, 0));
  EXPECT_FALSE(record.first_command_us);
  EXPECT_GT(record.events[0], 10000);  // it does look, and sees noise
}

// Events of the top camera, by the packet's end.
class EventCounts : public FlightObserver {
 public:
  void on_events(int camera, const Packet& packet) override {
    if (camera == 0) counts_[packet.end_us] += packet.events.size();
  }
  double mean(TimeUs after_us, TimeUs until_us) const {
    double sum = 0;
    for (const auto& [end_us, count] : counts_) {
      if (end_us > after_us && end_us <= until_us) sum += static_cast<double>(count);
    }
    return sum / (1e-3 * static_cast<double>(until_us - after_us));
  }

 private:
  std::map<TimeUs, std::size_t> counts_;
};

TEST(PaperPilot, ABallThatComesIntoExistenceIsNoFlash) {
  Scenario s = scenario(kThrow);
  s.throw_spec->launch_s = Distribution::constant(0.1);
  s.throw_spec->distance_m = Distribution::constant(1.5);  // large in the image: 600 px
  FlightPlan plan = plan_throw(s, 0);
  plan.end_us = 104000;
  EventCounts counts;
  fly(s, plan, &counts);
  const double before = counts.mean(90000, 100000), after = counts.mean(100000, 102000);
  EXPECT_LT(after, before + 150);
}

// Counts the packets that come later than the start of the first cycle that should have them.
class LatePackets : public FlightObserver {
 public:
  explicit LatePackets(const DelaySpec& delays) : delays_(delays) {}
  void on_tick(const World& world) override { now_us_ = world.snapshot().t_us; }
  void on_events(int /*camera*/, const Packet& packet) override {
    const TimeUs arrival_us = packet.end_us + delays_.transport_us;
    const TimeUs cycle_us = (arrival_us + delays_.cycle_us - 1) / delays_.cycle_us;
    late_ += now_us_ > cycle_us * delays_.cycle_us;
    ++count_;
  }
  int late() const { return late_; }
  int count() const { return count_; }

 private:
  DelaySpec delays_;
  TimeUs now_us_ = 0;
  int late_ = 0, count_ = 0;
};

TEST(PaperPilot, NoPacketIsLateWhateverTheTransportTakes) {
  for (const int transport_us : {1000, 3300, 4500, 9000}) {
    Scenario s = scenario("mission: {start_m: [-2, 0, 2]}\nduration_s: 0.1\n");
    s.sensors.sampling.min_rate_hz = 20;
    s.delays.transport_us = transport_us;
    LatePackets packets(s.delays);
    fly(s, plan_throw(s, 0), &packets);
    EXPECT_GT(packets.count(), 100);
    EXPECT_EQ(packets.late(), 0) << transport_us;
  }
}

}  // namespace
}  // namespace dodgesim

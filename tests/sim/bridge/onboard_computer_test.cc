#include "sim/bridge/onboard_computer.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <map>

namespace dodgesim {
namespace {

using ::testing::Each;
using ::testing::ElementsAre;
using ::testing::Ge;

// Something that reached the pilot: its stamp and the start of the cycle that had it first.
struct Arrival {
  TimeUs stamp_us;
  TimeUs cycle_us;
  TimeUs age_us() const { return cycle_us - stamp_us; }
};

std::vector<TimeUs> stamps(const std::vector<Arrival>& arrivals) {
  std::vector<TimeUs> out;
  for (const Arrival& a : arrivals) out.push_back(a.stamp_us);
  return out;
}

std::vector<TimeUs> ages(const std::vector<Arrival>& arrivals) {
  std::vector<TimeUs> out;
  for (const Arrival& a : arrivals) out.push_back(a.age_us());
  return out;
}

struct Log {
  std::map<int, std::vector<Arrival>> events;  // by camera
  std::vector<Arrival> imu, states, ranges;
  std::vector<TimeUs> cycles;
  dodge::Goal goal;
  dodge::ImuSample last_imu;
  dodge::StateEstimate last_state;
  dodge::Event last_event;
  dodge::RangeReading last_range;
};

// Writes down what it is handed. Its command carries the cycle's start as a velocity.
class RecordingPilot : public dodge::Pilot {
 public:
  explicit RecordingPilot(Log& log) : log_(log) {}

  void add_events(int camera, std::span<const dodge::Event> events) override {
    for (const dodge::Event& e : events) new_events_.push_back({camera, e.t_us});
    if (!events.empty()) log_.last_event = events.back();
  }
  void add_imu(const dodge::ImuSample& sample) override {
    new_imu_.push_back(sample.t_us);
    log_.last_imu = sample;
  }
  void add_state(const dodge::StateEstimate& state) override {
    new_states_.push_back(state.t_us);
    log_.last_state = state;
  }
  void add_range(const dodge::RangeReading& reading) override {
    new_ranges_.push_back(reading.t_us);
    log_.last_range = reading;
  }
  void set_goal(const dodge::Goal& goal) override { log_.goal = goal; }

  dodge::VelocityCommand update(TimeUs now_us) override {
    for (const auto& [camera, t_us] : new_events_) log_.events[camera].push_back({t_us, now_us});
    new_events_.clear();
    move_to(log_.imu, new_imu_, now_us);
    move_to(log_.states, new_states_, now_us);
    move_to(log_.ranges, new_ranges_, now_us);
    log_.cycles.push_back(now_us);
    return {now_us, Eigen::Vector3d(static_cast<double>(now_us), 0, 0), true};
  }
  std::span<const dodge::Detection> detections() const override { return {}; }
  std::span<const dodge::Obstacle> obstacles() const override { return {}; }

 private:
  static void move_to(std::vector<Arrival>& out, std::vector<TimeUs>& stamps, TimeUs now_us) {
    for (const TimeUs t_us : stamps) out.push_back({t_us, now_us});
    stamps.clear();
  }

  Log& log_;
  std::vector<std::pair<int, TimeUs>> new_events_;
  std::vector<TimeUs> new_imu_, new_states_, new_ranges_;
};

// A command, when it came out of the computer.
struct Output {
  TimeUs cycle_us;
  TimeUs at_us;
};

// Carries a recording pilot tick by tick, with IMU, state, range and event packets of two cameras.
struct Bench {
  explicit Bench(const DelaySpec& delay_spec)
      : delays(delay_spec), computer(delays, std::make_unique<RecordingPilot>(log)) {}

  void send_packets(TimeUs now_us) {
    const TimeUs period_us = delays.packet_us;
    if (now_us % period_us != 0) return;
    // The first and the last instant that belong to the packet.
    const std::vector<Event> packet = {{now_us - period_us + 1, 3, 4, 1}, {now_us, 5, 6, -1}};
    for (int camera = 0; camera < 2; ++camera) computer.send_events(camera, now_us, packet);
  }

  void run(TimeUs end_us) {
    for (TimeUs now_us = kTickUs; now_us <= end_us; now_us += kTickUs) {
      if (now_us % 1000 == 0) computer.send_imu({now_us, {1, 2, 3}, {4, 5, 6}});
      if (now_us % 4000 == 0) computer.send_state({now_us, {}, {}, {}, {}});
      if (now_us % 20000 == 0) computer.send_range({now_us, 2.0});
      send_packets(now_us);
      computer.run_cycle(now_us);
      if (const auto command = computer.take_command(now_us)) {
        outputs.push_back({command->t_us, now_us});
      }
    }
  }

  Log log;
  DelaySpec delays;
  OnboardComputer computer;
  std::vector<Output> outputs;
};

// What arrives waits for the next cycle, and no longer.
void expect_delayed(const std::vector<Arrival>& arrivals, TimeUs delay_us) {
  ASSERT_GT(arrivals.size(), 100u);
  for (const Arrival& a : arrivals) {
    const TimeUs arrival_us = a.stamp_us + delay_us;
    EXPECT_EQ(a.cycle_us, (arrival_us + 3999) / 4000 * 4000) << a.stamp_us;
  }
}

TEST(OnboardComputer, DeliversEachKindOfReadingAtTheFirstCycleAfterItsDelay) {
  DelaySpec delays;
  delays.imu_us = 500;
  delays.state_estimate_us = 1700;
  delays.range_us = 2600;
  Log log;
  OnboardComputer computer(delays, std::make_unique<RecordingPilot>(log));
  for (TimeUs now_us = kTickUs; now_us <= 400000; now_us += kTickUs) {
    if (now_us % 750 == 0) computer.send_imu({now_us, {}, {}});
    if (now_us % 1250 == 0) computer.send_state({now_us, {}, {}, {}, {}});
    if (now_us % 1750 == 0) computer.send_range({now_us, 2.0});
    computer.run_cycle(now_us);
  }
  expect_delayed(log.imu, delays.imu_us);
  expect_delayed(log.states, delays.state_estimate_us);
  expect_delayed(log.ranges, delays.range_us);
}

TEST(OnboardComputer, DeliversNoEventBeforeItsStampPlusTheDelay) {
  Bench bench{DelaySpec{}};
  bench.run(400000);
  const DelaySpec& delays = bench.delays;
  for (int camera = 0; camera < 2; ++camera) {
    EXPECT_THAT(ages(bench.log.events[camera]),
                Each(::testing::AllOf(
                    Ge(delays.transport_us),
                    ::testing::Lt(delays.transport_us + delays.cycle_us + delays.packet_us))));
  }
}

TEST(OnboardComputer, EventsWaitForTheEndOfTheirPacket) {
  Bench bench{DelaySpec{}};
  bench.run(100000);
  const TimeUs delay_us = bench.delays.transport_us;
  ASSERT_FALSE(bench.log.events[0].empty());
  for (const Arrival& event : bench.log.events[0]) {
    const TimeUs end_us = (event.stamp_us + 999) / 1000 * 1000;
    EXPECT_GE(event.cycle_us, end_us + delay_us);
  }
}

TEST(OnboardComputer, KeepsTheOrderOfEachKindAndLosesNothing) {
  Bench bench{DelaySpec{}};
  bench.run(40000);  // the last cycle starts now: it has everything up to 40 ms - delay
  std::vector<TimeUs> imu, states, events;
  for (TimeUs t_us = 1000; t_us <= 39000; t_us += 1000) imu.push_back(t_us);
  for (TimeUs t_us = 4000; t_us <= 36000; t_us += 4000) states.push_back(t_us);
  for (TimeUs end_us = 1000; end_us <= 39000; end_us += 1000) {
    events.push_back(end_us - 999);
    events.push_back(end_us);
  }
  EXPECT_EQ(stamps(bench.log.imu), imu);
  EXPECT_EQ(stamps(bench.log.states), states);
  EXPECT_THAT(stamps(bench.log.ranges), ElementsAre(20000));
  EXPECT_EQ(stamps(bench.log.events[0]), events);
  EXPECT_EQ(stamps(bench.log.events[1]), events);
}

TEST(OnboardComputer, StartsACycleEveryPeriod) {
  Bench bench{DelaySpec{}};
  bench.run(17000);
  EXPECT_THAT(bench.log.cycles, ElementsAre(4000, 8000, 12000, 16000));
}

TEST(OnboardComputer, ASlowPilotMakesFewerCycles) {
  DelaySpec delays;
  delays.compute_us = 60000;
  Bench bench{delays};
  bench.run(250000);
  EXPECT_THAT(bench.log.cycles, ElementsAre(60000, 120000, 180000, 240000));
}

TEST(OnboardComputer, CyclesStartAtTicks) {
  DelaySpec delays;
  delays.compute_us = 4100;
  Bench bench{delays};
  bench.run(13000);
  EXPECT_THAT(bench.log.cycles, ElementsAre(4250, 8500, 12750));
}

TEST(OnboardComputer, ACommandAppearsOnceWhenItsComputationEnds) {
  Bench bench{DelaySpec{}};
  bench.run(16000);
  ASSERT_EQ(bench.outputs.size(), 3u);
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_EQ(bench.outputs[i].cycle_us, static_cast<TimeUs>(4000 * (i + 1)));
    EXPECT_EQ(bench.outputs[i].at_us, bench.outputs[i].cycle_us + 3500);
  }
}

TEST(OnboardComputer, APipelinedPerceptionIsLateButNotRare) {
  DelaySpec delays;
  delays.perception_us = 56500;
  Bench bench{delays};
  bench.run(80000);
  ASSERT_GE(bench.log.cycles.size(), 19u);  // one every 4 ms
  ASSERT_GE(bench.outputs.size(), 4u);
  for (std::size_t i = 0; i < bench.outputs.size(); ++i) {
    EXPECT_EQ(bench.outputs[i].cycle_us, static_cast<TimeUs>(4000 * (i + 1)));
    EXPECT_EQ(bench.outputs[i].at_us, bench.outputs[i].cycle_us + 60000);
  }
}

TEST(OnboardComputer, OnlyTheNewestOfSeveralCommandsCounts) {
  Log log;
  OnboardComputer computer(DelaySpec{}, std::make_unique<RecordingPilot>(log));
  EXPECT_FALSE(computer.take_command(100000));
  for (const TimeUs t_us : {4000, 8000, 12000}) ASSERT_TRUE(computer.run_cycle(t_us));
  EXPECT_FALSE(computer.take_command(7499));
  const auto command = computer.take_command(11500);
  ASSERT_TRUE(command);
  EXPECT_EQ(command->v_W.x(), 8000);
  EXPECT_TRUE(command->evading);
  EXPECT_FALSE(computer.take_command(11500));
}

TEST(OnboardComputer, RunsNoCycleBeforeItsTime) {
  Log log;
  OnboardComputer computer(DelaySpec{}, std::make_unique<RecordingPilot>(log));
  EXPECT_FALSE(computer.run_cycle(3750));
  EXPECT_EQ(computer.next_cycle_us(), 4000);
  EXPECT_TRUE(computer.run_cycle(4000));
  EXPECT_FALSE(computer.run_cycle(4000));
  EXPECT_EQ(computer.next_cycle_us(), 8000);
  EXPECT_THAT(log.cycles, ElementsAre(4000));
}

// The packet that ends at newest_packet_end_us() has arrived by that cycle, the next one has not.
TEST(DelaySpec, SaysWhichPacketIsTheNewestThatACycleHas) {
  DelaySpec delays;
  delays.packet_us = 250;
  for (const int transport_us : {0, 650, 1000, 3900, 9000}) {
    delays.transport_us = transport_us;
    Bench bench{delays};
    bench.run(40000);
    std::map<TimeUs, TimeUs> newest;  // by cycle
    for (const Arrival& e : bench.log.events[1]) newest[e.cycle_us] = e.stamp_us;
    ASSERT_GT(newest.size(), 5u);
    for (const auto& [cycle_us, stamp_us] : newest) {
      EXPECT_EQ(stamp_us, delays.newest_packet_end_us(cycle_us));
    }
  }
}

TEST(OnboardComputer, ThePacketsOfOneCameraDoNotHoldUpThoseOfTheOther) {
  DelaySpec delays;
  delays.transport_us = 1100;
  Log log;
  OnboardComputer computer(delays, std::make_unique<RecordingPilot>(log));
  // One camera's later packet is handed over before the other's earlier one, as when both come out
  // of one tick.
  computer.send_events(0, 2875, std::vector<Event>{{2875, 0, 0, 1}});
  computer.send_events(0, 3000, std::vector<Event>{{3000, 0, 0, 1}});
  computer.send_events(1, 2875, std::vector<Event>{{2875, 0, 0, 1}});
  computer.run_cycle(4000);
  EXPECT_THAT(stamps(log.events[0]), ElementsAre(2875));
  EXPECT_THAT(stamps(log.events[1]), ElementsAre(2875));
}

TEST(OnboardComputer, ThePacketsOfTheLowerCameraMayComeLater) {
  DelaySpec delays;
  delays.lower_camera_us = 700;
  Log log;
  OnboardComputer computer(delays, std::make_unique<RecordingPilot>(log));
  for (int camera = 0; camera < 2; ++camera) {
    for (const TimeUs t : {2000, 3000}) {
      computer.send_events(camera, t, std::vector<Event>{{t, 0, 0, 1}});
    }
  }
  computer.run_cycle(4000);
  EXPECT_THAT(stamps(log.events[0]), ElementsAre(2000, 3000));
  EXPECT_THAT(stamps(log.events[1]), ElementsAre(2000));
}

TEST(OnboardComputer, HandsOverWhatTheSensorsSaid) {
  Log log;
  OnboardComputer computer(DelaySpec{}, std::make_unique<RecordingPilot>(log));
  computer.set_goal({{7, 8, 9}, 1.25});
  computer.send_imu({1000, {1, 2, 3}, {4, 5, 6}});
  const Eigen::Quaterniond q_W(Eigen::AngleAxisd(0.3, Eigen::Vector3d::UnitY()));
  computer.send_state({1000, {1, 2, 3}, q_W, {4, 5, 6}, {7, 8, 9}});
  computer.send_events(0, 1000, std::vector<Event>{{999, 3, 4, -1}});
  computer.send_range({1000, 2.5});
  computer.run_cycle(4000);
  EXPECT_EQ(log.last_event.t_us, 999);
  EXPECT_EQ(log.last_event.x, 3);
  EXPECT_EQ(log.last_event.y, 4);
  EXPECT_EQ(log.last_event.polarity, -1);
  EXPECT_EQ(log.last_range.range_m, 2.5);
  EXPECT_EQ(log.goal.p_WG, Eigen::Vector3d(7, 8, 9));
  EXPECT_EQ(log.goal.speed_mps, 1.25);
  EXPECT_EQ(log.last_imu.w_WB_B, Eigen::Vector3d(1, 2, 3));
  EXPECT_EQ(log.last_imu.f_B, Eigen::Vector3d(4, 5, 6));
  EXPECT_EQ(log.last_state.p_WB, Eigen::Vector3d(1, 2, 3));
  EXPECT_EQ(log.last_state.q_WB.coeffs(), q_W.coeffs());
  EXPECT_EQ(log.last_state.v_WB, Eigen::Vector3d(4, 5, 6));
  EXPECT_EQ(log.last_state.w_WB_B, Eigen::Vector3d(7, 8, 9));
}

}  // namespace
}  // namespace dodgesim

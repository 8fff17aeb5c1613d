#include "sim/playback/playback.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <map>

#include "sim/base/error.h"
#include "sim/base/random.h"
#include "tests/complaint.h"

namespace dodgesim {
namespace {

using testing::complaint;
using ::testing::HasSubstr;

// Hands out events in portions of odd sizes.
class ListedEvents : public EventReader {
 public:
  explicit ListedEvents(std::vector<Event> events) : events_(std::move(events)) {}
  std::span<const Event> next() override {
    const std::size_t count = std::min<std::size_t>(7, events_.size() - read_);
    read_ += count;
    return std::span(events_).subspan(read_ - count, count);
  }
  double part_read() const override {
    return static_cast<double>(read_) / static_cast<double>(events_.size());
  }

 private:
  std::vector<Event> events_;
  std::size_t read_ = 0;
};

// Writes down in which cycle each thing reaches it. Its command carries the cycle.
class Witness : public dodge::Pilot {
 public:
  struct Arrivals {
    std::map<int, std::vector<std::pair<TimeUs, TimeUs>>> events;  // by camera: stamp, cycle
    std::vector<std::pair<TimeUs, TimeUs>> imu, states, ranges;
    std::vector<dodge::StateEstimate> estimates;
    std::vector<TimeUs> cycles;
    std::vector<Eigen::Vector3d> goals;  // of each cycle
  };

  explicit Witness(Arrivals& seen) : seen_(seen) {}
  void add_events(int camera, std::span<const dodge::Event> events) override {
    for (const dodge::Event& event : events) new_.events[camera].emplace_back(event.t_us, 0);
  }
  void add_imu(const dodge::ImuSample& sample) override { new_.imu.emplace_back(sample.t_us, 0); }
  void add_state(const dodge::StateEstimate& state) override {
    new_.states.emplace_back(state.t_us, 0);
    seen_.estimates.push_back(state);
  }
  void add_range(const dodge::RangeReading& r) override { new_.ranges.emplace_back(r.t_us, 0); }
  void set_goal(const dodge::Goal& goal) override { goal_ = goal.p_WG; }
  dodge::VelocityCommand update(TimeUs now_us) override {
    seen_.cycles.push_back(now_us);
    seen_.goals.push_back(goal_);
    for (auto& [camera, events] : new_.events) move(events, seen_.events[camera], now_us);
    move(new_.imu, seen_.imu, now_us);
    move(new_.states, seen_.states, now_us);
    move(new_.ranges, seen_.ranges, now_us);
    return {now_us, Eigen::Vector3d(static_cast<double>(now_us), 0, 0), true, false};
  }
  std::span<const dodge::Detection> detections() const override { return {}; }
  std::span<const dodge::Obstacle> obstacles() const override { return {}; }

 private:
  using Stamps = std::vector<std::pair<TimeUs, TimeUs>>;
  static void move(Stamps& from, Stamps& to, TimeUs now_us) {
    for (const auto& [stamp_us, cycle] : from) to.emplace_back(stamp_us, now_us);
    from.clear();
  }

  Arrivals& seen_;
  Arrivals new_;
  Eigen::Vector3d goal_ = Eigen::Vector3d::Constant(std::nan(""));
};

// Hands out the same event without end.
class OneInstant : public EventReader {
 public:
  std::span<const Event> next() override { return events_; }
  double part_read() const override { return 0; }

 private:
  std::vector<Event> events_ = std::vector<Event>(10000, Event{77, 1, 1, 1});
};

std::vector<Event> random_events(TimeUs first_us, std::size_t count, std::uint64_t seed) {
  RandomStream random(seed, 0, "events");
  std::vector<Event> events;
  TimeUs t_us = first_us;
  for (std::size_t i = 0; i < count; ++i) {
    events.push_back({t_us, static_cast<std::uint16_t>(i % 300), 2, 1});
    t_us += static_cast<TimeUs>(random.uniform(0, 150));
  }
  return events;
}

RecordedSensors sensors_of(const std::vector<std::vector<Event>>& cameras) {
  RecordedSensors sensors;
  for (const auto& events : cameras) {
    sensors.cameras.push_back(std::make_unique<ListedEvents>(events));
  }
  return sensors;
}

Witness::Arrivals play(const DelaySpec& delays, RecordedSensors sensors) {
  Witness::Arrivals seen;
  Playback playback(delays, std::make_unique<Witness>(seen), std::move(sensors));
  while (playback.next()) {
    EXPECT_EQ(playback.now_us(), seen.cycles.back());
    EXPECT_EQ(playback.command().v_W.x(), static_cast<double>(playback.now_us()));
  }
  return seen;
}

constexpr TimeUs kEpochUs = 1600000000001234;

// Stamps of a log, one every period from `first_us` on.
template <class Reading>
std::vector<Reading> every(TimeUs period_us, TimeUs first_us, std::size_t count) {
  std::vector<Reading> log(count);
  for (std::size_t i = 0; i < count; ++i) {
    log[i].t_us = first_us + static_cast<TimeUs>(i) * period_us;
  }
  return log;
}

// Each reading that has arrived did so in the first cycle that is `delay_us` later than its stamp.
void expect_prompt(const std::vector<std::pair<TimeUs, TimeUs>>& arrivals, TimeUs delay_us,
                   const std::vector<TimeUs>& cycles) {
  ASSERT_FALSE(arrivals.empty());
  for (const auto& [stamp_us, cycle_us] : arrivals) {
    EXPECT_EQ(cycle_us, *std::lower_bound(cycles.begin(), cycles.end(), stamp_us + delay_us));
  }
}

TEST(Playback, HandsOverEverythingAsLateAsInFlight) {
  DelaySpec delays;
  delays.packet_us = 1500;
  delays.transport_us = 700;
  delays.imu_us = 300;
  const std::vector<std::vector<Event>> cameras = {random_events(kEpochUs, 2000, 1),
                                                   random_events(kEpochUs + 9000, 1500, 2)};
  RecordedSensors sensors = sensors_of(cameras);
  sensors.imu = every<ImuReading>(1000, kEpochUs - 500, 150);
  sensors.states = every<StateReading>(4000, kEpochUs - 700, 40);
  sensors.ranges = every<RangeReading>(5000, kEpochUs + 100, 30);
  const Witness::Arrivals seen = play(delays, std::move(sensors));

  ASSERT_FALSE(seen.cycles.empty());
  for (std::size_t i = 0; i < seen.cycles.size(); ++i) {
    EXPECT_EQ(seen.cycles[i] % delays.period_us(), 0);
    EXPECT_EQ(seen.cycles[i] - seen.cycles[0], static_cast<TimeUs>(i) * delays.period_us());
  }
  for (int camera = 0; camera < 2; ++camera) {
    const auto& arrivals = seen.events.at(camera);
    const auto& sent = cameras[static_cast<std::size_t>(camera)];
    ASSERT_EQ(arrivals.size(), sent.size());
    for (std::size_t i = 0; i < sent.size(); ++i) {
      ASSERT_EQ(arrivals[i].first, sent[i].t_us);
      // The end of its packet, then the way to the computer, then the next cycle.
      const TimeUs packets = (sent[i].t_us + delays.packet_us - 1) / delays.packet_us;
      const TimeUs arrival_us = packets * delays.packet_us + delays.transport_us;
      ASSERT_EQ(arrivals[i].second,
                *std::lower_bound(seen.cycles.begin(), seen.cycles.end(), arrival_us));
    }
  }
  expect_prompt(seen.imu, delays.imu_us, seen.cycles);
  expect_prompt(seen.states, delays.state_estimate_us, seen.cycles);
  expect_prompt(seen.ranges, delays.range_us, seen.cycles);
}

TEST(Playback, ThePilotIsToStayWhereItIs) {
  RecordedSensors sensors = sensors_of({random_events(kEpochUs, 1000, 1)});
  sensors.states =
      every<StateReading>(3000, kEpochUs + 7000, 40);  // from the second cycle or so on
  for (std::size_t i = 0; i < sensors.states.size(); ++i) {
    sensors.states[i].p_W = Eigen::Vector3d(1 + static_cast<double>(i), 2, 3);
  }
  const std::vector<StateReading> states = sensors.states;
  const Witness::Arrivals seen = play({}, std::move(sensors));
  ASSERT_GT(seen.cycles.size(), 10u);
  std::size_t newest = 0;
  for (std::size_t i = 0; i < seen.cycles.size(); ++i) {
    while (newest + 1 < states.size() && states[newest + 1].t_us <= seen.cycles[i]) ++newest;
    EXPECT_EQ(seen.goals[i], states[newest].p_W);
  }
  const Witness::Arrivals blind = play({}, sensors_of({random_events(kEpochUs, 1000, 1)}));
  EXPECT_TRUE(blind.goals.front().isZero());
}

TEST(Playback, PutsEventsThatStandALittleTooLateInTheFileInOrder) {
  const std::vector<Event> events = random_events(kEpochUs, 3000, 3);
  std::vector<Event> shuffled = events;
  RandomStream random(8, 0, "order");
  std::vector<std::pair<double, Event>> arrivals;
  for (const Event& event : events) {
    arrivals.emplace_back(static_cast<double>(event.t_us) + random.uniform(0, 9000), event);
  }
  std::stable_sort(arrivals.begin(), arrivals.end(),
                   [](const auto& a, const auto& b) { return a.first < b.first; });
  for (std::size_t i = 0; i < events.size(); ++i) shuffled[i] = arrivals[i].second;
  ASSERT_NE(shuffled, events);
  const auto ordered = play({}, sensors_of({events})).events.at(0);
  EXPECT_EQ(play({}, sensors_of({shuffled})).events.at(0), ordered);
}

TEST(Playback, HandsOverAnEventThatStandsFarTooLateInTheFile) {
  std::vector<Event> events = random_events(0, 1000, 3);
  events[900].t_us = events[10].t_us;
  const Witness::Arrivals seen = play({}, sensors_of({events}));
  const auto& arrivals = seen.events.at(0);
  ASSERT_EQ(arrivals.size(), events.size());
  const auto late = std::find_if(arrivals.begin() + 500, arrivals.end(), [&](const auto& arrival) {
    return arrival.first == events[10].t_us;
  });
  ASSERT_NE(late, arrivals.end());
  EXPECT_GE(late->second + EventQueue::kSortedUs, events[899].t_us);
}

// An hour of these would be played in one cycle, in which no pilot sees them.
TEST(Playback, CountsWhatStandsFarTooLateInTheFile) {
  std::vector<Event> events = random_events(0, 1000, 3);
  events[900].t_us = events[10].t_us;
  // What a camera says before its clock is set to zero.
  std::vector<Event> after_restart = random_events(5'000'000, 100, 4);
  after_restart.insert(after_restart.end(), events.begin(), events.end());
  for (const auto& [file, late] : {std::pair{events, 1}, std::pair{after_restart, 1000}}) {
    Witness::Arrivals seen;
    Playback playback({}, std::make_unique<Witness>(seen), sensors_of({file}));
    EXPECT_EQ(playback.late(0), 0);
    while (playback.next()) {
    }
    EXPECT_EQ(playback.late(0), late);
    EXPECT_EQ(playback.events(0), static_cast<std::int64_t>(file.size()));
  }
}

// A little ahead and an hour, at the beginning, in the middle, and before the last event.
TEST(Playback, IsNotHeldUpByAStray) {
  const std::vector<Event> events = random_events(kEpochUs, 3000, 9);
  const auto expected = play({}, sensors_of({events})).events.at(0);
  for (const TimeUs ahead_us : {TimeUs{30'000}, TimeUs{3'600'000'000}}) {
    for (const std::size_t place : {0, 1500, 2999}) {
      std::vector<Event> with_stray = events;
      with_stray.insert(with_stray.begin() + static_cast<std::ptrdiff_t>(place),
                        {events[place].t_us + ahead_us, 1, 1, 1});
      Witness::Arrivals seen;
      Playback playback({}, std::make_unique<Witness>(seen), sensors_of({with_stray}));
      double part = 0;
      while (playback.next()) {
        EXPECT_GE(playback.part_played(0), part);
        part = playback.part_played(0);
      }
      EXPECT_EQ(part, 1);
      EXPECT_EQ(playback.strays(0), 1) << ahead_us << " " << place;
      EXPECT_EQ(playback.events(0), 3000);
      EXPECT_EQ(seen.events.at(0), expected) << ahead_us << " " << place;
    }
  }
}

TEST(Playback, WithoutStatesTurnsAsTheRatesSayAndStaysInItsPlace) {
  // A constant rate about an axis of B: the closed form is a turn about it.
  const Eigen::Vector3d w(0.4, -1.1, 2.3);
  RecordedSensors sensors = sensors_of({random_events(kEpochUs, 4000, 4)});
  sensors.imu = every<ImuReading>(1000, kEpochUs, 280);
  for (ImuReading& reading : sensors.imu) reading.w_B_radps = w;
  const Witness::Arrivals seen = play({}, std::move(sensors));
  ASSERT_GT(seen.estimates.size(), 200u);
  for (const dodge::StateEstimate& state : seen.estimates) {
    const double t_s = seconds(state.t_us - kEpochUs);
    const Eigen::Quaterniond expected(Eigen::AngleAxisd(w.norm() * t_s, w.normalized()));
    EXPECT_LT(state.q_WB.angularDistance(expected), 1e-9);
    EXPECT_EQ(state.p_WB, Eigen::Vector3d::Zero());
    EXPECT_EQ(state.w_WB_B, w);
  }
}

TEST(Playback, WithoutStatesIsAtRestUntilTheFirstRate) {
  const Eigen::Vector3d w(0, 0, 3);
  RecordedSensors sensors = sensors_of({random_events(kEpochUs, 1000, 4)});
  sensors.imu = every<ImuReading>(1000, kEpochUs + 30000, 30);
  for (ImuReading& reading : sensors.imu) reading.w_B_radps = w;
  const Witness::Arrivals seen = play({}, std::move(sensors));
  ASSERT_GT(seen.estimates.size(), 10u);
  EXPECT_LE(seen.estimates[0].t_us, kEpochUs);
  EXPECT_TRUE(seen.estimates[0].w_WB_B.isZero());
  for (std::size_t i = 1; i < seen.estimates.size(); ++i) {
    const dodge::StateEstimate& state = seen.estimates[i];
    const double t_s = seconds(state.t_us - kEpochUs - 30000);
    const Eigen::Quaterniond expected(Eigen::AngleAxisd(3 * t_s, Eigen::Vector3d::UnitZ()));
    EXPECT_LT(state.q_WB.angularDistance(expected), 1e-9);
    EXPECT_EQ(state.w_WB_B, w);
  }
}

TEST(Playback, WithoutStatesAndRatesIsAtRest) {
  const Witness::Arrivals seen = play({}, sensors_of({random_events(kEpochUs, 1000, 5)}));
  ASSERT_EQ(seen.estimates.size(), 1u);
  EXPECT_LE(seen.estimates[0].t_us, kEpochUs);
  EXPECT_TRUE(seen.imu.empty());
}

TEST(Playback, RefusesRecordingsThatCannotBePlayed) {
  const auto refusal = [](RecordedSensors sensors) {
    return complaint<ScenarioError>([&] { play({}, std::move(sensors)); });
  };
  EXPECT_EQ(refusal(sensors_of({{}, {}})), "Camera 0 and Camera 1 have no event.");
  RecordedSensors named = sensors_of({{}});
  named.files = {"e.txt"};
  EXPECT_EQ(refusal(std::move(named)), "e.txt has no event.");
  RecordedSensors other_clock = sensors_of({random_events(kEpochUs, 100, 6)});
  other_clock.imu = every<ImuReading>(1000, 0, 100);
  EXPECT_THAT(refusal(std::move(other_clock)), HasSubstr("must have one clock"));
  std::vector<Event> jump = random_events(0, 100, 7);
  jump.insert(jump.end(), EventQueue::kAhead + 1, {3'600'000'000, 1, 1, 1});
  RecordedSensors jumping = sensors_of({jump});
  jumping.files = {"e.txt"};
  EXPECT_EQ(refusal(std::move(jumping)), "e.txt has an event at 3600000000 us after one at " +
                                             std::to_string(jump[99].t_us) +
                                             " us: gaps of more than ten minutes are not played.");
  // Each is stamped earlier than the one before it.
  std::vector<Event> backwards = random_events(0, 600, 8);
  for (std::size_t i = 0; i < backwards.size(); ++i) {
    backwards[i].t_us = 20000 * static_cast<TimeUs>(backwards.size() - i);
  }
  EXPECT_EQ(refusal(sensors_of({backwards})),
            "Camera 0 must be in order of time, but 599 of its 600 events are stamped far ahead of "
            "those behind them.");
  RecordedSensors instant;
  instant.cameras.push_back(std::make_unique<OneInstant>());
  EXPECT_THAT(refusal(std::move(instant)),
              HasSubstr("more than 10000000 events from 77 to 77 us, more than a camera can see"));
}

}  // namespace
}  // namespace dodgesim

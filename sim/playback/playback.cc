#include "sim/playback/playback.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "sim/base/error.h"
#include "sim/base/joined.h"
#include "sim/base/rotation.h"

namespace dodgesim {

namespace {

constexpr std::size_t kMostHeld = 10'000'000;  // in 14 ms; no camera is as fast

// Hands over the readings up to now_us, of which the first `sent` have been.
template <class Reading, class Send>
void send_until(TimeUs now_us, const std::vector<Reading>& log, std::size_t& sent, Send send) {
  for (; sent < log.size() && log[sent].t_us <= now_us; ++sent) send(log[sent]);
}

// A single reading, such as the state of a camera that stays where it is, may be of any time
// before.
template <class Reading>
void expect_near(TimeUs event_us, const std::vector<Reading>& log, const char* name) {
  if (log.empty()) return;
  const bool soon = log.front().t_us < event_us + EventQueue::kLongestGapUs;
  if (soon && (log.size() == 1 || log.back().t_us > event_us)) return;
  throw ScenarioError(std::string("The ") + name + " log is from " +
                      std::to_string(log.front().t_us) + " to " + std::to_string(log.back().t_us) +
                      " us, but the first event comes at " + std::to_string(event_us) +
                      " us: all files must have one clock.");
}

}  // namespace

Playback::Playback(const DelaySpec& delays, std::unique_ptr<dodge::Pilot> pilot,
                   RecordedSensors sensors)
    : delays_(delays),
      computer_(delays, std::move(pilot)),
      imu_(std::move(sensors.imu)),
      states_(std::move(sensors.states)),
      ranges_(std::move(sensors.ranges)) {
  TimeUs first_us = std::numeric_limits<TimeUs>::max();
  for (std::size_t i = 0; i < sensors.cameras.size(); ++i) {
    const std::string name =
        i < sensors.files.size() ? sensors.files[i] : "Camera " + std::to_string(i);
    eyes_.emplace_back(name, std::move(sensors.cameras[i]), delays.packet_us);
    const Event* first = eyes_.back().queue.front();
    if (first != nullptr) first_us = std::min(first_us, first->t_us);
  }
  if (first_us == std::numeric_limits<TimeUs>::max()) {
    throw ScenarioError(joined(eyes_, &Eye::name, " and ") +
                        (eyes_.size() == 1 ? " has no event." : " have no event."));
  }
  first_event_us_ = last_event_us_ = first_us;
  now_us_ = first_us / delays.period_us() * delays.period_us();
  expect_same_clock();
  if (states_.empty()) states_ = states_from_rates();
}

void Playback::expect_same_clock() const {
  expect_near(first_event_us_, imu_, "IMU's");
  expect_near(first_event_us_, states_, "state's");
  expect_near(first_event_us_, ranges_, "range sensor's");
}

void Playback::expect_few_strays() const {
  for (const Eye& eye : eyes_) {
    const std::int64_t strays = eye.queue.strays(), all = strays + eye.count;
    constexpr auto kAtTheEnd = static_cast<std::int64_t>(EventQueue::kAhead);  // of any recording
    if (2 * (strays - kAtTheEnd) <= all) continue;
    throw ScenarioError(eye.name + " must be in order of time, but " + std::to_string(strays) +
                        " of its " + std::to_string(all) +
                        " events are stamped far ahead of those behind them.");
  }
}

// The attitude that the IMU's rates add up to, from that of W at its first reading and before it;
// the place stays the origin.
std::vector<StateReading> Playback::states_from_rates() const {
  std::vector<StateReading> states;
  const bool late = imu_.empty() || imu_.front().t_us > first_event_us_;
  if (late) states.push_back({.t_us = now_us_});
  for (const ImuReading& reading : imu_) {
    StateReading state{.t_us = reading.t_us, .w_B = reading.w_B_radps};
    if (states.size() > (late ? 1 : 0)) {
      const StateReading& before = states.back();
      const Eigen::Vector3d turn =
          0.5 * seconds(state.t_us - before.t_us) * (before.w_B + state.w_B);
      state.q_W = (before.q_W * rotation(turn)).normalized();
    }
    states.push_back(state);
  }
  return states;
}

std::int64_t Playback::events(int camera) const {
  return eyes_.at(static_cast<std::size_t>(camera)).count;
}

TimeUs Playback::first_event_us(int camera) const {
  return eyes_.at(static_cast<std::size_t>(camera)).first_us;
}

TimeUs Playback::last_event_us(int camera) const {
  return eyes_.at(static_cast<std::size_t>(camera)).last_us;
}

std::span<const Event> Playback::new_events(int camera) const {
  return eyes_.at(static_cast<std::size_t>(camera)).due;
}

std::int64_t Playback::late(int camera) const {
  return eyes_.at(static_cast<std::size_t>(camera)).late;
}

std::int64_t Playback::strays(int camera) const {
  return eyes_.at(static_cast<std::size_t>(camera)).queue.strays();
}

double Playback::part_played(int camera) const {
  return eyes_.at(static_cast<std::size_t>(camera)).queue.part_taken();
}

bool Playback::next() {
  const bool ended = std::ranges::all_of(
      eyes_, [](const Eye& e) { return e.queue.front() == nullptr && e.held.empty(); });
  const int last_camera = static_cast<int>(eyes_.size()) - 1;
  const TimeUs transport_us = delays_.transport_us_of(last_camera);
  if (ended && now_us_ >= last_event_us_ + delays_.packet_us + transport_us) {
    expect_few_strays();
    return false;
  }
  now_us_ += delays_.period_us();
  send_readings();
  for (std::size_t camera = 0; camera < eyes_.size(); ++camera) {
    send_events(static_cast<int>(camera));
  }
  computer_.run_cycle(now_us_);
  const auto command = computer_.take_command(now_us_ + delays_.pilot_us());
  command_ = command.value_or(dodge::VelocityCommand{});
  return true;
}

void Playback::send_readings() {
  send_until(now_us_, imu_, imu_sent_, [this](const auto& r) { computer_.send_imu(r); });
  send_until(now_us_, states_, states_sent_, [this](const auto& r) { computer_.send_state(r); });
  computer_.set_goal({.p_WG = states_[std::max<std::size_t>(states_sent_, 1) - 1].p_W});
  send_until(now_us_, ranges_, ranges_sent_, [this](const auto& r) { computer_.send_range(r); });
}

// Reads the events up to the first that is later.
void Playback::hold(Eye& eye, TimeUs until_us) {
  for (; eye.queue.front() != nullptr && eye.queue.front()->t_us <= until_us; eye.queue.pop()) {
    const Event& event = *eye.queue.front();
    eye.newest_us = std::max(eye.newest_us, event.t_us);
    if (event.t_us < eye.newest_us - EventQueue::kSortedUs) ++eye.late;
    eye.held.push_back(event);
    if (eye.held.size() <= kMostHeld) continue;
    throw ScenarioError(eye.name + " has more than " + std::to_string(kMostHeld) + " events from " +
                        std::to_string(eye.held.front().t_us) + " to " +
                        std::to_string(eye.held.back().t_us) +
                        " us, more than a camera can see: is t in microseconds?");
  }
  const auto earlier = [](const Event& a, const Event& b) { return a.t_us < b.t_us; };
  if (!std::ranges::is_sorted(eye.held, earlier)) {
    std::ranges::stable_sort(eye.held, earlier);
  }
}

void Playback::send_events(int camera) {
  Eye& eye = eyes_[static_cast<std::size_t>(camera)];
  hold(eye, now_us_ + EventQueue::kSortedUs);
  const auto due =
      std::ranges::find_if(eye.held, [this](const Event& event) { return event.t_us > now_us_; });
  eye.due.assign(eye.held.begin(), due);
  eye.held.erase(eye.held.begin(), due);
  if (!eye.due.empty()) {
    last_event_us_ = std::max(last_event_us_, eye.due.back().t_us);
    if (eye.count == 0) eye.first_us = eye.due.front().t_us;
    eye.last_us = eye.due.back().t_us;
  }
  eye.count += std::ssize(eye.due);
  eye.packetizer.push(eye.due, now_us_);
  while (const auto packet = eye.packetizer.take()) {
    computer_.send_events(camera, packet->end_us, packet->events);
  }
  const Event* next = eye.queue.front();
  if (!eye.held.empty() || next == nullptr ||
      next->t_us <= last_event_us_ + EventQueue::kLongestGapUs)
    return;
  throw ScenarioError(eye.name + " has an event at " + std::to_string(next->t_us) +
                      " us after one at " + std::to_string(last_event_us_) +
                      " us: gaps of more than ten minutes are not played.");
}

}  // namespace dodgesim

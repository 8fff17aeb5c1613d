#include "dodge/history.h"

#include <cmath>

namespace dodge {

namespace {

constexpr std::size_t kSamples = 2048;   // half a second at 4 kHz
constexpr double kUnitTolerance = 1e-3;  // of the square of q_WB's length

// A sample that is so much older than the one before is of a clock that was set back.
constexpr TimeUs kSetBackUs = 100000;

// In place of the oldest one when the history is full. Of a clock that was set back the new time
// alone counts.
template <class Sample>
void keep(RingBuffer<Sample>& history, const Sample& sample) {
  if (!history.empty() && sample.t_us < history.back().t_us - kSetBackUs) {
    history.pop_front(history.size());
  }
  if (history.size() == history.capacity()) history.pop_front();
  history.push_back(sample);
}

Eigen::Vector3d interpolate(const ImuSample& a, const ImuSample& b, TimeUs t_us) {
  if (b.t_us <= a.t_us) return b.w_WB_B;
  const double s = static_cast<double>(t_us - a.t_us) / static_cast<double>(b.t_us - a.t_us);
  return a.w_WB_B + s * (b.w_WB_B - a.w_WB_B);
}

bool is_usable(const StateEstimate& state) {
  return state.p_WB.allFinite() && state.v_WB.allFinite() && state.w_WB_B.allFinite() &&
         std::abs(state.q_WB.squaredNorm() - 1) <= kUnitTolerance;  // false for NaN
}

StateEstimate carry_on(const StateEstimate& from, TimeUs t_us) {
  const double dt_s = seconds(t_us - from.t_us);
  StateEstimate state = from;
  state.t_us = t_us;
  state.p_WB += dt_s * from.v_WB;
  const Eigen::Vector3d turn = dt_s * from.w_WB_B;
  if (turn.norm() > 0) state.q_WB = from.q_WB * Eigen::AngleAxisd(turn.norm(), turn.normalized());
  return state;
}

StateEstimate between(const StateEstimate& a, const StateEstimate& b, TimeUs t_us) {
  const double s = static_cast<double>(t_us - a.t_us) / static_cast<double>(b.t_us - a.t_us);
  StateEstimate state;
  state.t_us = t_us;
  state.p_WB = a.p_WB + s * (b.p_WB - a.p_WB);
  state.q_WB = a.q_WB.slerp(s, b.q_WB);
  state.v_WB = a.v_WB + s * (b.v_WB - a.v_WB);
  state.w_WB_B = a.w_WB_B + s * (b.w_WB_B - a.w_WB_B);
  return state;
}

}  // namespace

RateHistory::RateHistory() : samples_(kSamples) {}

void RateHistory::add(const ImuSample& sample) {
  if (sample.w_WB_B.allFinite()) keep(samples_, sample);
}

std::optional<TimeUs> RateHistory::newest_us() const {
  return samples_.empty() ? std::nullopt : std::optional(samples_.back().t_us);
}

Eigen::Vector3d RateHistory::at(TimeUs t_us) const {
  if (t_us <= samples_.front().t_us) return samples_.front().w_WB_B;
  if (t_us >= samples_.back().t_us) return samples_.back().w_WB_B;
  std::size_t i = samples_.size() - 1;
  while (samples_[i - 1].t_us > t_us) --i;
  return interpolate(samples_[i - 1], samples_[i], t_us);
}

Eigen::Vector3d RateHistory::mean(TimeUs begin_us, TimeUs end_us) const {
  if (samples_.empty()) return Eigen::Vector3d::Zero();
  if (end_us <= begin_us) return at(end_us);
  // Trapezoids from the end backwards: the samples needed are the newest ones.
  Eigen::Vector3d integral = Eigen::Vector3d::Zero();
  TimeUs t_us = end_us;
  Eigen::Vector3d rate = at(end_us);
  const auto add_piece = [&](TimeUs to_us, const Eigen::Vector3d& to_rate) {
    integral += 0.5 * static_cast<double>(t_us - to_us) * (rate + to_rate);
    t_us = to_us;
    rate = to_rate;
  };
  for (std::size_t i = samples_.size(); i-- > 0 && samples_[i].t_us > begin_us;) {
    if (samples_[i].t_us < end_us) add_piece(samples_[i].t_us, samples_[i].w_WB_B);
  }
  add_piece(begin_us, at(begin_us));
  return integral / static_cast<double>(end_us - begin_us);
}

StateHistory::StateHistory() : states_(kSamples) {}

void StateHistory::add(const StateEstimate& state) {
  if (is_usable(state)) keep(states_, state);
}

std::optional<TimeUs> StateHistory::newest_us() const {
  return states_.empty() ? std::nullopt : std::optional(states_.back().t_us);
}

std::optional<StateEstimate> StateHistory::at(TimeUs t_us) const {
  if (states_.empty()) return std::nullopt;
  std::size_t later = states_.size();
  while (later > 0 && states_[later - 1].t_us > t_us) --later;
  if (later == 0) return carry_on(states_.front(), t_us);
  if (later == states_.size()) return carry_on(states_.back(), t_us);
  return between(states_[later - 1], states_[later], t_us);
}

}  // namespace dodge

#include "dodge/detect/state_history.h"

#include <cmath>

namespace dodge {

namespace {

constexpr std::size_t kStates = 2048;    // half a second at 4 kHz
constexpr double kUnitTolerance = 1e-3;  // of the square of q_WB's length

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

StateHistory::StateHistory() : states_(kStates) {}

void StateHistory::add(const StateEstimate& state) {
  if (!is_usable(state)) return;
  if (states_.size() == states_.capacity()) states_.pop_front();
  states_.push_back(state);
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

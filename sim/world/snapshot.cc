#include "sim/world/snapshot.h"

#include <iterator>

namespace dodgesim {

namespace {

BodyState interpolate(const BodyState& a, const BodyState& b, double s) {
  BodyState out;
  out.p_W = a.p_W + s * (b.p_W - a.p_W);
  out.q_W = a.q_W.slerp(s, b.q_W);
  out.v_W = a.v_W + s * (b.v_W - a.v_W);
  out.w_W = a.w_W + s * (b.w_W - a.w_W);
  return out;
}

}  // namespace

Snapshot interpolate(const Snapshot& a, const Snapshot& b, TimeUs t_us) {
  if (t_us <= a.t_us) return a;
  if (t_us >= b.t_us) return b;
  const double s = static_cast<double>(t_us - a.t_us) / static_cast<double>(b.t_us - a.t_us);
  Snapshot out = b;
  out.t_us = t_us;
  out.vehicle = interpolate(a.vehicle, b.vehicle, s);
  out.vehicle_a_W = a.vehicle_a_W + s * (b.vehicle_a_W - a.vehicle_a_W);
  for (std::size_t i = 0; i < out.objects.size(); ++i) {
    // A launch between a and b moves the object there at once: do not interpolate across it.
    if (a.launched[i] == b.launched[i]) out.objects[i] = interpolate(a.objects[i], b.objects[i], s);
  }
  return out;
}

void SnapshotHistory::add(const Snapshot& now) {
  snapshots_.push_back(now);
  while (snapshots_.front().t_us < now.t_us - kKeptUs) snapshots_.pop_front();
}

std::optional<Snapshot> SnapshotHistory::at(TimeUs t_us) const {
  if (snapshots_.empty() || t_us < snapshots_.front().t_us) return std::nullopt;
  const auto found = std::ranges::lower_bound(snapshots_, t_us, {}, &Snapshot::t_us);
  if (found == snapshots_.end()) return std::nullopt;
  return found->t_us == t_us ? *found : interpolate(*std::prev(found), *found, t_us);
}

}  // namespace dodgesim

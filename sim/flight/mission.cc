#include "sim/flight/mission.h"

namespace dodgesim {

Mission::Mission(const MissionSpec& spec)
    : goals_(spec.waypoints_m), radius_m_(spec.waypoint_radius_m), speed_mps_(spec.speed_mps) {
  if (goals_.empty()) goals_ = {spec.goal_m.value_or(spec.start_m)};
}

bool Mission::update(const Eigen::Vector3d& p_W) {
  const std::size_t before = next_;
  while (next_ + 1 < goals_.size() && (p_W - goals_[next_]).norm() <= radius_m_) ++next_;
  return next_ != before;
}

}  // namespace dodgesim

// Where the vehicle flies when it does not dodge.
#pragma once

#include <Eigen/Dense>
#include <vector>

#include "dodge/types.h"
#include "sim/config/scenario.h"

namespace dodgesim {

// One goal after the other. It knows only where the vehicle believes it is.
class Mission {
 public:
  explicit Mission(const MissionSpec& spec);

  dodge::Goal goal() const { return {goals_[next_], speed_mps_}; }

  // A new estimate of the position. Returns whether the goal is another one now.
  bool update(const Eigen::Vector3d& p_W);

 private:
  std::vector<Eigen::Vector3d> goals_;  // not empty
  double radius_m_;
  double speed_mps_;
  std::size_t next_ = 0;
};

}  // namespace dodgesim

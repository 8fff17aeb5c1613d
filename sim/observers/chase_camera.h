// The camera of pictures and videos: behind and beside the vehicle, a little above, so that one
// sees where throws come from.
#pragma once

#include <Eigen/Dense>
#include <optional>

#include "sim/render/scene_pictures.h"
#include "sim/world/snapshot.h"

namespace dodgesim {

class ChaseCamera {
 public:
  // How far the vehicle moves before the camera goes along: dodges are seen to be movements.
  static constexpr double kLeashM = 0.8;

  explicit ChaseCamera(double distance_m) { view_.distance_m = distance_m; }

  // Call while the vehicle moves. The first call sets where the camera is.
  const PictureView& follow(const BodyState& vehicle);

 private:
  PictureView view_;
  std::optional<Eigen::Vector3d> followed_W_;  // never farther than the leash from the vehicle
};

}  // namespace dodgesim

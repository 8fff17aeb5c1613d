// Where the vehicle and its objects have been, as dots in a picture: the newest ones.
#pragma once

#include <cstddef>
#include <vector>

#include "sim/render/scene_pictures.h"
#include "sim/world/snapshot.h"

namespace dodgesim {

class Trail {
 public:
  Trail(double radius_m, std::size_t most) : radius_m_(radius_m), most_(most) {}

  // A dot for the vehicle and for each launched object.
  void extend(const Snapshot& now);
  const std::vector<PictureDot>& dots() const { return dots_; }

 private:
  double radius_m_;
  std::size_t most_;
  std::vector<PictureDot> dots_;
};

}  // namespace dodgesim

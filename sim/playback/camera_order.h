// Whether the events of two cameras, one above the other, are those of the upper and of the lower
// one, or swapped: what is near stands lower in the image of the upper camera.
#pragma once

#include <vector>

#include "dodge/detect/cluster.h"

namespace dodgesim {

class CameraOrder {
 public:
  // What moves in the images of a cycle. Counted are cycles in which each camera sees one thing,
  // and both in the same columns, as cameras that are rectified do.
  void add(const std::vector<dodge::Cluster>& upper, const std::vector<dodge::Cluster>& lower);

  int counted() const { return as_given_ + swapped_; }
  int swapped() const { return swapped_; }  // of these
  bool surely_swapped() const { return swapped_ >= 10 && swapped_ >= 5 * as_given_; }

 private:
  int as_given_ = 0, swapped_ = 0;  // cycles
};

}  // namespace dodgesim

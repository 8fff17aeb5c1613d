// Mapping of depth z_C to a depth buffer of OpenGL.
#pragma once

namespace dodgesim {

// value = offset + slope / z_C: 0 at near_m, 1 at far_m.
struct DepthRange {
  double near_m, far_m;
  double offset() const { return far_m / (far_m - near_m); }
  double slope() const { return -far_m * near_m / (far_m - near_m); }
};

}  // namespace dodgesim

// What a scenario changes about the model of its vehicle. Physics, flight controller and pilot are
// all told: it is another vehicle, not a wrong idea of the same one.
#pragma once

namespace dodgesim {

struct VehicleOverrides {
  double mass_scale = 1;
  double inertia_scale = 1;
  double max_thrust_n = 0;
  double stereo_baseline_m = 0;

  template <class Visitor>
  void visit(Visitor& v) {
    v("mass_scale", mass_scale, 0.1, 10,
      "Factor on the vehicle's mass. Its air drag, a force, stays what it is.");
    v("inertia_scale", inertia_scale, 0.1, 10, "Factor on its moments of inertia.");
    v("max_thrust_n", max_thrust_n, 0, 1000,
      "Greatest thrust of a rotor, in place of the model's; 0: as in the model. Four of them must "
      "lift at least 1.2 times the weight.");
    v("stereo_baseline_m", stereo_baseline_m, 0, 1,
      "Distance between the two cameras, each moved as far from their middle, which stays; the "
      "pilot's calibration has it, too. 0: as in the model.");
  }
};

}  // namespace dodgesim

// What the pilots that know the truth may see. An object that they have seen pass (it flies away
// from where the vehicle is, and falling freely it will come no nearer to a vehicle that flies on)
// is no obstacle to them any more.
#pragma once

namespace dodgesim {

struct OracleSpec {
  double range_cap_m = 0;      // 0: no cap
  bool field_of_view = false;  // see only what the reference camera has in its image

  template <class Visitor>
  void visit(Visitor& v) {
    v("range_cap_m", range_cap_m, 0, 100,
      "Objects farther than this from the reference camera are not seen; 0 for no cap. Without one "
      "the oracle is no upper bound in a room: far objects, or several, drive it into the walls. "
      "With dodger.escape.law potential_field it avoids nothing farther than "
      "dodger.repulsive.eta_0_m from the vehicle, whatever it sees.");
    v("field_of_view", field_of_view,
      "See an object only while its centre is inside the image of the reference camera.");
  }
};

}  // namespace dodgesim

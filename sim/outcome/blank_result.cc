#include "sim/outcome/blank_result.h"

#include "sim/base/vector3.h"
#include "sim/config/resolve_throw.h"

namespace dodgesim {

namespace {

ObjectRow as_drawn(const Throw& toss, int throw_index, int object) {
  ObjectRow row;
  row.throw_index = throw_index;
  row.object = object;
  row.kind = toss.object.kind;
  row.size_m = toss.object.size_m;
  row.speed_mps = toss.speed_mps;
  row.distance_m = toss.distance_m;
  row.bearing_deg = toss.bearing_deg;
  row.aim_offset_m = {toss.aim_offset_m.x(), toss.aim_offset_m.y()};
  row.spin_radps = to_array(toss.spin_radps);
  row.launch_height_m = toss.launch_height_m;
  row.launch_us = toss.launch_us;
  return row;
}

}  // namespace

ThrowResult blank_result(const ThrowCase& thrown) {
  ThrowResult result;
  result.index = thrown.index;
  result.cell = thrown.cell;
  result.sweep = thrown.sweep;
  result.cell_values = thrown.cell_values;
  result.sweep_values = thrown.sweep_values;
  for (const Throw& toss : resolve_throws(thrown.scenario, thrown.stream)) {
    result.object_rows.push_back(as_drawn(toss, thrown.index, result.objects++));
  }
  if (result.objects == 0) return result;
  const ObjectRow& first = result.object_rows.front();
  result.object = first.kind;
  static_cast<DrawnThrow&>(result) = first;
  return result;
}

}  // namespace dodgesim

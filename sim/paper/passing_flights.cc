#include "sim/paper/passing_flights.h"

namespace dodgesim {

PaperFlight stereo_passing() { return {"passing", "passing.yaml", {}}; }

PaperFlight mono_passing(const std::string& size_m) {
  return {"passing_mono_" + size_m + "m",
          "passing_mono.yaml",
          {paper_setting("throw.size_m", size_m),
           paper_setting("dodger.position.known_size_m", size_m)}};
}

Eigen::Vector3d position_of(const DetectionRow& row) {
  return {row.p_W[0], row.p_W[1], row.p_W[2]};
}

}  // namespace dodgesim

#include "sim/paper/passing_flights.h"

namespace dodgesim {

PaperFlight stereo_passing() { return {"passing", "passing.yaml", {}}; }

PaperFlight mono_passing(const std::string& size_m) {
  return {"passing_mono_" + size_m + "m",
          "passing_mono.yaml",
          {paper_setting("throw.size_m", size_m),
           paper_setting("dodger.position.known_size_m", size_m)}};
}

}  // namespace dodgesim

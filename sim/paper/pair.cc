#include "sim/paper/pair.h"

#include <stdexcept>

namespace dodgesim {

namespace {

bool same_throw(const ThrowResult& a, const ThrowResult& b) {
  return a.index == b.index && a.object == b.object && a.size_m == b.size_m &&
         a.speed_mps == b.speed_mps && a.distance_m == b.distance_m &&
         a.bearing_deg == b.bearing_deg && a.none.hit == b.none.hit;
}

void add(const ThrowResult& result, Tally& tally, Rate& unharmed,
         std::map<std::string, int>& causes) {
  tally.add(result);
  unharmed.add(result.flown.unharmed());
  if (!result.cause.empty()) ++causes[result.cause];
}

}  // namespace

PilotPair compare_pilots(const LoadedCampaign& first, const LoadedCampaign& second,
                         const std::function<bool(const ThrowResult&)>& belongs) {
  if (first.results.size() != second.results.size()) {
    throw std::invalid_argument("The two pilots flew different numbers of throws.");
  }
  PilotPair pair;
  for (std::size_t i = 0; i < first.results.size(); ++i) {
    const ThrowResult &a = first.results[i], &b = second.results[i];
    if (!same_throw(a, b)) {
      throw std::invalid_argument("The two pilots flew different throws.");
    }
    if (!belongs(a)) continue;
    add(a, pair.first, pair.first_unharmed, pair.first_causes);
    add(b, pair.second, pair.second_unharmed, pair.second_causes);
    pair.oracle.add(a, &ThrowResult::oracle);
    if (a.none.hit) pair.paired.add(a.dodged(), b.dodged());
  }
  return pair;
}

}  // namespace dodgesim

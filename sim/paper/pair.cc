#include "sim/paper/pair.h"

#include <stdexcept>
#include <string>

#include "sim/files/text_table.h"

namespace dodgesim {

namespace {

// As drawn, and with the same fate if nobody dodges, where that was flown in both.
bool same_throw(const ThrowResult& a, const ThrowResult& b) {
  const bool same_draw = a.index == b.index && a.object == b.object && a.size_m == b.size_m &&
                         a.speed_mps == b.speed_mps && a.distance_m == b.distance_m &&
                         a.bearing_deg == b.bearing_deg;
  return same_draw && (!a.none.ok() || !b.none.ok() || a.none.hit == b.none.hit);
}

// Whether the throw would have hit is no matter of the pilot: who knows it tells the other.
void share_judgement(ThrowResult& a, ThrowResult& b) {
  if (!a.none.ok()) {
    a.none = b.none;
  } else if (!b.none.ok()) {
    b.none = a.none;
  }
}

void count(const ThrowResult& result, Tally& tally, std::map<std::string, int>& causes) {
  tally.add(result);
  if (!result.cause.empty()) ++causes[result.cause];
}

}  // namespace

void for_each_throw(const LoadedCampaign& first_flew, const LoadedCampaign& second_flew,
                    const std::function<void(const ThrowResult&, const ThrowResult&)>& both) {
  if (first_flew.results.size() != second_flew.results.size()) {
    throw std::invalid_argument("The two pilots flew different numbers of throws.");
  }
  for (std::size_t i = 0; i < first_flew.results.size(); ++i) {
    const ThrowResult &a = first_flew.results[i], &b = second_flew.results[i];
    if (!same_throw(a, b)) {
      throw std::invalid_argument(
          "Throw " + std::to_string(a.index) + " of " + first_flew.scenario.name + " and throw " +
          std::to_string(b.index) + " of " + second_flew.scenario.name + " are not the same.");
    }
    both(a, b);
  }
}

void PilotPair::add(const LoadedCampaign& first_flew, const LoadedCampaign& second_flew,
                    const std::function<bool(const ThrowResult&)>& belongs) {
  for_each_throw(first_flew, second_flew, [&](ThrowResult a, ThrowResult b) {
    if (!belongs(a)) return;
    share_judgement(a, b);
    if (a.nobody_could_fly() != b.nobody_could_fly()) {
      // No rate of the one may have it, so none of the other does.
      ++first.errors;
      ++second.errors;
      return;
    }
    count(a, first, first_causes);
    count(b, second, second_causes);
    oracle.add(a, &ThrowResult::oracle);
    const bool might_have_hit = !a.none.ok() || a.none.hit;
    if (might_have_hit && !a.nobody_could_fly()) paired.add(a.dodged(), b.dodged());
  });
}

std::string p_text(double p) { return p < 0.0001 ? "< 0.0001" : fixed_text(p, 4); }

}  // namespace dodgesim

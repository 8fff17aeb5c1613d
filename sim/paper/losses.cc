#include "sim/paper/losses.h"

#include <cmath>
#include <limits>
#include <numeric>
#include <span>
#include <vector>

#include "sim/campaign/text_table.h"
#include "sim/paper/bootstrap.h"

namespace dodgesim {

void Losses::add(const ThrowResult& result) {
  if (result.oracle.ok()) add(result, result.dodged(&ThrowResult::oracle));
}

void Losses::add(const ThrowResult& result, const ThrowResult& oracle_flew) {
  if (oracle_flew.flown.ok()) add(result, oracle_flew.dodged());
}

void Losses::add(const ThrowResult& result, bool by_oracle) {
  if (!result.flown.ok() || !result.none.ok() || !result.none.hit) return;
  counts.add(by_oracle, result.dodged());
  if (result.dodged()) return;
  // Nothing harmed who gave up in time, and nothing caused it.
  const std::string cause = result.cause.empty() ? "landed before" : result.cause;
  ++(by_oracle ? perception : with_oracle)[cause];
}

std::string ratio_text(const Losses& losses) {
  struct Dodged {
    bool oracle, pilot;
  };
  std::vector<Dodged> throws;
  const auto append = [&throws](std::int64_t count, Dodged dodged) {
    throws.insert(throws.end(), static_cast<std::size_t>(count), dodged);
  };
  append(losses.counts.both, {true, true});
  append(losses.counts.only_first, {true, false});
  append(losses.counts.only_second, {false, true});
  append(losses.counts.neither, {false, false});
  const auto ratio = [&throws](std::span<const std::size_t> drawn) {
    double pilot = 0, oracle = 0;
    for (const std::size_t i : drawn) {
      pilot += throws[i].pilot;
      oracle += throws[i].oracle;
    }
    return oracle > 0 ? pilot / oracle : std::numeric_limits<double>::infinity();
  };
  if (throws.empty()) return "-";
  std::vector<std::size_t> all(throws.size());
  std::iota(all.begin(), all.end(), 0);
  const Interval interval = cluster_bootstrap(throws.size(), "ratio", ratio);
  if (!std::isfinite(interval.lo) || !std::isfinite(interval.hi)) return "-";
  return fixed_text(ratio(all), 2) + " (" + fixed_text(interval.lo, 2) + " to " +
         fixed_text(interval.hi, 2) + ")";
}

}  // namespace dodgesim

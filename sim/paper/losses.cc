#include "sim/paper/losses.h"

#include "sim/files/text_table.h"

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
  const auto oracle = losses.counts.both + losses.counts.only_first;
  if (oracle == 0) return "-";
  const auto pilot = losses.counts.both + losses.counts.only_second;
  return with_interval(static_cast<double>(pilot) / static_cast<double>(oracle),
                       bonett_price(losses.counts), 2);
}

}  // namespace dodgesim

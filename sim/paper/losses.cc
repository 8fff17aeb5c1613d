#include "sim/paper/losses.h"

namespace dodgesim {

void Losses::add(const ThrowResult& result) {
  if (!result.flown.ok() || !result.oracle.ok() || !result.none.ok() || !result.none.hit) return;
  const bool by_oracle = result.dodged(&ThrowResult::oracle);
  counts.add(by_oracle, result.dodged());
  if (result.dodged()) return;
  // Nothing harmed who gave up in time, and nothing caused it.
  const std::string cause = result.cause.empty() ? "landed before" : result.cause;
  ++(by_oracle ? perception : actuation)[cause];
}

}  // namespace dodgesim

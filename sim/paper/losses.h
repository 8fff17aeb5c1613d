// What a pilot lost, held against its oracle: the same vehicle, controller and avoidance, told the
// truth within a range (oracle.range_cap_m). It keeps apart what perception lost and what is lost
// with perfect perception, too, by range, escape law, controller or rotors.
#pragma once

#include <map>
#include <string>

#include "sim/statistics/paired.h"
#include "sim/tables/throw_statistics.h"

namespace dodgesim {

// Counts over the throws that would have hit, and whose flights by the pilot, its oracle and the
// pilot none were all flown.
struct Losses {
  PairedCounts counts;                     // dodged by the oracle (first) and by the pilot (second)
  std::map<std::string, int> perception;   // causes of what the oracle dodged
  std::map<std::string, int> with_oracle;  // causes of what the oracle lost, too

  void add(const ThrowResult& result);
  // Against another oracle, which is the pilot of `oracle_flew` through the same throw.
  void add(const ThrowResult& result, const ThrowResult& oracle_flew);

  Rate dodged() const { return {counts.both + counts.only_second, counts.total()}; }
  Rate dodged_by_oracle() const { return {counts.both + counts.only_first, counts.total()}; }
  Rate lost_to_perception() const { return {counts.only_first, counts.total()}; }
  Rate lost_with_oracle() const { return {counts.neither, counts.total()}; }

 private:
  void add(const ThrowResult& result, bool by_oracle);
};

// "1.04 (0.90 to 1.19)": the pilot's dodges by the oracle's, with the 95 % interval of
// bonett_price(); "-" where the oracle dodges none.
std::string ratio_text(const Losses& losses);

}  // namespace dodgesim

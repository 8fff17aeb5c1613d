// Success tables of a campaign. "Dodged" means: the pilot `none` was hit on the same throw, and the
// flown pilot was neither hit nor crashed. A throw whose flight failed with an error never counts
// as a success and stays in the denominator.
#pragma once

#include <string>
#include <vector>

#include "sim/campaign/result.h"

namespace dodgesim {

// Counts over some throws, for one pilot.
struct Tally {
  int throws = 0;          // thrown, flown by the pilot, and judged by the pilot none
  int would_have_hit = 0;  // of those, hit when nobody dodged
  int dodged = 0;          // of those that would have hit
  int errors = 0;          // flights of this pilot, or of the pilot none, that failed

  void add(const FlightResult& flight, const FlightResult& none);
};

// One cell of the tables: half-open bins [lo, hi) of the two keys, or a single value (lo == hi).
struct Bin {
  double lo = 0;
  double hi = 0;
  bool contains(double value) const;
  std::string text() const;  // "0.1" or "2 to 3"
};

// A value each where there are few different ones with at most three decimals, else bins of the
// given width that start at multiples of it. In increasing order; empty for no values.
std::vector<Bin> make_bins(const std::vector<double>& values, double width);

struct Tables {
  std::string markdown;
  std::string csv;  // one row a cell and pilot, without formatting
};

// `results` in throw order; `title` and `pilot` are the scenario's.
Tables make_tables(const std::vector<ThrowResult>& results, const std::string& title,
                   const std::string& pilot);

// "25 / 34 (0.735, 0.569 to 0.854)"; "0 / 0" without trials.
std::string rate_text(int successes, int trials);

}  // namespace dodgesim

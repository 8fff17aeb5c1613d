// By what throws are told apart in tables and charts.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "sim/outcome/result.h"

namespace dodgesim {

// Half-open [lo, hi), or a single value (lo == hi).
struct Bin {
  double lo = 0;
  double hi = 0;
  bool contains(double value) const;
  std::string text() const;  // "0.1" or "2 to 3"
};

// A value each where there are few different ones with at most three decimals, or where they are
// `written`; else bins of the given width that start at multiples of it. In increasing order; empty
// for no values.
std::vector<Bin> make_bins(const std::vector<double>& values, double width, bool written = false);

// A property of throws with the few values, or bins of values, that it has in a campaign.
class Axis {
 public:
  // `name` is a column of throws.csv that says how a throw was drawn (size_m, distance_m,
  // speed_mps, bearing_deg, launch_height_m or object; of several objects, the first) or a key of
  // the scenario's grid. Throws ScenarioError, listing them, for any other name.
  Axis(const std::string& name, const std::vector<ThrowResult>& results);

  const std::string& name() const { return name_; }
  const std::vector<std::string>& values() const { return values_; }  // as text, in order
  // The middle of each value or bin, if all are numbers; else empty.
  const std::vector<double>& middles() const { return middles_; }

  // Which of the values a throw has; nothing where nobody threw.
  std::optional<std::size_t> of(const ThrowResult& result) const;

 private:
  using NameOf = std::function<std::optional<std::string>(const ThrowResult&)>;

  void set_names(const std::vector<ThrowResult>& results, const NameOf& name_of);
  void set_numeric(const std::vector<ThrowResult>& results, double ThrowResult::*key, double width);

  std::string name_;
  std::vector<std::string> values_;
  std::vector<double> middles_;
  std::function<std::optional<std::size_t>(const ThrowResult&)> of_;
};

// An axis for each key of the scenario's grid, in its order.
std::vector<Axis> grid_axes(const std::vector<ThrowResult>& results);

}  // namespace dodgesim

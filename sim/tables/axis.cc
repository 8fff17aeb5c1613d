#include "sim/tables/axis.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <set>

#include "sim/base/contains.h"
#include "sim/base/error.h"
#include "sim/base/numbers.h"

namespace dodgesim {

namespace {

constexpr std::size_t kMostSingleValues = 6;    // more become bins
constexpr std::size_t kMostWrittenValues = 12;  // likewise, of those that come again and again

struct NumericKey {
  const char* name;
  double ThrowResult::*value;
  double bin;
};
constexpr std::array<NumericKey, 5> kNumericKeys = {
    {{"size_m", &ThrowResult::size_m, 0.1},
     {"distance_m", &ThrowResult::distance_m, 1},
     {"speed_mps", &ThrowResult::speed_mps, 1},
     {"bearing_deg", &ThrowResult::bearing_deg, 10},
     {"launch_height_m", &ThrowResult::launch_height_m, 0.5}}};

// A value that somebody wrote, rather than one drawn from a continuous distribution, is round or
// comes again.
bool is_round(double value) { return std::abs(value - std::round(value * 1e3) / 1e3) < 1e-12; }

// Whether all values are written ones: each comes again, within a value of the sweep, as the others
// meet the same throws.
bool are_written(const std::vector<ThrowResult>& results, double ThrowResult::*key) {
  std::map<int, std::map<double, int>> counts;
  std::set<double> distinct, again;
  for (const ThrowResult& result : results) {
    if (!result.thrown()) continue;
    distinct.insert(result.*key);
    if (++counts[result.sweep][result.*key] > 1) again.insert(result.*key);
    if (distinct.size() > kMostWrittenValues) return false;
  }
  return again.size() == distinct.size();
}

std::string names_of_keys(const std::vector<ThrowResult>& results) {
  std::string names;
  for (const NumericKey& key : kNumericKeys) names += std::string(key.name) + ", ";
  names += "object";
  if (results.empty()) return names;
  for (const AxisValue& value : results.front().cell_values) names += ", " + value.key;
  return names;
}

// Of a key of the grid.
std::optional<std::string> value_in_cell(const ThrowResult& result, const std::string& key) {
  for (const AxisValue& of_cell : result.cell_values) {
    if (of_cell.key == key) return with_one_spelling(of_cell.value);
  }
  return std::nullopt;
}

}  // namespace

bool Bin::contains(double value) const {
  return lo == hi ? value == lo : value >= lo && value < hi;
}

std::string Bin::text() const {
  return lo == hi ? to_text(lo) : to_text(lo) + " to " + to_text(hi);
}

std::vector<Bin> make_bins(const std::vector<double>& values, double width, bool written) {
  const std::set<double> distinct(values.begin(), values.end());
  std::vector<Bin> bins;
  if (distinct.empty()) return bins;
  const bool all_round = std::ranges::all_of(distinct, is_round);
  if (written || (distinct.size() <= kMostSingleValues && all_round)) {
    for (const double value : distinct) bins.push_back({value, value});
    return bins;
  }
  // Multiples such as 3 * 0.1 would print as 0.30000000000000004.
  const auto edge = [&](std::int64_t k) {
    return std::round(static_cast<double>(k) * width * 1e9) / 1e9;
  };
  const auto cell_of = [&](double value) {
    auto k = static_cast<std::int64_t>(std::floor(value / width));
    while (edge(k) > value) --k;
    while (edge(k + 1) <= value) ++k;
    return k;
  };
  for (std::int64_t i = cell_of(*distinct.begin()); i <= cell_of(*distinct.rbegin()); ++i) {
    bins.push_back({edge(i), edge(i + 1)});
  }
  return bins;
}

Axis::Axis(const std::string& name, const std::vector<ThrowResult>& results) : name_(name) {
  const auto key = std::ranges::find(kNumericKeys, name, &NumericKey::name);
  const std::string in_grid = "throw." + name;
  if (!results.empty() && value_in_cell(results.front(), in_grid)) {
    // The grid's own values, however many, and never several of them as one.
    set_names(results, [in_grid](const ThrowResult& r) { return value_in_cell(r, in_grid); });
  } else if (key != kNumericKeys.end()) {
    set_numeric(results, key->value, key->bin);
  } else if (name == "object") {
    set_names(results, [](const ThrowResult& r) {
      return r.thrown() ? std::optional(r.object) : std::nullopt;
    });
  } else {
    const auto value = [name](const ThrowResult& r) { return value_in_cell(r, name); };
    if (results.empty() || !value(results.front())) {
      throw ScenarioError("Throws cannot be told apart by \"" + name +
                          "\"; known: " + names_of_keys(results) + ".");
    }
    set_names(results, value);
  }
}

void Axis::set_names(const std::vector<ThrowResult>& results, const NameOf& name_of) {
  for (const ThrowResult& result : results) {
    const auto name = name_of(result);
    if (name && !contains(values_, *name)) {
      values_.push_back(*name);
    }
  }
  for (const std::string& value : values_) {
    if (const auto number = as_number(value)) middles_.push_back(*number);
  }
  if (middles_.size() < values_.size()) middles_.clear();
  of_ = [values = values_, name_of](const ThrowResult& result) -> std::optional<std::size_t> {
    const auto name = name_of(result);
    return name ? index_of(values, *name) : std::nullopt;
  };
}

void Axis::set_numeric(const std::vector<ThrowResult>& results, double ThrowResult::*key,
                       double width) {
  std::vector<double> values;
  for (const ThrowResult& result : results) {
    if (result.thrown()) values.push_back(result.*key);
  }
  const std::vector<Bin> bins = make_bins(values, width, are_written(results, key));
  for (const Bin& bin : bins) {
    values_.push_back(bin.text());
    middles_.push_back(0.5 * (bin.lo + bin.hi));
  }
  of_ = [bins, key](const ThrowResult& result) -> std::optional<std::size_t> {
    if (!result.thrown()) return std::nullopt;
    const auto at =
        std::ranges::find_if(bins, [&](const Bin& bin) { return bin.contains(result.*key); });
    if (at == bins.end()) return std::nullopt;
    return static_cast<std::size_t>(at - bins.begin());
  };
}

std::optional<std::size_t> Axis::of(const ThrowResult& result) const { return of_(result); }

std::vector<Axis> grid_axes(const std::vector<ThrowResult>& results) {
  std::vector<Axis> axes;
  if (results.empty()) return axes;
  for (const AxisValue& of_cell : results.front().cell_values)
    axes.emplace_back(of_cell.key, results);
  return axes;
}

}  // namespace dodgesim

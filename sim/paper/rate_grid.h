// Success rates over two conditions, such as the latency and the speed.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "sim/campaign/axis.h"
#include "sim/campaign/load_campaign.h"
#include "sim/campaign/text_table.h"
#include "sim/campaign/throw_statistics.h"
#include "sim/plot/plot.h"

namespace dodgesim {

struct RateGrid {
  std::string name;  // head of the first column
  std::vector<std::string> rows, columns;
  std::vector<std::vector<Rate>> rates;  // [row][column]

  void add_row(const std::string& row, const std::vector<Rate>& row_rates);
  RateGrid transposed(const std::string& transposed_name) const;
  TextTable table() const;  // "25 / 34 (0.57 to 0.85)", with Wilson's interval
};

// A line for each rate.
std::string rates_csv(const std::vector<RateGrid>& grids);

// "25 / 34 (0.57 to 0.85)"; "-" without trials.
std::string short_rate_text(const Rate& rate);

// "0.73 (0.65 to 0.81)", the median with its 95 % interval; without that of a sample too small to
// have one; "-" of none.
std::string median_text(const Measured& sample, int digits);

// The flown pilot's dodges among the throws that would have hit, for each value of the axis.
std::vector<Rate> success_by(const Axis& axis, const Results& results);

// The value that the part's sweep gives to a key; throws ScenarioError if there is none.
std::string sweep_value(const Part& part, const std::string& key);
double sweep_number(const Part& part, const std::string& key);

// Success over the values of `columns`, which are numbers: a line and its points, without what had
// no trials.
void add_curve(const std::string& name, int colour, const std::vector<double>& at,
               const std::vector<Rate>& rates, Plot& plot);

// A vertical line.
void add_mark(const std::string& name, int colour, double at, Plot& plot);

// Where the rates, over increasing values, fall below one half for good: between the last value
// with at least one half and the next one, on a straight line. Infinite if the last rate is at
// least one half; `at.front()` if none is.
double half_lost(const std::vector<double>& at, const std::vector<Rate>& rates);

}  // namespace dodgesim

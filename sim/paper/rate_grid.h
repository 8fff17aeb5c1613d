// Success rates over two conditions, such as the latency and the speed.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "sim/files/text_table.h"
#include "sim/plot/plot.h"
#include "sim/tables/axis.h"
#include "sim/tables/loaded_campaign.h"
#include "sim/tables/throw_statistics.h"

namespace dodgesim {

struct RateGrid {
  std::string name;  // head of the first column
  std::vector<std::string> columns, rows = {};
  std::vector<std::vector<Rate>> rates = {};  // [row][column]

  void add_row(const std::string& row, const std::vector<Rate>& row_rates);
  RateGrid transposed(const std::string& transposed_name) const;
  // With a last column for each row's sum.
  RateGrid with_sum() const;
  TextTable table() const;  // "25 / 34 (0.57 to 0.85)", with Wilson's interval
};

// A line for each rate.
std::string rates_csv(const std::vector<RateGrid>& grids);

// "25 / 34 (0.57 to 0.85)"; "-" without trials.
std::string short_rate_text(const Rate& rate);

// "0.73 (0.65 to 0.81)", the median with its 95 % interval; without that of a sample too small to
// have one; "-" of none.
std::string median_text(const Measured& sample, int digits);

// "4 m/s", ...
std::vector<std::string> speed_columns(const Axis& speeds);

// The flown pilot's dodges among the throws that would have hit, for each value of the axis.
std::vector<Rate> success_by(const Axis& axis, const Results& results);

// The value that the part's sweep gives to a key; throws ScenarioError if there is none.
std::string sweep_value(const Part& part, const std::string& key);
double sweep_number(const Part& part, const std::string& key);

// The y axis of plots of success.
PlotAxis dodged_axis();

// Success over `at`: a line and its points, without what had no trials. Colours 0 to 4.
void add_curve(const std::string& name, int colour, const std::vector<double>& at,
               const std::vector<Rate>& rates, Plot& plot);

// A grey vertical line.
void add_mark(const std::string& name, double at, Plot& plot);

// Short ticks at one half of the curves that add_curve() has drawn with the colours from 0 on:
// where a bound says that they are lost. Those beyond the x axis are left out.
void add_bounds(const std::string& name, const std::vector<double>& at, Plot& plot);

// The last of the rates that is at least one half; empty if none is. Rates without trials do not
// count.
std::optional<std::size_t> last_half(const std::vector<Rate>& rates);

}  // namespace dodgesim

#include "sim/paper/rate_grid.h"

#include <cmath>

#include "sim/base/error.h"
#include "sim/base/numbers.h"

namespace dodgesim {

void RateGrid::add_row(const std::string& row, const std::vector<Rate>& row_rates) {
  rows.push_back(row);
  rates.push_back(row_rates);
}

RateGrid RateGrid::transposed(const std::string& transposed_name) const {
  RateGrid other{transposed_name, rows, columns};
  other.rates.resize(columns.size());
  for (const std::vector<Rate>& row : rates) {
    for (std::size_t i = 0; i < columns.size(); ++i) other.rates[i].push_back(row[i]);
  }
  return other;
}

RateGrid RateGrid::with_sum() const {
  RateGrid other = *this;
  other.columns.push_back("all");
  for (std::vector<Rate>& row : other.rates) {
    Rate sum;
    for (const Rate& rate : row) {
      sum.count += rate.count;
      sum.of += rate.of;
    }
    row.push_back(sum);
  }
  return other;
}

TextTable RateGrid::table() const {
  TextTable table;
  table.head = {name};
  table.head.insert(table.head.end(), columns.begin(), columns.end());
  for (std::size_t i = 0; i < rows.size(); ++i) {
    std::vector<std::string>& row = table.rows.emplace_back();
    row.push_back(rows[i]);
    for (const Rate& rate : rates[i]) row.push_back(short_rate_text(rate));
  }
  return table;
}

std::string rates_csv(const std::vector<RateGrid>& grids) {
  TextTable csv;
  csv.head = {"table", "row", "column", "dodged", "of", "rate", "lo", "hi"};
  for (const RateGrid& grid : grids) {
    for (std::size_t i = 0; i < grid.rows.size(); ++i) {
      for (std::size_t k = 0; k < grid.columns.size(); ++k) {
        const Rate& rate = grid.rates[i][k];
        const auto text = [&](double value) {
          return rate.has_interval() ? fixed_text(value, 4) : std::string();
        };
        const Interval interval = rate.interval();
        csv.rows.push_back({grid.name, grid.rows[i], grid.columns[k], std::to_string(rate.count),
                            std::to_string(rate.of),
                            rate.of > 0 ? fixed_text(*rate.value(), 4) : "", text(interval.lo),
                            text(interval.hi)});
      }
    }
  }
  return csv.to_csv();
}

std::string short_rate_text(const Rate& rate) {
  if (rate.of == 0) return "-";
  const Interval interval = rate.interval();
  return std::to_string(rate.count) + " / " + std::to_string(rate.of) + " (" +
         fixed_text(interval.lo, 2) + " to " + fixed_text(interval.hi, 2) + ")";
}

std::string median_text(const Measured& sample, int digits) {
  const std::optional<QuantileEstimate> median = sample.quantile(0.5);
  if (!median) return "-";
  const bool bounded = std::isfinite(median->interval.lo) && std::isfinite(median->interval.hi);
  return bounded ? with_interval(median->value, median->interval, digits)
                 : fixed_text(median->value, digits);
}

std::vector<std::string> speed_columns(const Axis& speeds) {
  std::vector<std::string> columns;
  for (const std::string& speed : speeds.values()) columns.push_back(speed + " m/s");
  return columns;
}

std::vector<Rate> success_by(const Axis& axis, const Results& results) {
  std::vector<Tally> tallies(axis.values().size());
  for (const ThrowResult* result : results) {
    const std::optional<std::size_t> i = axis.of(*result);
    if (i) tallies[*i].add(*result);
  }
  std::vector<Rate> rates;
  rates.reserve(tallies.size());
  for (const Tally& tally : tallies) rates.push_back(tally.success());
  return rates;
}

std::string sweep_value(const Part& part, const std::string& key) {
  for (const AxisValue& value : part.values) {
    if (value.key == key) return value.value;
  }
  throw ScenarioError("The experiment needs a sweep over " + key + ".");
}

double sweep_number(const Part& part, const std::string& key) {
  const std::optional<double> number = as_number(sweep_value(part, key));
  if (!number) throw ScenarioError("The experiment needs numbers for " + key + ".");
  return *number;
}

PlotAxis dodged_axis() { return {"dodged, of those that would have hit", 0, 1.05, false}; }

void add_curve(const std::string& name, int colour, const std::vector<double>& at,
               const std::vector<Rate>& rates, Plot& plot) {
  Series line{name, Series::Kind::kLine, colour};
  for (std::size_t i = 0; i < at.size(); ++i) {
    const std::optional<double> value = rates[i].value();
    if (!value) continue;
    line.add(at[i], *value);
  }
  Series points = line;
  points.name.clear();
  points.kind = Series::Kind::kPoints;
  plot.series.push_back(line);
  plot.series.push_back(points);
}

void add_mark(const std::string& name, double at, Plot& plot) {
  constexpr int kGrey = 5;
  plot.series.push_back({name, Series::Kind::kLine, kGrey, {at, at}, {0, 1}});
}

void add_bounds(const std::string& name, const std::vector<double>& at, Plot& plot) {
  constexpr double kHalfTick = 0.08;
  std::string legend = name;  // once
  for (std::size_t i = 0; i < at.size(); ++i) {
    if (!(at[i] >= plot.x.from && at[i] <= plot.x.to)) continue;
    plot.series.push_back({legend,
                           Series::Kind::kLine,
                           static_cast<int>(i),
                           {at[i], at[i]},
                           {0.5 - kHalfTick, 0.5 + kHalfTick}});
    legend.clear();
  }
}

std::optional<std::size_t> last_half(const std::vector<Rate>& rates) {
  for (std::size_t i = rates.size(); i-- > 0;) {
    if (rates[i].of > 0 && 2 * rates[i].count >= rates[i].of) return i;
  }
  return std::nullopt;
}

}  // namespace dodgesim

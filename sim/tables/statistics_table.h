// Statistics of a campaign's throws in groups, and the formats in which they are written.
#pragma once

#include <string>
#include <vector>

#include "sim/tables/axis.h"
#include "sim/tables/throw_statistics.h"

namespace dodgesim {

struct StatisticsTable {
  struct Row {
    std::vector<std::string> values;  // of the keys; "all" where the row is not told apart by one
    ThrowStatistics statistics;
  };
  std::vector<std::string> keys;
  std::vector<Row> rows;
};

// A row for each combination of the axes' values that occurs, in their order, and one of all throws
// of the part.
StatisticsTable group_by(const Part& part, const std::vector<Axis>& axes);

// The same for all parts, one after the other, with the keys of the sweep in front.
StatisticsTable group_by(const std::vector<Part>& parts, const std::vector<Axis>& axes);

// The row of these values; null if there is none.
const StatisticsTable::Row* find_row(const StatisticsTable& table,
                                     const std::vector<std::string>& values);

// Puts the keys and values of the part in front of those of the table.
StatisticsTable of_sweep(const Part& part, StatisticsTable table);

// Who is worth a column: not the oracle if it flew nowhere.
std::vector<Role> shown_pilots(const StatisticsTable& table);

// Rates with counts and intervals (those of dodged throws, too, unless asked not to).
std::string rates_to_markdown(const StatisticsTable& table, bool with_dodged = true);

// The rates; then samples as "median (10 % to 90 % quantile), count".
std::string to_markdown(const StatisticsTable& table, bool with_dodged = true);

// The same two as tabulars for LaTeX's package booktabs.
std::string to_latex(const StatisticsTable& table);

// A row for each row and pilot, with everything: rates with the ends of their 95 % intervals,
// samples with count, quantiles q10, q50, q90 and the ends of the median's 95 % interval. `rate` is
// dodged / would_have_hit; would_have_hit_rate is of the throws whose flight without a dodge did
// not fail. What is not known is an empty cell.
std::string to_csv(const StatisticsTable& table);

// The same as an array of objects; what is not known is null.
std::string to_json(const StatisticsTable& table);

}  // namespace dodgesim

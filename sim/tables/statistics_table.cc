#include "sim/tables/statistics_table.h"

#include <algorithm>
#include <iterator>
#include <map>
#include <utility>

namespace dodgesim {

StatisticsTable group_by(const Part& part, const std::vector<Axis>& axes) {
  std::map<std::vector<std::size_t>, Results> groups;
  for (const ThrowResult* result : part.results) {
    std::vector<std::size_t> place;
    for (const Axis& axis : axes) {
      if (const auto at = axis.of(*result)) place.push_back(*at);
    }
    if (!axes.empty() && place.size() == axes.size()) groups[place].push_back(result);
  }
  StatisticsTable table;
  for (const Axis& axis : axes) table.keys.push_back(axis.name());
  for (const auto& [place, group] : groups) {
    StatisticsTable::Row& row = table.rows.emplace_back();
    for (std::size_t i = 0; i < axes.size(); ++i) {
      row.values.push_back(axes[i].values()[place[i]]);
    }
    row.statistics = group.size() == part.results.size() ? statistics_of(part)
                                                         : statistics_of(group, part.pilot);
  }
  table.rows.push_back({std::vector<std::string>(axes.size(), "all"), statistics_of(part)});
  return table;
}

const StatisticsTable::Row* find_row(const StatisticsTable& table,
                                     const std::vector<std::string>& values) {
  const auto row = std::ranges::find(table.rows, values, &StatisticsTable::Row::values);
  return row == table.rows.end() ? nullptr : &*row;
}

StatisticsTable of_sweep(const Part& part, StatisticsTable table) {
  std::vector<std::string> keys, values;
  for (const AxisValue& value : part.values) {
    keys.push_back(value.key);
    values.push_back(value.value);
  }
  table.keys.insert(table.keys.begin(), keys.begin(), keys.end());
  for (StatisticsTable::Row& row : table.rows) {
    row.values.insert(row.values.begin(), values.begin(), values.end());
  }
  return table;
}

StatisticsTable group_by(const std::vector<Part>& parts, const std::vector<Axis>& axes) {
  StatisticsTable all;
  for (const Part& part : parts) {
    StatisticsTable table = of_sweep(part, group_by(part, axes));
    all.keys = table.keys;
    std::move(table.rows.begin(), table.rows.end(), std::back_inserter(all.rows));
  }
  return all;
}

std::vector<Role> shown_pilots(const StatisticsTable& table) {
  const bool oracle =
      std::ranges::any_of(table.rows, [](const auto& row) { return row.statistics.oracle_flew; });
  if (oracle) return {Role::kFlown, Role::kOracle, Role::kNone};
  return {Role::kFlown, Role::kNone};
}

}  // namespace dodgesim

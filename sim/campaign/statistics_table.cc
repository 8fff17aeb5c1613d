#include "sim/campaign/statistics_table.h"

#include <map>

namespace dodgesim {

StatisticsTable group_by(const Results& results, const std::vector<Axis>& axes,
                         const std::string& pilot) {
  std::map<std::vector<std::size_t>, Results> groups;
  for (const ThrowResult* result : results) {
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
    row.statistics = statistics_of(group, pilot);
  }
  table.rows.push_back(
      {std::vector<std::string>(axes.size(), "all"), statistics_of(results, pilot)});
  return table;
}

}  // namespace dodgesim

// Tables of throws whose outcome is given.
#pragma once

#include <string>
#include <vector>

#include "sim/files/csv.h"
#include "sim/gate/outcomes.h"
#include "sim/outcome/result.h"

namespace dodgesim::testing {

// 'd' dodged, 'h' hit, 'c' crashed, 'e' error, 'm' would have missed and does so
inline ThrowResult throw_that(int index, char outcome) {
  ThrowResult result;
  result.index = index;
  result.objects = 1;
  result.object = "ball";
  result.size_m = 0.2;
  result.speed_mps = 5 + 0.01 * index;
  result.distance_m = 3;
  result.none.status = "ok";
  result.none.hit = outcome != 'm';
  result.flown.status = outcome == 'e' ? "error" : "ok";
  if (outcome == 'e') result.flown.error = "killed, \"by\" signal 9";
  result.flown.hit = outcome == 'h';
  result.flown.crashed = outcome == 'c';
  return result;
}

inline ThrowResult quiet_flight_that(int index, bool evaded) {
  ThrowResult result;
  result.index = index;
  result.flown.status = "ok";
  result.evaded = evaded;
  return result;
}

// With several objects, their rows too.
inline CampaignTables tables_of(const std::vector<ThrowResult>& results) {
  std::string throws = csv_header(results.empty() ? ThrowResult() : results.front());
  std::string objects = csv_header<ObjectRow>();
  for (const ThrowResult& result : results) {
    throws += csv_row(result);
    for (const ObjectRow& row : result.object_rows) objects += csv_row(row);
  }
  return {CsvTable(throws, "throws.csv"), CsvTable(objects, "objects.csv")};
}

inline CampaignTables tables_of(const std::string& outcomes) {
  std::vector<ThrowResult> results;
  for (std::size_t i = 0; i < outcomes.size(); ++i) {
    results.push_back(throw_that(static_cast<int>(i), outcomes[i]));
  }
  return tables_of(results);
}

}  // namespace dodgesim::testing

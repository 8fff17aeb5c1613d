// Tables of throws whose outcome is given.
#pragma once

#include <string>
#include <vector>

#include "sim/campaign/csv.h"
#include "sim/campaign/result.h"
#include "sim/gate/csv_table.h"

namespace dodgesim::testing {

// 'd' dodged, 'h' hit, 'c' crashed, 'e' error, 'm' would have missed and does so
inline ThrowResult throw_that(int index, char outcome) {
  ThrowResult result;
  result.index = index;
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

inline std::string csv_of(const std::vector<ThrowResult>& results) {
  std::string text = csv_header<ThrowResult>();
  for (const ThrowResult& result : results) text += csv_row(result);
  return text;
}

inline CsvTable table_of(const std::string& outcomes) {
  std::vector<ThrowResult> results;
  for (std::size_t i = 0; i < outcomes.size(); ++i) {
    results.push_back(throw_that(static_cast<int>(i), outcomes[i]));
  }
  return CsvTable(csv_of(results), "throws.csv");
}

}  // namespace dodgesim::testing

// The paper's pilot on the throws outdoors, split by how far away they come from and beside an
// oracle that must have the ball in view; and when balls are aimed less well: what the paper's
// count of all throws, also of those that would have missed, makes of its success.
#include <functional>
#include <string>
#include <vector>

#include "sim/paper/experiment.h"
#include "sim/paper/losses.h"
#include "sim/paper/pair.h"
#include "sim/paper/rate_grid.h"

namespace dodgesim {

namespace {

constexpr const char* kMoreThrowsProtocol = R"(How to read it:

- The throws are those of outdoor.md: at a vehicle that hovers, that flies to a goal, and several
  balls at once. *From* and *to*: distance and speed of the first ball. From 4 m on, balls of up to
  5 m/s are lobs, which come from above the view of the cameras when they are within 1.5 m.
- *Oracle*: is told of the ball within 1.5 m and avoids it like falanga2020. *Oracle, in view*: the
  same, told of the ball only while its centre is in the view of the reference camera
  (`oracle.field_of_view`). *Ratio*: the pilot's dodges by the oracle's on the same throws (95 %,
  bootstrap). Other intervals: 95 %, Wilson.
- *Hover, aimed less well*: at points around the vehicle's middle with a standard deviation of 0.4 m
  across and up, so that most balls miss a vehicle that stays.
- *Unharmed*: of all throws, those that left the vehicle unharmed, which is what the paper's outdoor
  "more than 90 % of the time" counts.
)";

struct Sum {
  Losses told, in_view;  // against the one oracle and the other
  Rate unharmed;

  // The second campaign is flown by the oracle in view.
  void add(const LoadedCampaign& pilot, const LoadedCampaign& oracle_in_view,
           const std::function<bool(const ThrowResult&)>& belongs) {
    for_each_throw(pilot, oracle_in_view, [&](const ThrowResult& flown, const ThrowResult& seen) {
      if (!belongs(flown)) return;
      told.add(flown);
      in_view.add(flown, seen.flown);
      unharmed.add(flown.flown.unharmed());
    });
  }
};

struct Row {
  const char* name;
  bool (*belongs)(const ThrowResult&);
};

constexpr double kFarM = 4;
constexpr double kSlowMps = 5.01;  // with the 5 m/s of the grid

constexpr Row kRows[] = {
    {"from 3 to 4 m", [](const ThrowResult& r) { return r.distance_m < kFarM; }},
    {"from 4 to 5 m, faster than 5 m/s",
     [](const ThrowResult& r) { return r.distance_m >= kFarM && r.speed_mps > kSlowMps; }},
    {"from 4 to 5 m, to 5 m/s",
     [](const ThrowResult& r) { return r.distance_m >= kFarM && r.speed_mps <= kSlowMps; }},
    {"all of outdoor.md", [](const ThrowResult&) { return true; }},
};

std::vector<std::string> row_of(const std::string& name, const Sum& sum) {
  return {name,
          std::to_string(sum.unharmed.of),
          std::to_string(sum.told.counts.total()),
          short_rate_text(sum.told.dodged()),
          short_rate_text(sum.told.dodged_by_oracle()),
          ratio_text(sum.told),
          short_rate_text(sum.in_view.dodged_by_oracle()),
          ratio_text(sum.in_view),
          short_rate_text(sum.unharmed)};
}

// Campaigns of the pilot and of the oracle in view take turns; those aimed less well are the last.
PaperTables analyse_more_throws(const std::vector<LoadedCampaign>& campaigns) {
  TextTable table;
  table.head = {"falanga2020",      "thrown",         "would have hit",
                "dodged, of these", "oracle",         "ratio",
                "oracle, in view",  "ratio, in view", "unharmed, of all thrown"};
  const std::size_t last = campaigns.size() - 2;
  for (const Row& row : kRows) {
    Sum sum;
    for (std::size_t i = 0; i < last; i += 2) sum.add(campaigns[i], campaigns[i + 1], row.belongs);
    table.rows.push_back(row_of(row.name, sum));
  }
  Sum scattered;
  scattered.add(campaigns[last], campaigns[last + 1], [](const ThrowResult&) { return true; });
  table.rows.push_back(row_of("hover, aimed less well", scattered));
  return {table.to_markdown() + "\n" + kMoreThrowsProtocol, table.to_csv()};
}

std::vector<PaperFlight> flights_of_more_throws() {
  std::vector<PaperFlight> flights;
  for (const char* name :
       {"outdoor_hover", "outdoor_goal", "outdoor_several", "outdoor_scattered"}) {
    const std::string scenario = std::string(name) + ".yaml";
    flights.push_back({name + std::string("_falanga2020"), scenario, {}});
    flights.push_back(
        {name + std::string("_oracle_in_view"),
         scenario,
         {paper_setting("pilot", "oracle"), paper_setting("oracle.field_of_view", "true")}});
  }
  return flights;
}

}  // namespace

PaperExperiment more_throws_experiment() {
  return {"more_throws", "Outdoors by distance and by what is in view, and aimed less well",
          flights_of_more_throws(), analyse_more_throws};
}

}  // namespace dodgesim

// The paper's pilot on the throws outdoors, split by whether its cameras could see them and beside
// an oracle that must have the ball in view; and when balls are aimed less well: what the paper's
// count of all throws, also of those that would have missed, makes of its success.
#include <optional>
#include <string>
#include <vector>

#include "sim/paper/experiment.h"
#include "sim/paper/losses.h"
#include "sim/paper/pair.h"
#include "sim/paper/passage.h"
#include "sim/paper/rate_grid.h"

namespace dodgesim {

namespace {

constexpr const char* kMoreThrowsProtocol = R"(How to read it:

- The throws are those of outdoor.md, from 3 to 5 m: at a vehicle that hovers, that flies to a goal,
  and several balls at once.
- *In view at 1.5 m*: the centre of the first ball is in the image of the reference camera when it
  comes within 1.5 m, within which the pilot believes what it sees. Slow balls from far away are lobs
  that come from above the 64 degrees of the view: those of 4 m/s from about 4 m on.
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

  // `seen` is flown by the oracle in view.
  void add(const ThrowResult& flown, const ThrowResult& seen) {
    told.add(flown);
    in_view.add(flown, seen.flown);
    unharmed.add(flown.flown.unharmed());
  }
};

// Whether the first ball is in view of the reference camera when it comes within the oracle's
// range.
bool comes_in_view(const LoadedCampaign& campaign, const CameraRig& rig,
                   const ThrowResult& result) {
  constexpr TimeUs kStepUs = 1000;
  const Trajectory trajectory = trajectory_from_bytes(result.trajectory);
  const Passage passage(trajectory, rig);
  for (TimeUs t_us = trajectory.start_us; t_us <= trajectory.end_us; t_us += kStepUs) {
    const std::optional<Sight> sight = passage.at(t_us);
    if (sight && sight->range_m() <= campaign.scenario.oracle.range_cap_m) {
      return centre_in_image(rig.intrinsics, sight->p_C);
    }
  }
  return false;
}

// The throws of a campaign that come in view, those that do not, and all.
struct Sums {
  Sum in_view, not_in_view, all;

  void add(const LoadedCampaign& pilot, const LoadedCampaign& oracle_in_view) {
    const CameraRig rig = camera_rig(pilot.scenario);
    for_each_throw(pilot, oracle_in_view, [&](const ThrowResult& flown, const ThrowResult& seen) {
      (comes_in_view(pilot, rig, flown) ? in_view : not_in_view).add(flown, seen);
      all.add(flown, seen);
    });
  }
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
  Sums outdoors, scattered;
  for (std::size_t i = 0; i < last; i += 2) outdoors.add(campaigns[i], campaigns[i + 1]);
  scattered.add(campaigns[last], campaigns[last + 1]);
  table.rows = {row_of("in view at 1.5 m", outdoors.in_view),
                row_of("above or beside the view at 1.5 m", outdoors.not_in_view),
                row_of("all of outdoor.md", outdoors.all),
                row_of("hover, aimed less well", scattered.all)};
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
  return {"more_throws", "Outdoors by what is in view, and aimed less well",
          flights_of_more_throws(), analyse_more_throws};
}

}  // namespace dodgesim

// The paper's pilot on the throws outdoors, split by whether its cameras could see them and beside
// an oracle that must have the ball in view; and when balls are aimed less well: what the paper's
// count of all throws, also of those that would have missed, makes of its success.
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "sim/config/pilot.h"
#include "sim/files/text_table.h"
#include "sim/outcome/trajectory.h"
#include "sim/paper/experiment.h"
#include "sim/paper/losses.h"
#include "sim/paper/pair.h"
#include "sim/paper/passage.h"
#include "sim/paper/rate_grid.h"

namespace dodgesim {

namespace {

constexpr const char* kMoreThrowsProtocol = R"(How to read it:

- The first three rows are the throws of outdoor.md, from 3 to 5 m: at a vehicle that hovers, that
  flies to a goal, and several balls at once. Throws with a flight that failed are left out.
- *In view within 1.5 m*: the ball that first comes within 1.5 m of the reference camera, within which
  the pilot believes what it sees, has its centre in that camera's image when it does. Slow balls from
  far away are lobs that come from above the 64 degrees of the view: those of 4 m/s from about 4 m on.
- *Oracle*: is told of each ball within 1.5 m and avoids it like falanga2020. *Oracle, in view*: the
  same, told of a ball only while its centre is in the view of the reference camera
  (`oracle.field_of_view`). *Ratio*: the pilot's dodges by the oracle's on the same throws (95 %,
  Bonett and Price). Other intervals: 95 %, Wilson.
- *Hover, aimed less well*: other throws, at points around the vehicle's middle with a standard
  deviation of 0.4 m across and up, so that most balls miss a vehicle that stays.
- *Unharmed*: of all throws, those that left the vehicle unharmed, which is what the paper's outdoor
  "more than 90 % of the time" counts.
)";

struct Sum {
  Losses told, in_view;  // against the one oracle and the other
  Rate unharmed;

  // `seen` is flown by the oracle in view.
  void add(const ThrowResult& flown, const ThrowResult& seen) {
    told.add(flown);
    in_view.add(flown, seen);
    unharmed.add(flown.flown.unharmed());
  }
};

// Throws by the pilot and by the oracle in view; without those of which a flight failed.
template <class Both>
void for_each_flown(const LoadedCampaign& pilot, const LoadedCampaign& oracle_in_view, Both both) {
  for_each_throw(pilot, oracle_in_view, [&](const ThrowResult& flown, const ThrowResult& seen) {
    if (flown.flown.ok() && flown.oracle.ok() && flown.none.ok() && seen.flown.ok()) {
      both(flown, seen);
    }
  });
}

// The ball that is first within the range from the reference camera, when it comes there; empty if
// none does.
std::optional<ObjectView> first_within(double range_m, const Trajectory& trajectory,
                                       const CameraRig& rig) {
  constexpr TimeUs kStepUs = 1000;
  std::vector<Passage> passages;
  for (std::size_t i = 0; i < trajectory.sizes_m.size(); ++i) {
    passages.emplace_back(trajectory, rig, i);
  }
  for (TimeUs t_us = trajectory.start_us; t_us <= trajectory.end_us; t_us += kStepUs) {
    for (const Passage& passage : passages) {
      std::optional<ObjectView> view = passage.at(t_us);
      if (view && view->range_m() <= range_m) return view;
    }
  }
  return std::nullopt;
}

// Throws by falanga2020 and by the oracle in view: those in view within the range that falanga2020
// believes, those that are not, and all.
struct Sums {
  Sum in_view, not_in_view, all;

  void add(const LoadedCampaign& pilot, const LoadedCampaign& oracle_in_view) {
    const CameraRig rig = camera_rig(pilot.scenario);
    const double range_m = pilot.scenario.dodger.position.max_range_m;
    for_each_flown(pilot, oracle_in_view, [&](const ThrowResult& flown, const ThrowResult& seen) {
      const auto near = flown.trajectory.empty()
                            ? std::nullopt
                            : first_within(range_m, trajectory_from_bytes(flown.trajectory), rig);
      const bool visible = near && centre_in_image(rig.intrinsics, near->p_C);
      (visible ? in_view : not_in_view).add(flown, seen);
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
  Sums outdoors;
  Sum scattered;
  for (std::size_t i = 0; i < last; i += 2) outdoors.add(campaigns[i], campaigns[i + 1]);
  for_each_flown(
      campaigns[last], campaigns[last + 1],
      [&](const ThrowResult& flown, const ThrowResult& seen) { scattered.add(flown, seen); });
  table.rows = {row_of("in view within 1.5 m", outdoors.in_view),
                row_of("not in view within 1.5 m", outdoors.not_in_view),
                row_of("all of outdoor.md", outdoors.all),
                row_of("hover, aimed less well", scattered)};
  return {table.to_markdown() + "\n" + kMoreThrowsProtocol, table.to_csv()};
}

std::vector<PaperFlight> flights_of_more_throws() {
  std::vector<PaperFlight> flights;
  for (const char* name : {"outdoor_hover", "outdoor_goal", "outdoor_simultaneous",
                           "outdoor_consecutive", "outdoor_scattered"}) {
    const std::string scenario = std::string(name) + ".yaml";
    flights.push_back({name + std::string("_falanga2020"), scenario, {}});
    flights.push_back(
        {name + std::string("_oracle_in_view"),
         scenario,
         {paper_setting("pilot", kOraclePilot), paper_setting("oracle.field_of_view", "true")}});
  }
  return flights;
}

}  // namespace

PaperExperiment more_throws_experiment() {
  return {"more_throws", "Outdoors by what is in view, and aimed less well",
          flights_of_more_throws(), analyse_more_throws};
}

}  // namespace dodgesim

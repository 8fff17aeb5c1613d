// The avoidance experiments, indoors and outdoors: the paper's pilot and dodgesim on the same
// throws, each beside an oracle that is told of the object within the range that the pilot may
// believe.
#include <functional>
#include <set>
#include <span>

#include "dodge/presets.h"
#include "sim/base/formatted.h"
#include "sim/base/joined.h"
#include "sim/config/pilot.h"
#include "sim/files/text_table.h"
#include "sim/paper/experiment.h"
#include "sim/paper/losses.h"
#include "sim/paper/pair.h"

namespace dodgesim {

namespace {

constexpr const char* kAvoidanceProtocol = R"(How the protocol is read:

- *Dodged / would have hit*: only throws count that hit a vehicle which stays as it is, as in the
  paper's indoor experiments. The paper's outdoor "more than 90 % of the time" counts all throws,
  also those that would have missed: see more_throws.md.
- *Light*: outdoors 20,000 lux on white (daylight without the sun itself; assumed), indoors the 500
  of an office; it decides how fast and how noisy pixels are.
- *Speeds* are those of the first ball; further ones of the same throw may be faster or slower.
- *Oracle*: is told of the object's true state within 1.5 m of the camera, and then avoids it like
  falanga2020.
- *falanga2020* believes nothing beyond 1.5 m, as in the paper.
- *What perception lost*: here each pilot has an oracle of its own, which avoids like the pilot and
  is told of objects as far away as the pilot may believe them (`dodger.position.max_range_m`). A
  throw that the pilot lost and its oracle dodged is perception's loss; one that both lost is the
  loss of range, escape law, controller and rotors: another law may dodge it from the same range
  (field.md). A pilot may also dodge what its oracle loses: the rates of the two are not nested, and
  their ratio (95 %, Bonett and Price) may exceed 1. Throws with a flight that failed are left
  out.
- Intervals: 95 %, Wilson. p: exact McNemar test on the throws that one of the two pilots dodged
  and the other did not, of each row by itself: it is not corrected for how many rows there are.
)";

// A name in front of rows, and the throws in them; an empty name stands for all throws of a set.
struct Group {
  std::string name;
  std::function<bool(const ThrowResult&)> belongs;
};

bool any_throw(const ThrowResult&) { return true; }

// The throws of one scenario.
struct Set {
  std::string name;
  const LoadedCampaign* falanga2020;
  const LoadedCampaign* dodgesim;
};
using Sets = std::span<const Set>;

// Each scenario by falanga2020 and then by dodgesim, whose oracle is told of what it may believe.
std::vector<PaperFlight> flights_of_both(const std::vector<std::string>& scenarios) {
  const std::string range_m = formatted("%g", dodge::preset(kOwnPilot).position.max_range_m);
  std::vector<PaperFlight> flights;
  for (const std::string& scenario : scenarios) {
    flights.push_back({scenario + "_falanga2020", scenario + ".yaml", {}});
    flights.push_back(
        {scenario + "_dodgesim",
         scenario + ".yaml",
         {paper_setting("pilot", kOwnPilot), paper_setting("oracle.range_cap_m", range_m)}});
  }
  return flights;
}

PilotPair pair_of(Sets sets, const std::function<bool(const ThrowResult&)>& belongs) {
  PilotPair pair;
  for (const Set& set : sets) pair.add(*set.falanga2020, *set.dodgesim, belongs);
  return pair;
}

std::vector<std::string> success_row(const std::string& name, const PilotPair& pair) {
  return {name,
          rate_text(pair.first.success()),
          rate_text(pair.oracle.success()),
          rate_text(pair.second.success()),
          std::to_string(pair.paired.only_first) + " / " + std::to_string(pair.paired.only_second),
          p_text(mcnemar(pair.paired))};
}

void add_success(const std::string& name, Sets sets, const std::vector<Group>& groups,
                 TextTable& table) {
  for (const Group& group : groups) {
    const PilotPair pair = pair_of(sets, group.belongs);
    if (pair.paired.total() == 0) continue;
    table.rows.push_back(success_row(group.name.empty() ? name : name + ", " + group.name, pair));
  }
}

// The range within which the campaign's oracle is told of objects.
std::string range_text(const LoadedCampaign& campaign) {
  const double range_m = campaign.scenario.oracle.range_cap_m;
  return range_m == 0 ? "any" : formatted("%g m", range_m);
}

// "27 not detected, 3 seen late".
std::string causes_text(const std::map<std::string, int>& causes) {
  return joined(causes, [](const auto& cause_count) {
    return std::to_string(cause_count.second) + " " + cause_count.first;
  });
}

void add_losses(const std::string& name, Sets sets, const LoadedCampaign* Set::*pilot,
                TextTable& table) {
  Losses losses;
  for (const Set& set : sets) {
    for (const ThrowResult& result : (set.*pilot)->results) losses.add(result);
  }
  table.rows.push_back({name, pilot == &Set::falanga2020 ? kPaperPilot : kOwnPilot,
                        rate_text(losses.dodged()), range_text(*(sets.front().*pilot)),
                        rate_text(losses.dodged_by_oracle()), ratio_text(losses),
                        rate_text(losses.lost_to_perception()), causes_text(losses.perception),
                        rate_text(losses.lost_with_oracle()), causes_text(losses.with_oracle)});
}

TextTable cause_table(const PilotPair& all) {
  TextTable table;
  table.head = {"cause of hits and crashes", kPaperPilot, kOwnPilot};
  std::set<std::string> causes;
  for (const auto& [cause, count] : all.first_causes) causes.insert(cause);
  for (const auto& [cause, count] : all.second_causes) causes.insert(cause);
  const auto count = [](const std::map<std::string, int>& counts, const std::string& cause) {
    const auto found = counts.find(cause);
    return std::to_string(found == counts.end() ? 0 : found->second);
  };
  for (const std::string& cause : causes) {
    table.rows.push_back({cause, count(all.first_causes, cause), count(all.second_causes, cause)});
  }
  return table;
}

std::string causes_of_each(Sets sets) {
  std::string text;
  for (const Set& set : sets) {
    const TextTable table = cause_table(pair_of({&set, 1}, any_throw));
    if (!table.rows.empty()) text += set.name + ":\n\n" + table.to_markdown() + "\n";
  }
  return text;
}

// Rows for the groups of each set and, if there are several, of all of them together.
PaperTables avoidance_tables(Sets sets, const std::vector<Group>& groups,
                             const std::string& all_sets) {
  TextTable success, losses;
  success.head = {"throws",   "falanga2020: dodged / would have hit",         "oracle",
                  "dodgesim", "dodged by falanga2020 alone / dodgesim alone", "p"};
  losses.head = {"throws",
                 "pilot",
                 "dodged / would have hit",
                 "range of its oracle",
                 "dodged by its oracle",
                 "ratio",
                 "lost to perception: its oracle dodged",
                 "causes",
                 "lost to range, escape and vehicle: its oracle lost, too",
                 "causes"};
  const auto add = [&](const std::string& name, Sets some) {
    add_success(name, some, groups, success);
    add_losses(name, some, &Set::falanga2020, losses);
    add_losses(name, some, &Set::dodgesim, losses);
  };
  for (const Set& set : sets) add(set.name, {&set, 1});
  if (sets.size() > 1) add(all_sets, sets);
  return {success.to_markdown() + "\nWhat perception lost:\n\n" + losses.to_markdown() + "\n" +
              causes_of_each(sets) + kAvoidanceProtocol,
          success.to_csv()};
}

// The campaigns of falanga2020 and dodgesim take turns.
Set set_of(const std::string& name, const std::vector<LoadedCampaign>& campaigns,
           std::size_t number) {
  return {name, &campaigns[2 * number], &campaigns[2 * number + 1]};
}

std::vector<Group> speed_bands() {
  const auto band = [](const std::string& name, double from_mps, double to_mps) {
    return Group{name, [=](const ThrowResult& result) {
                   return result.speed_mps >= from_mps && result.speed_mps < to_mps;
                 }};
  };
  return {band("to 6 m/s", 0, 6.01),
          band("6 to 8 m/s", 6.01, 8.01),
          band("above 8 m/s", 8.01, 30),
          {"all", any_throw}};
}

PaperTables by_speed(const std::vector<LoadedCampaign>& campaigns) {
  std::vector<Set> sets;
  for (std::size_t i = 0; 2 * i < campaigns.size(); ++i) {
    sets.push_back(set_of(campaigns[2 * i].scenario.name, campaigns, i));
  }
  return avoidance_tables(sets, speed_bands(), "all sets");
}

// A shape of figure S6 and its longest extension.
struct Shape {
  const char* object;
  const char* size_m;
  int seed;
};
constexpr Shape kShapes[] = {{"ball", "0.1", 4021},      {"box", "0.3", 4022},
                             {"marker", "0.14", 4023},   {"frisbee", "0.27", 4024},
                             {"quadrotor", "0.3", 4025}, {"bowling_pin", "0.38", 4026}};

// They tumble as the scenario says, or fly as they are held, when the thin ones are hard to see.
// Each has throws of its own, so that all of them can be counted together.
constexpr int kSeedsNotTumbling = 20;  // after the others

std::vector<PaperFlight> flights_of_shapes() {
  std::vector<PaperFlight> flights;
  for (const bool tumbling : {true, false}) {
    for (const Shape& shape : kShapes) {
      const int seed = tumbling ? shape.seed : shape.seed + kSeedsNotTumbling;
      for (PaperFlight flight : flights_of_both({"outdoor_shapes"})) {
        flight.name += std::string("_") + shape.object + (tumbling ? "" : "_not_tumbling");
        flight.settings.push_back(paper_setting("throw.object", shape.object));
        flight.settings.push_back(paper_setting("throw.size_m", shape.size_m));
        flight.settings.push_back(paper_setting("seed", std::to_string(seed)));
        if (!tumbling) flight.settings.push_back(paper_setting("throw.spin_radps", "0"));
        flights.push_back(flight);
      }
    }
  }
  return flights;
}

PaperTables by_shape(const std::vector<LoadedCampaign>& campaigns) {
  std::vector<Set> sets;
  for (const bool tumbling : {true, false}) {
    for (const Shape& shape : kShapes) {
      const std::string name =
          std::string(shape.object) + ", " + shape.size_m + (tumbling ? " m" : " m, not tumbling");
      sets.push_back(set_of(name, campaigns, sets.size()));
    }
  }
  return avoidance_tables(sets, {{"", any_throw}}, "all shapes");
}

}  // namespace

PaperExperiment indoor_experiment() {
  return {"indoor", "Avoidance indoors: one camera, a ball of known size",
          flights_of_both({"indoor"}), by_speed};
}

PaperExperiment outdoor_experiment() {
  return {"outdoor", "Avoidance outdoors: hovering, flying to a goal, several balls",
          flights_of_both(
              {"outdoor_hover", "outdoor_goal", "outdoor_simultaneous", "outdoor_consecutive"}),
          by_speed};
}

PaperExperiment shapes_experiment() {
  return {"shapes", "Avoidance of the six shapes of figure S6", flights_of_shapes(), by_shape};
}

}  // namespace dodgesim

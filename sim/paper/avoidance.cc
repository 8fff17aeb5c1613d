// The avoidance experiments, indoors and outdoors: the paper's pilot, an oracle that is told of the
// object within the same 1.5 m, and dodgesim, on the same throws.
#include <algorithm>
#include <functional>
#include <set>

#include "sim/campaign/text_table.h"
#include "sim/paper/experiment.h"
#include "sim/paper/pair.h"

namespace dodgesim {

namespace {

constexpr const char* kProtocol = R"(How the protocol is read:

- *Dodged / would have hit*: only throws count that hit a vehicle which stays as it is, as in the
  paper's indoor experiments. The paper's outdoor "more than 90 % of the time" counts all throws,
  also those that would have missed: that is the column of all throws.
- *Oracle*: is told of the object's true state within 1.5 m of the camera, and then avoids it like
  falanga2020. It bounds what perception costs.
- *falanga2020* believes nothing beyond 1.5 m, as in the paper.
- Intervals: 95 %, Wilson. p: exact McNemar test on the throws that one of the two pilots dodged
  and the other did not.
)";

struct Group {
  std::string name;
  std::size_t set;  // of two campaigns: that of falanga2020, then that of dodgesim
  std::function<bool(const ThrowResult&)> belongs;
};

std::vector<PaperFlight> flights_of_both(const std::vector<std::string>& scenarios) {
  std::vector<PaperFlight> flights;
  for (const std::string& scenario : scenarios) {
    flights.push_back({scenario + "_falanga2020", scenario + ".yaml", {}});
    flights.push_back(
        {scenario + "_dodgesim", scenario + ".yaml", {paper_setting("pilot", "dodgesim")}});
  }
  return flights;
}

std::string p_text(double p) { return p < 0.0001 ? "< 0.0001" : fixed_text(p, 4); }

std::vector<std::string> success_row(const std::string& name, const PilotPair& pair) {
  return {name,
          rate_text(pair.first.success()),
          rate_text(pair.oracle.success()),
          rate_text(pair.second.success()),
          std::to_string(pair.paired.only_first) + " / " + std::to_string(pair.paired.only_second),
          p_text(mcnemar(pair.paired)),
          rate_text(pair.first_unharmed),
          rate_text(pair.second_unharmed)};
}

TextTable cause_table(const PilotPair& all) {
  TextTable table;
  table.head = {"cause of hits and crashes", "falanga2020", "dodgesim"};
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

// set_names: what each set of two campaigns is called above its table of causes.
PaperTables avoidance_tables(const std::vector<LoadedCampaign>& campaigns,
                             const std::vector<Group>& groups,
                             const std::vector<std::string>& set_names) {
  TextTable success;
  success.head = {"throws",
                  "falanga2020: dodged / would have hit",
                  "oracle",
                  "dodgesim",
                  "dodged by falanga2020 alone / dodgesim alone",
                  "p",
                  "all throws, falanga2020: unharmed",
                  "all throws, dodgesim"};
  std::string causes;
  for (const Group& group : groups) {
    const PilotPair pair =
        compare_pilots(campaigns[2 * group.set], campaigns[2 * group.set + 1], group.belongs);
    if (pair.first_unharmed.of == 0) continue;
    success.rows.push_back(success_row(group.name, pair));
  }
  for (std::size_t set = 0; set < set_names.size(); ++set) {
    const PilotPair all = compare_pilots(campaigns[2 * set], campaigns[2 * set + 1],
                                         [](const ThrowResult&) { return true; });
    const TextTable table = cause_table(all);
    if (table.rows.empty()) continue;
    causes += set_names[set] + ":\n\n" + table.to_markdown() + "\n";
  }
  return {success.to_markdown() + "\n" + causes + kProtocol, success.to_csv()};
}

// The groups of a set of throws by their speed.
void add_speeds(const LoadedCampaign& campaign, std::size_t set, std::vector<Group>& groups) {
  struct Band {
    double from, to;
    const char* name;
  };
  constexpr Band kBands[] = {
      {0, 6.01, "to 6 m/s"}, {6.01, 8.01, "6 to 8 m/s"}, {8.01, 30, "above 8 m/s"}};
  const std::string& name = campaign.scenario.name;
  for (const Band& band : kBands) {
    groups.push_back({name + ", " + band.name, set, [band](const ThrowResult& result) {
                        return result.speed_mps >= band.from && result.speed_mps < band.to;
                      }});
  }
  groups.push_back({name + ", all", set, [](const ThrowResult&) { return true; }});
}

PaperTables by_speed(const std::vector<LoadedCampaign>& campaigns) {
  std::vector<Group> groups;
  std::vector<std::string> set_names;
  for (std::size_t set = 0; 2 * set < campaigns.size(); ++set) {
    add_speeds(campaigns[2 * set], set, groups);
    set_names.push_back(campaigns[2 * set].scenario.name);
  }
  return avoidance_tables(campaigns, groups, set_names);
}

// A shape of figure S6 and its longest extension.
struct Shape {
  const char* object;
  const char* size_m;
};
constexpr Shape kShapes[] = {{"ball", "0.1"},     {"box", "0.3"},       {"marker", "0.14"},
                             {"frisbee", "0.27"}, {"quadrotor", "0.3"}, {"bowling_pin", "0.38"}};

std::vector<PaperFlight> flights_of_shapes() {
  std::vector<PaperFlight> flights;
  for (const Shape& shape : kShapes) {
    for (PaperFlight flight : flights_of_both({"outdoor_shapes"})) {
      flight.name += std::string("_") + shape.object;
      flight.settings.push_back(paper_setting("throw.object", shape.object));
      flight.settings.push_back(paper_setting("throw.size_m", shape.size_m));
      flights.push_back(flight);
    }
  }
  return flights;
}

PaperTables by_shape(const std::vector<LoadedCampaign>& campaigns) {
  std::vector<Group> groups;
  std::vector<std::string> set_names;
  for (std::size_t set = 0; set < std::size(kShapes); ++set) {
    set_names.push_back(std::string(kShapes[set].object) + ", " + kShapes[set].size_m + " m");
    groups.push_back({set_names.back(), set, [](const ThrowResult&) { return true; }});
  }
  return avoidance_tables(campaigns, groups, set_names);
}

}  // namespace

PaperExperiment indoor_experiment() {
  return {"indoor", "Avoidance indoors: one camera, a ball of known size",
          flights_of_both({"indoor"}), by_speed};
}

PaperExperiment outdoor_experiment() {
  return {"outdoor", "Avoidance outdoors: hovering, flying to a goal, several balls",
          flights_of_both({"outdoor_hover", "outdoor_goal", "outdoor_several"}), by_speed};
}

PaperExperiment shapes_experiment() {
  return {"shapes", "Avoidance of the six shapes of figure S6", flights_of_shapes(), by_shape};
}

}  // namespace dodgesim

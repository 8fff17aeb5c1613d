// What each part of the paper's repulsive field is worth: (28) instead of (27), |v| in (32), |F_z|,
// the decay (33).
#include <algorithm>
#include <stdexcept>

#include "sim/base/formatted.h"
#include "sim/paper/experiment.h"
#include "sim/paper/pair.h"
#include "sim/paper/rate_grid.h"

namespace dodgesim {

namespace {

const std::vector<PaperVariant>& variants() {
  const auto set = paper_setting;
  static const std::vector<PaperVariant> all = {
      {"faithful", "as in the paper", {}},
      {"classic",
       "(27) instead of (28) and (29), with |v| and |F_z|",
       {set("dodger.repulsive.field", "khosla"), set("dodger.repulsive.direction", "gradient")}},
      {"classic_magnitude",
       "(27) instead of (28), the direction (29)",
       {set("dodger.repulsive.field", "khosla")}},
      {"gradient",
       "the gradient's direction, as in (27), instead of (29)",
       {set("dodger.repulsive.direction", "gradient")}},
      {"no_speed",
       "without |v| of (32), the same k_r0 (4)",
       {set("dodger.repulsive.scale_by_speed", "false")}},
      {"classic_no_speed",
       "without |v| of (32), (27) instead of (28)",
       {set("dodger.repulsive.scale_by_speed", "false"), set("dodger.repulsive.field", "khosla")}},
      {"classic_whole",
       "the whole classic field (26), (27): no |v|, no |F_z|",
       {set("dodger.repulsive.scale_by_speed", "false"), set("dodger.repulsive.field", "khosla"),
        set("dodger.repulsive.direction", "gradient"), set("dodger.repulsive.upward", "false")}},
      {"no_speed_24",
       "without |v| of (32), k_r0 24",
       {set("dodger.repulsive.scale_by_speed", "false"), set("dodger.repulsive.k_r0", "24")}},
      {"no_upward", "without |F_z|", {set("dodger.repulsive.upward", "false")}},
      {"away",
       "away from the line of flight instead of (29)",
       {set("dodger.repulsive.direction", "away")}},
      {"closest_approach",
       "dodgesim's escape instead of the field",
       {set("dodger.escape.law", "closest_approach")}}};
  return all;
}

constexpr const char* kFieldProtocol = R"(How to read it:

- The oracle is told of the true object within the range, and avoids it by the variant. All variants
  meet the same throws. Dodged / would have hit (95 %, Wilson).
- *p*: exact McNemar test against the first row, over all speeds, of each row by itself: it is not
  corrected for how many rows there are.
- *Lost, gained*: throws that (28) alone dodges, and that (27) alone does; exact McNemar test.
- Over the open field, so that no wall ends an escape, and until 0.6 s after the ball's arrival.
- *Decay*: falanga2020 with its cameras, believing from 3 m on. The repulsive constant falls by
  exp(-lambda dt) while the object is not detected, that is, between its detections, too.
)";

PairedCounts paired(const LoadedCampaign& first, const LoadedCampaign& second, int sweep) {
  PilotPair pair;
  pair.add(first, second, [sweep](const ThrowResult& r) { return r.sweep == sweep; });
  return pair.paired;
}

// The campaign of a variant, by its file's name.
const LoadedCampaign& flown_by(const std::string& variant,
                               const std::vector<LoadedCampaign>& campaigns) {
  const auto named = [&](const PaperVariant& v) { return v.file == variant; };
  const auto at = std::ranges::find_if(variants(), named);
  if (at == variants().end()) throw std::logic_error("There is no variant " + variant + ".");
  return campaigns[static_cast<std::size_t>(at - variants().begin())];
}

// With |v| either magnitude asks for more than the vehicle's speed.
std::string without_speed_text(const std::vector<LoadedCampaign>& campaigns, int sweep) {
  const PairedCounts counts =
      paired(flown_by("no_speed", campaigns), flown_by("classic_no_speed", campaigns), sweep);
  return formatted("(27) instead of (28), both without |v|: %lld lost, %lld gained, p %s.\n\n",
                   static_cast<long long>(counts.only_first),
                   static_cast<long long>(counts.only_second), p_text(mcnemar(counts)).c_str());
}

// Success of every variant at one of the ranges, by speed.
RateGrid grid_of(const std::vector<LoadedCampaign>& campaigns, std::size_t range) {
  const Axis speeds("speed_mps", campaigns.front().results);
  const Part first = parts_of(campaigns.front()).at(range);
  RateGrid grid{"range " + sweep_value(first, "oracle.range_cap_m") + " m", speed_columns(speeds)};
  for (std::size_t v = 0; v < variants().size(); ++v) {
    grid.add_row(variants()[v].name, success_by(speeds, parts_of(campaigns[v]).at(range).results));
  }
  return grid;
}

TextTable decay_table(const LoadedCampaign& campaign) {
  TextTable table;
  table.head = {"lambda [1/s]", "dodged"};
  for (const Part& part : parts_of(campaign)) {
    Tally tally;
    for (const ThrowResult* result : part.results) tally.add(*result);
    table.rows.push_back(
        {sweep_value(part, "dodger.repulsive.lambda_decay_1ps"), short_rate_text(tally.success())});
  }
  return table;
}

PaperTables analyse_field(const std::vector<LoadedCampaign>& campaigns) {
  PaperTables tables;
  std::vector<RateGrid> grids;
  for (std::size_t range = 0; range < parts_of(campaigns.front()).size(); ++range) {
    grids.push_back(grid_of(campaigns, range));
    TextTable table = grids.back().table();
    table.head.push_back("p");
    for (std::size_t v = 0; v < variants().size(); ++v) {
      const auto sweep = static_cast<int>(range);
      table.rows[v].push_back(v == 0 ? ""
                                     : p_text(mcnemar(paired(campaigns[0], campaigns[v], sweep))));
    }
    tables.markdown +=
        table.to_markdown() + "\n" + without_speed_text(campaigns, static_cast<int>(range));
  }
  tables.markdown += decay_table(campaigns.back()).to_markdown() + "\n" + kFieldProtocol;
  tables.csv = rates_csv(grids);
  return tables;
}

}  // namespace

PaperExperiment field_experiment() {
  std::vector<PaperFlight> flights = flights_of("field_", "claims_field.yaml", variants());
  flights.push_back({"decay", "claims_decay.yaml", {}});
  return {"field", "What each part of the repulsive field is worth", flights, analyse_field};
}

}  // namespace dodgesim

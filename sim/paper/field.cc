// What each part of the paper's repulsive field is worth: (28) instead of (27), |v| in (32), |F_z|,
// the decay (33).
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
       "the classic field (26), (27)",
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
- Over the open field, so that no wall ends an escape, and until 0.6 s after the ball's arrival.
- *Decay*: falanga2020 with its cameras, believing from 3 m on. The repulsive constant falls by
  exp(-lambda dt) while the object is not detected, that is, between its detections, too.
)";

std::string p_against(const LoadedCampaign& faithful, const LoadedCampaign& variant, int sweep) {
  PilotPair pair;
  pair.add(faithful, variant, [sweep](const ThrowResult& r) { return r.sweep == sweep; });
  return p_text(mcnemar(pair.paired));
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
      table.rows[v].push_back(
          v == 0 ? "" : p_against(campaigns[0], campaigns[v], static_cast<int>(range)));
    }
    tables.markdown += table.to_markdown() + "\n";
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

// A state estimate that drifts in height, and the monitor that lands the vehicle when the range
// sensor disagrees with it.
#include "sim/base/numbers.h"
#include "sim/paper/experiment.h"
#include "sim/paper/rate_grid.h"

namespace dodgesim {

namespace {

constexpr const char* kDriftProtocol = R"(How to read it:

- The estimated height runs away from the true one at the drift's rate, from 2 s on (1 s where balls
  are thrown); the vehicle, which holds its estimated height, goes the other way. Whoever has no
  monitor flies into the floor or the ceiling.
- *Monitor*: lands the vehicle when the range sensor and the estimated height have differed by more
  than 0.3 m for 0.3 s, so at the soonest (drift up at 0.2 m/s) at 2 s + 0.3 m / 0.2 m/s + 0.3 s. The
  paper gives neither figure.
- *Landed*: touched the floor at no more than 1 m/s and 15 degrees, on purpose; *crashed*: touched the
  room otherwise. *Landing began*: median of the first commands to land (least to greatest).
- *Balls*: at 1.8 s, 20 cm, 5 m/s, from 3 m. At 0.5 m/s of drift the pilot gives up before they come,
  and on its way down it dodges nobody; a throw after that does not count as dodged. These flights end
  0.2 s after the ball, before anybody could touch the floor.
)";

struct Outcome {
  Rate landed, crashed;
  Measured landing_s;
  Tally tally;

  void add(const ThrowResult& result) {
    if (result.thrown()) tally.add(result);
    if (!result.flown.ok()) return;
    landed.add(result.landed_us.has_value());
    crashed.add(result.flown.crashed);
    if (result.landing_us) landing_s.add(seconds(*result.landing_us));
  }
};

std::string spread_text(const Measured& sample) {
  if (sample.count() == 0) return "-";
  const auto at = [&](double share) { return fixed_text(sample.quantile(share)->value, 2); };
  return at(0.5) + " (" + at(0) + " to " + at(1) + ")";
}

std::string on_or_off(bool on) { return on ? "on" : "off"; }

std::string monitor_text(const LoadedCampaign& campaign) {
  return on_or_off(campaign.scenario.dodger.height_monitor.enabled);
}

void add_row(const std::string& name, const std::string& drift_mps, const std::string& monitor,
             const Outcome& outcome, TextTable& table) {
  table.rows.push_back({name, drift_mps, monitor, short_rate_text(outcome.landed),
                        short_rate_text(outcome.crashed), spread_text(outcome.landing_s),
                        short_rate_text(outcome.tally.success())});
}

// Nobody throws; the campaign may switch the monitor.
void add_hover(const LoadedCampaign& campaign, TextTable& table) {
  for (const Part& part : parts_of(campaign)) {
    Outcome outcome;
    for (const ThrowResult* result : part.results) outcome.add(*result);
    const std::string monitor =
        part.values.empty()
            ? monitor_text(campaign)
            : on_or_off(sweep_value(part, "dodger.height_monitor.enabled") == "true");
    add_row("hover", to_text(campaign.scenario.sensors.state_estimate.height_drift_mps), monitor,
            outcome, table);
  }
}

void add_thrown_at(const LoadedCampaign& campaign, TextTable& table) {
  const Axis drifts("sensors.state_estimate.height_drift_mps", campaign.results);
  for (std::size_t i = 0; i < drifts.values().size(); ++i) {
    Outcome outcome;
    for (const ThrowResult& result : campaign.results) {
      if (drifts.of(result) == i) outcome.add(result);
    }
    add_row("balls", drifts.values()[i], monitor_text(campaign), outcome, table);
  }
}

PaperTables analyse_drift(const std::vector<LoadedCampaign>& campaigns) {
  TextTable table;
  table.head = {"flights", "drift [m/s]",       "monitor", "landed",
                "crashed", "landing began [s]", "dodged"};
  for (std::size_t i = 0; i + 1 < campaigns.size(); ++i) add_hover(campaigns[i], table);
  add_thrown_at(campaigns.back(), table);
  return {table.to_markdown() + "\n" + kDriftProtocol, table.to_csv()};
}

}  // namespace

PaperExperiment drift_experiment() {
  return {"drift",
          "A state estimate that drifts, and the range sensor",
          {{"drift_none", "drift_none.yaml", {}},
           {"drift_up", "drift_up.yaml", {}},
           {"drift_down", "drift_down.yaml", {}},
           {"drift_thrown_at", "drift_thrown_at.yaml", {}}},
          analyse_drift};
}

}  // namespace dodgesim

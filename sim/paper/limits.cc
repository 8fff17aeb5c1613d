// What the paper's pilot can dodge, by the speed of the object and by the distance from which on it
// is believed.
#include <cstddef>
#include <utility>

#include "sim/base/error.h"
#include "sim/config/pilot.h"
#include "sim/paper/avoidance_bound.h"
#include "sim/paper/experiment.h"
#include "sim/paper/rate_grid.h"

namespace dodgesim {

namespace {

double latency_s(const Scenario& scenario) {
  return latency_without_pilot_s(scenario) + seconds(scenario.delays.pilot_us());
}

constexpr const char* kSpeedProtocol = R"(How the claim is read:

- Balls of 10, 20 and 30 cm, by their speed over the ground. From 4 m/s on they come from 3 m to
  3.5 m. Slower ones come from 0.8 m to 1 m and the vehicle's height, because from 3 m they would be
  lobs that fall onto it; even so those of 3 m/s fall at 27 degrees and those of 2 m/s at 48 degrees
  when they arrive, and leave 0.3 s and 0.45 s. Nothing slower was thrown: it would mostly fall.
- *falanga2020* believes nothing beyond 1.5 m, as in the paper; *oracle, 1.5 m* is told of the true
  object from there on and avoids it likewise; *oracle* without a range is told at once. The oracles
  fly over the open field, where no wall ends an escape; they need nothing to look at.
- The vertical lines are the bound of "How fast is too fast" (Falanga et al. 2019) for a range of
  1.5 m and the delays of this chain, s / (tau + t_a), with the t_a of a point (sqrt(2 r / u)) and
  that of the vehicle's rotors, by the best of many manoeuvres at their limits (idealised: no
  vehicle with these rotors is as fast), until a ball of 20 cm that comes level touches the hull.
- Intervals: 95 %, Wilson.
)";

constexpr const char* kRangeProtocol = R"(How the claim is read:

- *falanga2020* believes detections up to the range (`dodger.position.max_range_m`), the oracle is
  told of the true object from there on.
- *Bound*: the fastest ball of 20 cm by "How fast is too fast" (Falanga et al. 2019),
  s / (tau + t_a), with the delays of this chain; t_a of a point (sqrt(2 r / u)) and of the
  vehicle's rotors, by the best of many manoeuvres at their limits (idealised: no vehicle with these
  rotors is as fast), until the ball touches the hull.
  The ticks in the plots are the least range for each speed by the rotors'.
- Intervals: 95 %, Wilson.
)";

struct SpeedCurve {
  std::vector<double> speed_mps;
  std::vector<std::string> columns;
  std::vector<Rate> rates;
  std::size_t slow = 0;  // so many of them are of slow balls, which come from less far

  void add(const Results& results, const LoadedCampaign& campaign) {
    const Axis speeds("speed_mps", campaign.results);
    const auto append = [](auto& all, const auto& more) {
      all.insert(all.end(), more.begin(), more.end());
    };
    append(speed_mps, speeds.middles());
    append(columns, speed_columns(speeds));
    append(rates, success_by(speeds, results));
  }
};

// Of the slow balls, then of the others.
SpeedCurve curve(std::size_t part, const LoadedCampaign& slow, const LoadedCampaign& fast) {
  SpeedCurve curve;
  curve.slow = Axis("speed_mps", slow.results).values().size();
  for (const LoadedCampaign* campaign : {&slow, &fast}) {
    const std::vector<Part> parts = parts_of(*campaign);
    if (part >= parts.size()) {
      throw ScenarioError(campaign->scenario.name + ": the experiment needs its sweep.");
    }
    curve.add(parts[part].results, *campaign);
  }
  return curve;
}

// Without a line from the slow balls to the others, which come from elsewhere.
void add_in_two(const std::string& name, int colour, const SpeedCurve& curve, Plot& plot) {
  const auto split = [&curve](const auto& all) {
    const auto at = all.begin() + static_cast<std::ptrdiff_t>(curve.slow);
    return std::pair(std::vector(all.begin(), at), std::vector(at, all.end()));
  };
  const auto [slow_mps, fast_mps] = split(curve.speed_mps);
  const auto [slow_rates, fast_rates] = split(curve.rates);
  add_curve(name, colour, slow_mps, slow_rates, plot);
  add_curve("", colour, fast_mps, fast_rates, plot);
}

PaperTables analyse_speed(const std::vector<LoadedCampaign>& campaigns) {
  const SpeedCurve curves[] = {
      curve(0, campaigns[0], campaigns[1]), curve(0, campaigns[2], campaigns[3]),
      curve(0, campaigns[4], campaigns[5]), curve(1, campaigns[4], campaigns[5])};
  const char* names[] = {kPaperPilot, kOwnPilot, "oracle, 1.5 m", kOraclePilot};
  RateGrid grid{"dodged", curves[0].columns};
  Plot plot;
  plot.title = "Throws dodged by their speed";
  plot.x = {"speed [m/s]", 0, curves[0].speed_mps.back() + 0.5, false};
  plot.y = dodged_axis();
  for (std::size_t i = 0; i < std::size(curves); ++i) {
    grid.add_row(names[i], curves[i].rates);
    add_in_two(names[i], static_cast<int>(i), curves[i], plot);
  }
  const Scenario& scenario = campaigns[1].scenario;
  const double tau_s = latency_s(scenario);
  const double point_mps = point_bound(scenario, 1.5).greatest_speed_mps(tau_s);
  const double rotors_mps = rotors_bound(scenario, 1.5).greatest_speed_mps(tau_s);
  add_mark("bound of 1.5 m: rotors, point", rotors_mps, plot);
  add_mark("", point_mps, plot);
  return {grid.table().to_markdown() + "\nBound for 1.5 m: " + fixed_text(point_mps, 1) +
              " m/s (point), " + fixed_text(rotors_mps, 1) + " m/s (rotors).\n\n" + kSpeedProtocol,
          rates_csv({grid}),
          {{"curves", plot}}};
}

struct RangeRows {
  RateGrid grid;
  std::vector<double> range_m = {};
};

RangeRows rows_of(const std::string& pilot, const std::string& key,
                  const LoadedCampaign& campaign) {
  const Axis speeds("speed_mps", campaign.results);
  RangeRows rows{{pilot, speed_columns(speeds)}};
  for (const Part& part : parts_of(campaign)) {
    rows.range_m.push_back(sweep_number(part, key));
    rows.grid.add_row(sweep_value(part, key) + " m", success_by(speeds, part.results));
  }
  return rows;
}

PaperPlot plot_of(const RangeRows& rows, const std::string& file, const LoadedCampaign& campaign) {
  Plot plot;
  plot.title = rows.grid.name + ": throws dodged by the range from which on they are believed";
  plot.x = {"range [m]", 0, 3.2, false};
  plot.y = dodged_axis();
  const RateGrid by_speed = rows.grid.transposed("");
  for (std::size_t i = 0; i < by_speed.rows.size(); ++i) {
    add_curve(by_speed.rows[i], static_cast<int>(i), rows.range_m, by_speed.rates[i], plot);
  }
  const AvoidanceBound bound = rotors_bound(campaign.scenario, 0);
  const Axis speeds("speed_mps", campaign.results);
  std::vector<double> least_m;
  for (const double speed_mps : speeds.middles()) {
    least_m.push_back(bound.least_range_m(speed_mps, latency_s(campaign.scenario)));
  }
  add_bounds("ticks: bound", least_m, plot);
  add_mark("1.5 m", 1.5, plot);
  return {file, plot};
}

TextTable bound_table(const std::vector<double>& range_m, const Scenario& scenario) {
  const double tau_s = latency_s(scenario);
  TextTable table;
  table.head = {"range", "bound, point [m/s]", "bound, rotors [m/s]"};
  AvoidanceBound point = point_bound(scenario, 0), rotors = rotors_bound(scenario, 0);
  for (const double s : range_m) {
    point.range_m = rotors.range_m = s;
    table.rows.push_back({fixed_text(s, 2) + " m", fixed_text(point.greatest_speed_mps(tau_s), 1),
                          fixed_text(rotors.greatest_speed_mps(tau_s), 1)});
  }
  return table;
}

PaperTables analyse_range(const std::vector<LoadedCampaign>& campaigns) {
  const RangeRows faithful = rows_of(kPaperPilot, "dodger.position.max_range_m", campaigns[0]);
  const RangeRows oracle = rows_of(kOraclePilot, "oracle.range_cap_m", campaigns[1]);
  return {
      faithful.grid.with_sum().table().to_markdown() + "\n" +
          oracle.grid.with_sum().table().to_markdown() + "\n" +
          bound_table(oracle.range_m, campaigns[1].scenario).to_markdown() + "\n" + kRangeProtocol,
      rates_csv({faithful.grid, oracle.grid}),
      {plot_of(faithful, kPaperPilot, campaigns[0]), plot_of(oracle, kOraclePilot, campaigns[1])}};
}

}  // namespace

PaperExperiment speed_experiment() {
  const std::string slow = "claims_speed_slow.yaml", fast = "claims_speed.yaml";
  const std::vector<Setting> own = {paper_setting("pilot", kOwnPilot)};
  const std::vector<Setting> oracle = {
      paper_setting("pilot", kOraclePilot),
      paper_setting("sweep", "{oracle.range_cap_m: [1.5, 0]}"), paper_setting("repeats", "60"),
      // No wall ends an escape.
      paper_setting("room", "field"), paper_setting("after_s", "0.6")};
  return {"speed",
          "Success against the speed of the object",
          {{"slow_falanga2020", slow, {}},
           {"speed_falanga2020", fast, {}},
           {"slow_dodgesim", slow, own},
           {"speed_dodgesim", fast, own},
           {"slow_oracle", slow, oracle},
           {"speed_oracle", fast, oracle}},
          analyse_speed};
}

PaperExperiment range_experiment() {
  return {"range",
          "Success against the range from which on an object is believed",
          {{"range_falanga2020", "claims_range.yaml", {}},
           {"range_oracle", "claims_range_oracle.yaml", {}}},
          analyse_range};
}

}  // namespace dodgesim

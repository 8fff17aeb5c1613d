// The claim behind event cameras: how late perception may be, by the speed of the object.
#include <algorithm>

#include "sim/base/error.h"
#include "sim/base/formatted.h"
#include "sim/config/pilot.h"
#include "sim/paper/avoidance_bound.h"
#include "sim/paper/experiment.h"
#include "sim/paper/rate_grid.h"

namespace dodgesim {

namespace {

constexpr const char* kLatencyProtocol = R"(How the claim is read:

- *Latency of perception*: 3.5 ms are the paper's, 60 ms those that it gives for its authors' earlier
  pilot, which segments streams of events with shallow neural networks. More than
  3.5 ms are a delay of every command of the pilot (`delays.perception_us`), which sees as often as
  before and only acts later. (A computer that takes longer for each cycle also sees less often:
  results/latency.)
  All other delays stay: packets of events, their transport, the wait for the next cycle, 3 ms to
  the flight controller, then the motors.
- *Lost at*: the greatest latency that was flown with at least half of the throws dodged, and the
  next one. In brackets, where that is not all that the throws can tell apart: the greatest up to
  which all intervals lie above one half, and the least with one below it; > or < if there is only
  one of the two, *not told* if there is none.
- *Bound*: "How fast is too fast" (Falanga et al. 2019), s / v - t_a, less the delays that are not
  perception's; s the range from which on the object is known, a ball of 20 cm that comes at the
  vehicle's centre. *point*: t_a = sqrt(2 r / u) of a vehicle that accelerates to the side at once
  with all its thrust but what keeps its height. *rotors*: by the best of many manoeuvres at the
  limits of its rotors, with their lag (idealised: no vehicle with these rotors is as fast), until
  the ball touches the hull.
  The ticks in the plots are that of the rotors; those beyond a plot's right end are left out.
- *falanga2020* believes nothing beyond 1.5 m, as in the paper.
- *oracle*: told of the true object within s, avoids it like falanga2020, over the open field, where
  no wall ends an escape. Intervals: 95 %, Wilson.
)";

constexpr double kPaperLatencyMs = 3.5, kFrameLatencyMs = 60;
constexpr double kPaperRangeM = 1.5, kFarRangeM = 3;

// Success of a pilot at each speed (rows) and latency (columns).
struct LatencyCurves {
  std::string pilot, file;
  double range_m;  // of the bound in its plot
  RateGrid grid = {};
  std::vector<double> latency_ms = {};  // of perception
};

double perception_ms(const Part& part, const DelaySpec& delays) {
  return 1e-3 * (delays.compute_us + sweep_number(part, "delays.perception_us"));
}

LatencyCurves curves_of(const std::string& pilot, const std::string& file, double range_m,
                        const std::vector<Part>& parts, const LoadedCampaign& campaign) {
  const Axis speeds("speed_mps", campaign.results);
  LatencyCurves curves{pilot, file, range_m};
  RateGrid by_latency{"", speed_columns(speeds)};
  for (const Part& part : parts) {
    curves.latency_ms.push_back(perception_ms(part, campaign.scenario.delays));
    by_latency.add_row(fixed_text(curves.latency_ms.back(), 1) + " ms",
                       success_by(speeds, part.results));
  }
  curves.grid = by_latency.transposed(pilot);
  return curves;
}

// The parts in which the oracle knows of objects within this range.
std::vector<Part> within(const std::string& range_m, const LoadedCampaign& campaign) {
  std::vector<Part> parts;
  for (const Part& part : parts_of(campaign)) {
    if (sweep_value(part, "oracle.range_cap_m") == range_m) parts.push_back(part);
  }
  if (parts.empty())
    throw ScenarioError("The experiment needs oracle.range_cap_m " + range_m + ".");
  return parts;
}

// At each speed [ms]; negative if there is no time at all.
std::vector<double> bounds_ms(const AvoidanceBound& bound, const LoadedCampaign& campaign) {
  const Axis speeds("speed_mps", campaign.results);
  std::vector<double> bounds;
  for (const double speed_mps : speeds.middles()) {
    bounds.push_back(
        1e3 * (bound.greatest_latency_s(speed_mps) - latency_without_pilot_s(campaign.scenario)));
  }
  return bounds;
}

// The bound of the fastest objects is always within the plot.
PaperPlot plot_of(const LatencyCurves& curves, const LoadedCampaign& campaign) {
  const std::vector<double> bounds =
      bounds_ms(rotors_bound(campaign.scenario, curves.range_m), campaign);
  const double least_ms = *std::ranges::min_element(bounds);
  Plot plot;
  plot.title = curves.pilot + ": throws dodged by latency of perception";
  plot.x = {"latency of perception [ms]", 0, 1.05 * std::max(curves.latency_ms.back(), least_ms),
            false};
  plot.y = dodged_axis();
  for (std::size_t i = 0; i < curves.grid.rows.size(); ++i) {
    add_curve(curves.grid.rows[i], static_cast<int>(i), curves.latency_ms, curves.grid.rates[i],
              plot);
  }
  add_bounds(formatted("ticks: bound, %g m", curves.range_m), bounds, plot);
  add_mark("3.5 ms and 60 ms", kPaperLatencyMs, plot);
  add_mark("", kFrameLatencyMs, plot);
  return {curves.file, plot};
}

// "60 to 100", "> 60", "< 100": after the latency of one index and before that of another.
std::string between_text(const LatencyCurves& curves, std::optional<std::size_t> after,
                         std::optional<std::size_t> before) {
  const auto text = [&](std::size_t i) { return fixed_text(curves.latency_ms[i], i == 0 ? 1 : 0); };
  if (!after && !before) return "not told";
  if (!after) return "< " + text(*before);
  if (!before) return "> " + text(*after);
  return text(*after) + " to " + text(*before);
}

// Between which latencies a speed is lost.
std::string lost_text(const LatencyCurves& curves, std::size_t speed) {
  const std::vector<Rate>& rates = curves.grid.rates[speed];
  const std::optional<std::size_t> last = last_half(rates);
  const std::size_t next = last ? *last + 1 : 0;
  const auto or_none = [&](std::size_t i) {
    return i < rates.size() ? std::optional(i) : std::nullopt;
  };
  std::optional<std::size_t> surely_dodged;
  for (std::size_t i = 0; i < rates.size() && rates[i].interval().lo > 0.5; ++i) surely_dodged = i;
  std::size_t surely_lost = 0;
  while (surely_lost < rates.size() && rates[surely_lost].interval().hi >= 0.5) ++surely_lost;
  std::string text = between_text(curves, last, or_none(next));
  if (surely_dodged != last || surely_lost != next) {
    text += " (" + between_text(curves, surely_dodged, or_none(surely_lost)) + ")";
  }
  return text;
}

TextTable lost_table(const std::vector<LatencyCurves>& all, const LoadedCampaign& campaign) {
  std::vector<std::vector<double>> bounds;
  for (const double range_m : {kPaperRangeM, kFarRangeM}) {
    bounds.push_back(bounds_ms(point_bound(campaign.scenario, range_m), campaign));
    bounds.push_back(bounds_ms(rotors_bound(campaign.scenario, range_m), campaign));
  }
  TextTable table;
  table.head = {"lost at [ms]", "bound 1.5 m, point", "bound 1.5 m, rotors", "bound 3 m, point",
                "bound 3 m, rotors"};
  for (const LatencyCurves& curves : all) table.head.push_back(curves.pilot);
  const Axis speeds("speed_mps", campaign.results);
  for (std::size_t i = 0; i < speeds.values().size(); ++i) {
    std::vector<std::string>& row = table.rows.emplace_back();
    row.push_back(speeds.values()[i] + " m/s");
    for (const std::vector<double>& bound_ms : bounds) {
      row.push_back(bound_ms[i] > 0 ? fixed_text(bound_ms[i], 0) : "none");
    }
    for (const LatencyCurves& curves : all) row.push_back(lost_text(curves, i));
  }
  return table;
}

std::string rest_text(const Scenario& scenario) {
  return formatted(
      "From light to the rotors' command it takes %.1f ms more than the perception, in "
      "the mean: the wait for packets and cycles, and the links.\n\n",
      1e3 * latency_without_pilot_s(scenario));
}

PaperTables analyse_latency(const std::vector<LoadedCampaign>& campaigns) {
  const LoadedCampaign &oracle = campaigns[0], &faithful = campaigns[1], &own = campaigns[2];
  const std::vector<LatencyCurves> all = {
      curves_of("oracle, 1.5 m", "oracle_1_5m", kPaperRangeM, within("1.5", oracle), oracle),
      curves_of("oracle, 3 m", "oracle_3m", kFarRangeM, within("3", oracle), oracle),
      curves_of("falanga2020, 1.5 m", kPaperPilot, kPaperRangeM, parts_of(faithful), faithful),
      curves_of(kOwnPilot, kOwnPilot, kFarRangeM, parts_of(own), own)};
  PaperTables tables;
  std::vector<RateGrid> grids;
  tables.markdown = lost_table(all, oracle).to_markdown() + "\n" + rest_text(oracle.scenario);
  for (const LatencyCurves& curves : all) {
    tables.plots.push_back(plot_of(curves, oracle));
    tables.markdown += curves.grid.table().to_markdown() + "\n";
    grids.push_back(curves.grid);
  }
  tables.csv = rates_csv(grids);
  tables.markdown += kLatencyProtocol;
  return tables;
}

}  // namespace

PaperExperiment latency_experiment() {
  const std::string sweep = "claims_latency.yaml";
  return {"latency",
          "Success against the latency of perception",
          {{"latency_oracle", "claims_latency_oracle.yaml", {}},
           {"latency_falanga2020", sweep, {}},
           {"latency_dodgesim", sweep, {paper_setting("pilot", kOwnPilot)}}},
          analyse_latency};
}

}  // namespace dodgesim

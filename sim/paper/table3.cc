// Table 3 of Falanga et al. 2020: how long the stages of the detection take, on this machine.
#include <algorithm>
#include <filesystem>

#include "sim/base/error.h"
#include "sim/files/text_table.h"
#include "sim/paper/experiment.h"

namespace dodgesim {

namespace {

constexpr const char* kTable3Protocol = R"(How the protocol is read:

- The flight core alone, one camera and one thread, on recorded flights (scenarios/demo.yaml and
  scenarios/goal_flight.yaml): mean (standard deviation) in ms over the windows with so many events,
  and the share of the four stages together; medians of three runs.
- The paper's computer is a Jetson TX2, and its windows have 2000 to 6000 events.
- *Clustering* is that with the optical flow, *mean time stamp* that with normalisation, blur and
  cut. For the last column windows are 30 ms long.
- The pictures are figures S4 and S5; table3/windows.csv has their points.
- These are times: no two runs give the same, and only this table and its pictures differ from one
  run of the command to the next. Nothing else should run on the machine.
)";

// A row, and what the paper has there [ms].
struct Stage {
  const char* quantity;
  const char* name;
  const char* paper;
};
constexpr Stage kStages[] = {{"ego_motion", "ego-motion compensation", "1.31 (0.35), 37 %"},
                             {"threshold", "mean time stamp and threshold", "0.98 (0.05), 28 %"},
                             {"morphology", "morphology", "0.58 (0.04), 16 %"},
                             {"clustering", "clustering", "0.69 (0.20), 19 %"},
                             {"detection", "together", "3.56 (0.45)"}};

struct Load {
  const char* quantity;
  const char* name;
};
constexpr Load kLoads[] = {{"typical", "2000 to 6000 events"},
                           {"6000", "5500 to 6500 events"},
                           {"20000", "18,000 to 22,000 events"}};

double median_of(const std::string& name, const std::vector<Measurement>& measured) {
  const auto found =
      std::ranges::find_if(measured, [&](const Measurement& m) { return m.quantity.name == name; });
  if (found == measured.end()) throw ScenarioError("Table 3 needs the quantity " + name + ".");
  return found->median();
}

// "0.032 (0.008), 19 %"; together without a share.
std::string cell(const Stage& stage, const Load& load, const std::vector<Measurement>& measured) {
  const std::string name = std::string("pilot.") + load.quantity + "." + stage.quantity;
  std::string text = fixed_text(median_of(name, measured), 3) + " (" +
                     fixed_text(median_of(name + "_sd", measured), 3) + ")";
  const bool together = &stage == std::end(kStages) - 1;
  if (!together) text += ", " + fixed_text(100 * median_of(name + "_share", measured), 0) + " %";
  return text;
}

TextTable stage_table(const std::vector<Measurement>& measured) {
  TextTable table;
  table.head = {"stage", "the paper"};
  for (const Load& load : kLoads) table.head.push_back(load.name);
  for (const Stage& stage : kStages) {
    std::vector<std::string>& row = table.rows.emplace_back();
    row = {stage.name, stage.paper};
    for (const Load& load : kLoads) row.push_back(cell(stage, load, measured));
  }
  std::vector<std::string>& windows = table.rows.emplace_back();
  windows = {"windows", ""};
  for (const Load& load : kLoads) {
    const std::string name = std::string("pilot.") + load.quantity + ".windows";
    windows.push_back(fixed_text(median_of(name, measured), 0));
  }
  return table;
}

std::string slopes_text(const std::vector<Measurement>& measured) {
  return "Least squares: " + fixed_text(median_of("pilot.curve.ego_motion", measured), 1) +
         " ns an event for ego-motion compensation, " +
         fixed_text(median_of("pilot.curve.clustering", measured), 0) +
         " ns a pixel for clustering.\n\n";
}

std::string quantities_csv(const std::vector<Measurement>& measured) {
  TextTable csv;
  csv.head = {"quantity", "median", "unit"};
  for (const Measurement& measurement : measured) {
    csv.rows.push_back({measurement.quantity.name, fixed_text(measurement.median(), 4),
                        measurement.quantity.unit});
  }
  return csv.to_csv();
}

PaperTables measure_table3(const BenchOptions& options) {
  BenchOptions own = options;
  own.runs = 3;
  own.plots_dir = std::filesystem::path(options.plots_dir) / "table3";
  return table3_of(measure(pilot_cases(), own, [](const Measurement&) {}));
}

}  // namespace

PaperTables table3_of(const std::vector<Measurement>& measured) {
  return {
      "![S4: ego-motion compensation over events](table3/ego_motion.png)\n"
      "![S5: clustering over pixels](table3/clustering.png)\n\n" +
          stage_table(measured).to_markdown() + "\n" + slopes_text(measured) + kTable3Protocol,
      quantities_csv(measured)};
}

PaperExperiment table3_experiment() {
  return {"table3", "Table 3: the time of each stage", {}, nullptr, measure_table3};
}

}  // namespace dodgesim

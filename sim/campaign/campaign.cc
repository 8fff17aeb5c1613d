#include "sim/campaign/campaign.h"

#include <chrono>
#include <fstream>
#include <sstream>

#include "sim/base/error.h"
#include "sim/campaign/csv.h"
#include "sim/campaign/manifest.h"
#include "sim/campaign/progress.h"
#include "sim/campaign/tables.h"
#include "sim/config/resolve_throw.h"
#include "sim/files/output_file.h"

namespace dodgesim {

namespace {

namespace fs = std::filesystem;

constexpr const char* kScenarioFile = "scenario.resolved.yaml";
constexpr const char* kResultFiles[] = {"manifest.json", "throws.csv", "detections.csv",
                                        "timing.csv",    "table.md",   "table.csv",
                                        "truth.csv"};

std::string read_file(const fs::path& path) {
  std::ifstream file(path, std::ios::binary);
  std::ostringstream text;
  text << file.rdbuf();
  if (!file) throw IoError(path.string() + " could not be read.");
  return text.str();
}

// Makes `out` ready: a directory that holds the resolved scenario and no results.
void prepare(const fs::path& out, const std::string& resolved, bool force) {
  std::error_code error;
  fs::create_directories(out, error);
  if (!fs::is_directory(out)) {
    throw IoError(out.string() + " could not be created: " +
                  (error ? error.message() : "a file of that name exists") + ".");
  }
  if (!force && !fs::is_empty(out)) {
    if (!fs::exists(out / kScenarioFile)) {
      throw ScenarioError(out.string() +
                          " is neither empty nor a campaign; choose another directory or add "
                          "--force.");
    }
    if (read_file(out / kScenarioFile) != resolved) {
      throw ScenarioError(out.string() +
                          " holds the results of another scenario; choose another directory or add "
                          "--force to overwrite them.");
    }
  }
  // Results of an earlier run must not stand beside the scenario of this one.
  for (const char* name : kResultFiles) {
    fs::remove(out / name, error);
    if (error) {
      throw IoError((out / name).string() + " could not be removed: " + error.message() + ".");
    }
  }
  write_file(out / kScenarioFile, resolved);
}

// The files that grow throw by throw.
class ResultFiles {
 public:
  ResultFiles(const fs::path& out, bool truth)
      : throws_(out / "throws.csv"),
        detections_(out / "detections.csv"),
        timing_(out / "timing.csv") {
    throws_.write(csv_header<ThrowResult>());
    detections_.write(csv_header<DetectionRow>());
    timing_.write("throw,simulated_s,wall_s,real_time_factor\n");
    if (!truth) return;
    truth_.emplace(out / "truth.csv");
    truth_->write(csv_header<EventTruthRow>());
  }

  void add(const ThrowResult& result) {
    throws_.write(csv_row(result));
    for (const DetectionRow& row : result.detection_rows) detections_.write(csv_row(row));
    const double simulated_s = seconds(result.duration_us);
    timing_.write(to_text(result.index) + "," + to_text(simulated_s) + "," +
                  to_text(result.wall_s) + "," +
                  (result.wall_s > 0 ? to_text(simulated_s / result.wall_s) : "") + "\n");
    if (!truth_) return;
    for (const EventTruthRow& row : result.truth_rows) truth_->write(csv_row(row));
  }

  void commit() {
    throws_.commit();
    detections_.commit();
    timing_.commit();
    if (truth_) truth_->commit();
  }

 private:
  OutputFile throws_, detections_, timing_;
  std::optional<OutputFile> truth_;
};

bool any_error(const ThrowResult& result) {
  return result.flown.failed() || result.none.failed() || result.oracle.failed();
}

}  // namespace

ThrowResult blank_result(const Scenario& scenario, int index) {
  ThrowResult result;
  result.index = index;
  if (!scenario.toss) return result;
  const Throw toss = resolve_throw(scenario, index);
  result.object = toss.object.kind;
  result.size_m = toss.object.size_m;
  result.speed_mps = toss.speed_mps;
  result.distance_m = toss.distance_m;
  result.bearing_deg = toss.bearing_deg;
  result.aim_offset_m = {toss.aim_offset_m.x(), toss.aim_offset_m.y()};
  result.spin_radps = {toss.spin_radps.x(), toss.spin_radps.y(), toss.spin_radps.z()};
  result.launch_height_m = toss.launch_height_m;
  result.launch_us = toss.launch_us;
  return result;
}

CampaignSummary run_campaign(const Scenario& scenario, const CampaignOptions& options,
                             const FlyFunction& fly) {
  const auto begin = std::chrono::steady_clock::now();
  const std::string started = utc_now();
  prepare(options.out, to_yaml(scenario), options.force);

  ResultFiles files(options.out, options.truth);
  CampaignSummary summary;
  Progress progress(scenario.repeats, options.show_progress);
  double simulated_s = 0, computing_s = 0;

  WorkerTasks tasks;
  tasks.throws = scenario.repeats;
  tasks.jobs = options.jobs;
  tasks.fly = fly;
  tasks.blank = [&](int index) { return blank_result(scenario, index); };
  tasks.receive = [&](ThrowResult result) {
    files.add(result);
    simulated_s += seconds(result.duration_us);
    computing_s += result.wall_s;
    if (any_error(result)) ++summary.errors;
    summary.truth.add(result.truth_rows);
    result.truth_rows.clear();
    result.truth_rows.shrink_to_fit();
    result.detection_rows.clear();
    result.detection_rows.shrink_to_fit();
    summary.results.push_back(std::move(result));
  };
  tasks.progress = [&](int finished) { progress.show(finished); };
  fly_in_workers(tasks);
  progress.finish();

  const Tables tables = make_tables(summary.results, scenario.name, scenario.pilot);
  summary.table = tables.markdown;
  summary.wall_s = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  if (computing_s > 0) summary.real_time_factor = simulated_s / computing_s;

  files.commit();
  write_file(options.out / "table.md", tables.markdown);
  write_file(options.out / "table.csv", tables.csv);
  write_file(options.out / "manifest.json", manifest_json(scenario, options, summary, started));
  return summary;
}

}  // namespace dodgesim

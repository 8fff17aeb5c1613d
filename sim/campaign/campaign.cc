#include "sim/campaign/campaign.h"

#include <chrono>
#include <optional>

#include "sim/base/error.h"
#include "sim/campaign/build_info.h"
#include "sim/campaign/campaign_directory.h"
#include "sim/campaign/early_stop.h"
#include "sim/campaign/journal.h"
#include "sim/campaign/manifest.h"
#include "sim/campaign/progress.h"
#include "sim/campaign/result_files.h"
#include "sim/config/resolve_throw.h"
#include "sim/files/output_file.h"

namespace dodgesim {

namespace {

namespace fs = std::filesystem;

CampaignIdentity identity_of(const Scenario& scenario, const CampaignOptions& options) {
  return {to_yaml(scenario), build_info().name(), options.models, options.truth};
}

// Numbers of the shard's throws.
std::vector<int> throws_of(const Scenario& scenario, const Shard& shard) {
  std::vector<int> throws;
  const int count = throw_count(scenario);
  for (int i = shard.index; i < count; i += shard.count) throws.push_back(i);
  return throws;
}

// Results of other throws must not be counted as the shard's.
void expect_throws_of(const Shard& shard, const Scenario& scenario, const JournalIndex& index,
                      const fs::path& out) {
  for (const auto& [number, record] : index.throws) {
    if (number >= 0 && number < throw_count(scenario) && number % shard.count == shard.index)
      continue;
    throw ScenarioError(out.string() + " holds a result of throw " + std::to_string(number) +
                        ", which is not one of shard " + std::to_string(shard.index) + " of " +
                        std::to_string(shard.count) +
                        "; choose another directory, or add --force to start anew.");
  }
}

double seconds_since(std::chrono::steady_clock::time_point begin) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
}

// Ends a campaign early when the scenario asks for it.
std::optional<EarlyStop> early_stop(const Scenario& scenario, const CampaignOptions& options,
                                    const std::optional<JournalIndex>& found) {
  if (!scenario.stop) return std::nullopt;
  if (options.shard.count > 1) {
    throw ScenarioError(
        "The scenario's key stop and --shard exclude each other: a part does not "
        "know the results of the others.");
  }
  EarlyStop stop(scenario);
  if (found) {
    for_each_result(options.out / kJournalFile, *found, [&stop](const ThrowResult& result) {
      if (!result.lost()) stop.add(result);
    });
  }
  return stop;
}

// A throw that was lost with its worker is flown again.
bool has_flown(const JournalIndex& found, int throw_index) {
  const auto at = found.throws.find(throw_index);
  return at != found.throws.end() && !at->second.lost;
}

// Flies what the journal lacks.
void fly_missing(const Scenario& scenario, const CampaignOptions& options, const FlyFunction& fly,
                 const std::optional<JournalIndex>& found, std::optional<EarlyStop>& early_stop,
                 CampaignSummary& summary) {
  const fs::path path = options.out / kJournalFile;
  std::optional<Journal> journal;
  if (found) {
    journal.emplace(path, *found);
  } else {
    journal.emplace(path, identity_of(scenario, options));
  }
  WorkerTasks tasks;
  for (const int throw_index : throws_of(scenario, options.shard)) {
    ++summary.wanted;
    if (!found || !has_flown(*found, throw_index)) tasks.throws.push_back(throw_index);
  }
  tasks.jobs = options.jobs;
  tasks.limits = options.limits;
  tasks.fly = fly;
  tasks.stop = [&] {
    return (early_stop && early_stop->end()) || (options.stop && options.stop());
  };
  tasks.blank = [&](int index) { return blank_result(case_of(scenario, index)); };
  Progress progress(static_cast<std::int64_t>(tasks.throws.size()), options.show_progress);
  tasks.receive = [&](const ThrowResult& result) {
    journal->add(result);
    if (early_stop) early_stop->add(result);
    progress.show(++summary.flown);
  };
  if (early_stop && early_stop->end()) tasks.throws.clear();
  summary.memory = fly_in_workers(tasks);
  journal->sync();
  if (early_stop && early_stop->end()) {
    summary.wanted = *early_stop->end();
  } else {
    summary.missing = static_cast<int>(tasks.throws.size()) - summary.flown;
  }
}

ObjectRow as_drawn(const Throw& toss, int throw_index, int object) {
  ObjectRow row;
  row.throw_index = throw_index;
  row.object = object;
  row.kind = toss.object.kind;
  row.size_m = toss.object.size_m;
  row.speed_mps = toss.speed_mps;
  row.distance_m = toss.distance_m;
  row.bearing_deg = toss.bearing_deg;
  row.aim_offset_m = {toss.aim_offset_m.x(), toss.aim_offset_m.y()};
  row.spin_radps = {toss.spin_radps.x(), toss.spin_radps.y(), toss.spin_radps.z()};
  row.launch_height_m = toss.launch_height_m;
  row.launch_us = toss.launch_us;
  return row;
}

}  // namespace

ThrowResult blank_result(const ThrowCase& thrown) {
  ThrowResult result;
  result.index = thrown.index;
  result.cell = thrown.cell;
  result.sweep = thrown.sweep;
  result.cell_values = thrown.cell_values;
  result.sweep_values = thrown.sweep_values;
  for (const Throw& toss : resolve_throws(thrown.scenario, thrown.stream)) {
    result.object_rows.push_back(as_drawn(toss, thrown.index, result.objects++));
  }
  if (result.objects == 0) return result;
  const ObjectRow& first = result.object_rows.front();
  result.object = first.kind;
  result.size_m = first.size_m;
  result.speed_mps = first.speed_mps;
  result.distance_m = first.distance_m;
  result.bearing_deg = first.bearing_deg;
  result.aim_offset_m = first.aim_offset_m;
  result.spin_radps = first.spin_radps;
  result.launch_height_m = first.launch_height_m;
  result.launch_us = first.launch_us;
  return result;
}

CampaignSummary run_campaign(const Scenario& scenario, const CampaignOptions& options,
                             const FlyFunction& fly) {
  const auto begin = std::chrono::steady_clock::now();
  const std::string started = utc_now();
  make_directory(options.out);
  const DirectoryLock lock(options.out);
  const auto found = find_journal(options, identity_of(scenario, options));
  if (found) expect_throws_of(options.shard, scenario, *found, options.out);
  std::optional<EarlyStop> stop = early_stop(scenario, options, found);
  remove_result_files(options.out);
  write_file(options.out / kScenarioFile, to_yaml(scenario));

  CampaignSummary summary;
  fly_missing(scenario, options, fly, found, stop, summary);
  JournalIndex index = read_journal(options.out / kJournalFile);
  // Throws beyond the early end may have been flown meanwhile: they do not count.
  if (stop && stop->end()) {
    index.throws.erase(index.throws.lower_bound(summary.wanted), index.throws.end());
  }
  if (summary.missing > 0) return summary;
  write_result_files(options.out, scenario, index, options.truth, summary);
  summary.wall_s = seconds_since(begin);
  write_file(options.out / "manifest.json", manifest_json(scenario, options, summary, started));
  return summary;
}

}  // namespace dodgesim

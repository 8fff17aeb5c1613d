#include "sim/campaign/campaign.h"

#include <chrono>
#include <optional>

#include "sim/base/error.h"
#include "sim/campaign/build_info.h"
#include "sim/campaign/campaign_directory.h"
#include "sim/campaign/journal.h"
#include "sim/campaign/manifest.h"
#include "sim/campaign/progress.h"
#include "sim/campaign/result_files.h"
#include "sim/config/resolve_throw.h"
#include "sim/files/output_file.h"

namespace dodgesim {

namespace {

namespace fs = std::filesystem;

std::string program_name() {
  const BuildInfo build = build_info();
  return build.version + " " + build.commit + (build.modified ? " modified" : "");
}

CampaignIdentity identity_of(const Scenario& scenario, const CampaignOptions& options) {
  return {to_yaml(scenario), program_name(), options.truth};
}

// Numbers of the shard's throws.
std::vector<int> throws_of(const Scenario& scenario, const Shard& shard) {
  std::vector<int> throws;
  for (int i = shard.index; i < scenario.repeats; i += shard.count) throws.push_back(i);
  return throws;
}

// Results of other throws must not be counted as the shard's.
void expect_throws_of(const Shard& shard, const Scenario& scenario, const JournalIndex& index,
                      const fs::path& out) {
  for (const auto& [number, record] : index.throws) {
    if (number >= 0 && number < scenario.repeats && number % shard.count == shard.index) continue;
    throw ScenarioError(out.string() + " holds a result of throw " + std::to_string(number) +
                        ", which is not one of shard " + std::to_string(shard.index) + " of " +
                        std::to_string(shard.count) +
                        "; choose another directory, or add --force to start anew.");
  }
}

double seconds_since(std::chrono::steady_clock::time_point begin) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
}

// Flies what the journal lacks.
void fly_missing(const Scenario& scenario, const CampaignOptions& options, const FlyFunction& fly,
                 const std::optional<JournalIndex>& found, CampaignSummary& summary) {
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
    if (!found || found->throws.count(throw_index) == 0) tasks.throws.push_back(throw_index);
  }
  tasks.jobs = options.jobs;
  tasks.limits = options.limits;
  tasks.fly = fly;
  tasks.stop = options.stop;
  tasks.blank = [&](int index) { return blank_result(scenario, index); };
  Progress progress(static_cast<std::int64_t>(tasks.throws.size()), options.show_progress);
  tasks.receive = [&](const ThrowResult& result) {
    journal->add(result);
    progress.show(++summary.flown);
  };
  summary.memory = fly_in_workers(tasks);
  journal->sync();
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
  make_directory(options.out);
  const DirectoryLock lock(options.out);
  const auto found = find_journal(options, identity_of(scenario, options));
  if (found) expect_throws_of(options.shard, scenario, *found, options.out);
  remove_result_files(options.out);
  write_file(options.out / kScenarioFile, to_yaml(scenario));

  CampaignSummary summary;
  fly_missing(scenario, options, fly, found, summary);
  const JournalIndex index = read_journal(options.out / kJournalFile);
  if (static_cast<int>(index.throws.size()) < summary.wanted) {
    summary.results.resize(index.throws.size());
    return summary;
  }
  write_result_files(options.out, scenario, index, options.truth, summary);
  summary.wall_s = seconds_since(begin);
  write_file(options.out / "manifest.json", manifest_json(scenario, options, summary, started));
  return summary;
}

}  // namespace dodgesim

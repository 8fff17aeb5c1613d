#include "sim/campaign/running_campaign.h"

#include "sim/base/error.h"
#include "sim/campaign/build_info.h"
#include "sim/campaign/campaign_files.h"
#include "sim/campaign/manifest.h"
#include "sim/campaign/result_files.h"
#include "sim/files/directory.h"
#include "sim/files/output_file.h"

namespace dodgesim {

namespace {

namespace fs = std::filesystem;

CampaignIdentity identity_of(const Scenario& scenario, const CampaignOptions& options) {
  return {to_yaml(scenario), build_info().name(), options.models, options.plugin, options.truth};
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

}  // namespace

RunningCampaign::RunningCampaign(const Scenario& scenario, const CampaignOptions& options)
    : scenario_(scenario),
      options_(options),
      lock_(make_directory(options.out)),
      identity_(identity_of(scenario, options)),
      found_(find_journal(options, identity_)) {
  if (found_) expect_throws_of(options.shard, scenario, *found_, options.out);
  stop_ = early_stop(scenario, options, found_);
  for (const int throw_index : throws_of(scenario, options.shard)) {
    ++summary_.wanted;
    if (!found_ || !has_flown(*found_, throw_index)) throws_.push_back(throw_index);
  }
}

void RunningCampaign::prepare() {
  remove_result_files(options_.out);
  write_file(options_.out / kScenarioFile, identity_.scenario);
  const fs::path path = options_.out / kJournalFile;
  if (found_) {
    journal_.emplace(path, *found_);
  } else {
    journal_.emplace(path, identity_);
  }
}

void RunningCampaign::begin() {
  begin_ = WallClock::now();
  started_ = utc_now();
}

std::optional<int> RunningCampaign::early_end() const {
  return stop_ ? stop_->end() : std::nullopt;
}

std::optional<int> RunningCampaign::next() {
  if (early_end() || next_ == throws_.size()) return std::nullopt;
  return throws_[next_++];
}

void RunningCampaign::add(const ThrowResult& result) {
  journal_->add(result);
  if (stop_) stop_->add(result);
  ++summary_.flown;
}

bool RunningCampaign::over() const { return early_end() || flown() == to_fly(); }

CampaignSummary RunningCampaign::finish() {
  journal_->sync();
  if (!over()) {
    summary_.missing = to_fly() - flown();
    return summary_;
  }
  JournalIndex index = read_journal(options_.out / kJournalFile);
  if (const std::optional<int> end = early_end()) {
    summary_.wanted = *end;
    // Throws beyond the early end may have been flown meanwhile: they do not count.
    index.throws.erase(index.throws.lower_bound(*end), index.throws.end());
  }
  write_result_files(options_.out, scenario_, index, options_.truth, summary_);
  summary_.wall_s = seconds_since(begin_);
  write_file(options_.out / kManifestFile,
             to_text(manifest_of(scenario_, options_, summary_, started_), 2) + "\n");
  return std::move(summary_);
}

}  // namespace dodgesim

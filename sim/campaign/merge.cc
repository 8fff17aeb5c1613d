#include "sim/campaign/merge.h"

#include <map>

#include "sim/base/error.h"
#include "sim/base/joined.h"
#include "sim/base/wall_clock.h"
#include "sim/campaign/campaign_directory.h"
#include "sim/campaign/campaign_files.h"
#include "sim/campaign/journal.h"
#include "sim/campaign/load_campaign.h"
#include "sim/campaign/manifest.h"
#include "sim/campaign/result_files.h"
#include "sim/files/directory.h"
#include "sim/files/output_file.h"

namespace dodgesim {

namespace {

namespace fs = std::filesystem;

// Where a throw's result is.
struct Source {
  fs::path directory;
  JournalRecord record;
};

struct Sources {
  CampaignIdentity identity;
  std::map<int, Source> throws;
  std::vector<std::string> damaged;  // directories
};

// Which of two unequal results of a throw counts; nothing if they contradict each other. One that
// was lost with its worker says nothing about the throw: time and memory depend on the machine.
const Source* better(const Source& a, const Source& b) {
  if (a.record.lost && b.record.lost) return a.record.digest < b.record.digest ? &a : &b;
  if (a.record.lost) return &b;
  return b.record.lost ? &a : nullptr;
}

void add_directory(const fs::path& directory, bool first, Sources& sources) {
  const JournalIndex index = read_journal(directory / kJournalFile);
  if (first) sources.identity = index.identity;
  const bool cut_off = index.end < fs::file_size(directory / kJournalFile);
  if (index.damaged > 0 || cut_off) sources.damaged.push_back(directory.string());
  if (index.identity != sources.identity) {
    throw ScenarioError(directory.string() + " holds results " +
                        difference(index.identity, sources.identity) +
                        "; only shards of one campaign can be merged.");
  }
  for (const auto& [number, record] : index.throws) {
    const Source found{directory, record};
    const auto [at, is_new] = sources.throws.try_emplace(number, found);
    if (is_new || at->second.record.digest == record.digest) continue;
    if (const Source* const chosen = better(at->second, found)) {
      at->second = Source(*chosen);
      continue;
    }
    throw ScenarioError("Throw " + std::to_string(number) + " went differently in " +
                        at->second.directory.string() + " and in " + directory.string() +
                        "; the same throw flies alike on machines of one kind.");
  }
}

// "3, 7 to 9, 12", the first ones if there are many
std::string ranges(const std::vector<int>& numbers) {
  constexpr int kMost = 20;
  std::string text;
  int parts = 0;
  for (std::size_t i = 0; i < numbers.size(); ++parts) {
    if (parts == kMost) return text + " and " + std::to_string(numbers.size() - i) + " more";
    std::size_t last = i;
    while (last + 1 < numbers.size() && numbers[last + 1] == numbers[last] + 1) ++last;
    text += (text.empty() ? "" : ", ") + std::to_string(numbers[i]);
    if (last > i) text += " to " + std::to_string(numbers[last]);
    i = last + 1;
  }
  return text;
}

void expect_all(const Scenario& scenario, const Sources& sources) {
  std::vector<int> missing;
  const int count = throw_count(scenario);
  for (int i = 0; i < count; ++i) {
    if (sources.throws.count(i) == 0) missing.push_back(i);
  }
  if (missing.empty()) return;
  throw MissingThrows(std::to_string(missing.size()) + " of " + std::to_string(count) +
                      " throws are missing: " + ranges(missing) +
                      (sources.damaged.empty() ? "" : "; " + damage_text(joined(sources.damaged))) +
                      ".");
}

Sources collect(const std::vector<fs::path>& directories) {
  Sources sources;
  for (const fs::path& directory : directories) {
    add_directory(directory, &directory == &directories.front(), sources);
  }
  return sources;
}

// The manifests of the parts that have one: what flew them, where and when.
Json manifests_of(const std::vector<fs::path>& directories) {
  Json manifests = Json::array();
  for (const fs::path& directory : directories) {
    if (fs::exists(directory / kManifestFile)) manifests.push_back(read_manifest(directory));
  }
  return manifests;
}

}  // namespace

int expect_complete(const std::vector<fs::path>& directories) {
  const Sources sources = collect(directories);
  const Scenario scenario = parse_scenario(sources.identity.scenario, kScenarioFile, "");
  if (scenario.stop) {
    // Its throws are as many as it took, and one directory holds all of them.
    for (const fs::path& directory : directories) {
      const LoadedCampaign campaign = load_campaign(directory);
      if (campaign.complete()) return campaign.wanted();
    }
  }
  expect_all(scenario, sources);
  return throw_count(scenario);
}

CampaignSummary merge_campaigns(const std::vector<fs::path>& directories,
                                const CampaignOptions& options) {
  const auto begin = WallClock::now();
  const std::string started = utc_now();
  const Sources sources = collect(directories);
  const Scenario scenario = parse_scenario(sources.identity.scenario, kScenarioFile, "");
  if (scenario.stop) {
    throw ScenarioError(directories.front().string() +
                        " holds a campaign with the key stop, which has no parts to be merged.");
  }
  expect_all(scenario, sources);
  Json manifests = manifests_of(directories);

  make_directory(options.out);
  for (const fs::path& directory : directories) {
    if (!fs::equivalent(directory, options.out)) continue;
    throw ScenarioError(options.out.string() +
                        " is one of the directories to be merged; choose another for the whole.");
  }
  const DirectoryLock lock(options.out);
  expect_free(options.out, options.force);
  remove_result_files(options.out);
  write_file(options.out / kScenarioFile, sources.identity.scenario);
  {
    Journal journal(options.out / kJournalFile, sources.identity);
    for (const auto& [number, source] : sources.throws) {
      journal.add(read_result(source.directory / kJournalFile, source.record));
    }
    journal.sync();
  }
  CampaignSummary summary;
  summary.wanted = throw_count(scenario);
  write_result_files(options.out, scenario, read_journal(options.out / kJournalFile),
                     sources.identity.truth, summary);
  summary.wall_s = seconds_since(begin);
  CampaignOptions flown = options;
  flown.models = sources.identity.models;
  flown.plugin = sources.identity.plugin;
  Json manifest = manifest_of(scenario, flown, summary, started);
  manifest["parts"] = std::move(manifests);
  write_file(options.out / kManifestFile, to_text(manifest, 2) + "\n");
  return summary;
}

}  // namespace dodgesim

// The files of a campaign that people and programs read, made from its journal.
#pragma once

#include <filesystem>

#include "sim/campaign/campaign.h"
#include "sim/campaign/journal.h"

namespace dodgesim {

// One of them that is there; empty if there is none.
std::filesystem::path any_result_file(const std::filesystem::path& out);
// Removes them: what an earlier run has left must not stand beside another journal.
void remove_result_files(const std::filesystem::path& out);

// Writes throws.csv, objects.csv, detections.csv, timing.csv, table.md, table.csv, report.html and,
// with `truth`, truth.csv, and fills in what the summary says about the results. The same bytes for
// the same results, but for timing.csv and report.html, which say how long it took.
void write_result_files(const std::filesystem::path& out, const Scenario& scenario,
                        const JournalIndex& index, bool truth, CampaignSummary& summary);

bool holds_campaign(const std::filesystem::path& directory);
// Of the directory that an option names, before something else is written there. Throws
// ScenarioError.
void expect_no_campaign(const std::filesystem::path& directory,
                        const std::string& option = "--out");
// Whether a file of that name belongs to a campaign in the same directory.
bool belongs_to_campaign(const std::filesystem::path& file);

// What to say of a directory without one.
inline constexpr const char* kWhatNamesACampaign =
    "a campaign is named by the directory that `dodgesim run --out DIR` wrote";

// Throws IoError if a file stands where the directory of a campaign must be.
void refuse_file(const std::filesystem::path& directory);

inline constexpr const char* kJournalFile = "results.bin";
inline constexpr const char* kScenarioFile = "scenario.resolved.yaml";
inline constexpr const char* kManifestFile = "manifest.json";
inline constexpr const char* kThrowsFile = "throws.csv";
inline constexpr const char* kObjectsFile = "objects.csv";
inline constexpr const char* kDetectionsFile = "detections.csv";
inline constexpr const char* kTruthFile = "truth.csv";
inline constexpr const char* kTimingFile = "timing.csv";
inline constexpr const char* kTableFile = "table.md";
inline constexpr const char* kTableCsvFile = "table.csv";

}  // namespace dodgesim

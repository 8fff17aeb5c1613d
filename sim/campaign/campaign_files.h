// What belongs to a campaign in its directory: the journal, and the files made from it.
#pragma once

#include <filesystem>
#include <string>

namespace dodgesim {

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

// What to say of a directory without one.
inline constexpr const char* kWhatNamesACampaign =
    "a campaign is named by the directory that `dodgesim run --out DIR` wrote";

bool holds_campaign(const std::filesystem::path& directory);
// Of the directory that an option names, before something else is written there. Throws
// ScenarioError.
void expect_no_campaign(const std::filesystem::path& directory,
                        const std::string& option = "--out");
// Whether a file of that name belongs to a campaign in the same directory.
bool belongs_to_campaign(const std::filesystem::path& file);

// A file made from a journal that is there; empty if there is none.
std::filesystem::path any_result_file(const std::filesystem::path& out);
// Removes them: what an earlier run has left must not stand beside another journal.
void remove_result_files(const std::filesystem::path& out);

// Throws IoError if a file stands where the directory of a campaign must be.
void refuse_file(const std::filesystem::path& directory);

}  // namespace dodgesim

#include "sim/campaign/campaign_files.h"

#include "sim/base/contains.h"
#include "sim/base/error.h"
#include "sim/files/directory.h"
#include "sim/files/staged_file.h"
#include "sim/tables/report.h"

namespace dodgesim {

namespace {

namespace fs = std::filesystem;

constexpr const char* kResultFiles[] = {kManifestFile,   kThrowsFile, kObjectsFile,
                                        kDetectionsFile, kTimingFile, kTableFile,
                                        kTableCsvFile,   kTruthFile,  kReportFile};

}  // namespace

fs::path any_result_file(const fs::path& out) {
  for (const char* name : kResultFiles) {
    if (fs::exists(out / name)) return out / name;
  }
  return {};
}

void remove_result_files(const fs::path& out) {
  for (const char* name : kResultFiles) remove_file(out / name);
}

bool holds_campaign(const fs::path& directory) {
  std::error_code ignored;
  return fs::exists(directory / kJournalFile, ignored);
}

void expect_no_campaign(const fs::path& directory, const std::string& option) {
  if (!holds_campaign(directory)) return;
  throw ScenarioError(option + " " + directory.string() +
                      " holds a campaign; choose another directory.");
}

void refuse_file(const fs::path& directory) {
  if (!fs::is_regular_file(directory)) return;
  throw IoError(directory.string() + " is a file; " + kWhatNamesACampaign + ".");
}

bool belongs_to_campaign(const fs::path& file) {
  const fs::path whole = StagedFile::target(file);
  if (!holds_campaign(whole.parent_path())) return false;
  const fs::path name = whole.filename();
  return name == kJournalFile || name == kScenarioFile || contains(kResultFiles, name);
}

}  // namespace dodgesim

// The directory of a campaign: who may write to it, and what is in it already.
#pragma once

#include <filesystem>
#include <optional>

#include "sim/base/descriptor.h"
#include "sim/campaign/campaign.h"
#include "sim/campaign/journal.h"

namespace dodgesim {

// One process at a time writes to a directory. The lock ends with the process, however that ends.
class DirectoryLock {
 public:
  // Throws ScenarioError if another process holds the lock, IoError.
  explicit DirectoryLock(const std::filesystem::path& out);

 private:
  Descriptor file_;
};

// Throws ScenarioError if a new campaign would overwrite one or stand beside other files, unless
// `force`; or if it would overwrite other files.
void expect_free(const std::filesystem::path& out, bool force);

// The journal to go on with; nothing for a new campaign. Throws ScenarioError if `options` do not
// say to overwrite or go on with what is there, or it is of another campaign, or if other files
// would be overwritten; IoError.
std::optional<JournalIndex> find_journal(const CampaignOptions& options,
                                         const CampaignIdentity& identity);

}  // namespace dodgesim

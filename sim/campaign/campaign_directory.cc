#include "sim/campaign/campaign_directory.h"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>

#include "sim/base/error.h"
#include "sim/campaign/campaign_files.h"
#include "sim/files/staged_file.h"
#include "sim/files/text_table.h"

namespace dodgesim {

namespace {

namespace fs = std::filesystem;

constexpr const char* kLockFile = ".lock";

// Other than what a campaign leaves that was killed before it began.
bool holds_anything(const fs::path& out) {
  for (const auto& entry : fs::directory_iterator(out)) {
    const fs::path name = entry.path().filename();
    if (name != kLockFile && name != StagedFile::partial_name(kScenarioFile) &&
        name != StagedFile::partial_name(kJournalFile)) {
      return true;
    }
  }
  return false;
}

// A directory with other files may take a campaign beside them (--force), but in place of none.
void refuse_foreign(const fs::path& out, bool force) {
  if (fs::exists(out / kJournalFile) || fs::exists(out / kScenarioFile)) return;
  if (!force) {
    throw ScenarioError(
        out.string() +
        " is neither empty nor a campaign; choose another directory or add --force.");
  }
  const fs::path file = any_result_file(out);
  if (file.empty()) return;
  throw ScenarioError(file.string() +
                      " is of no campaign that is there; choose another directory.");
}

[[noreturn]] void refuse_finished(const fs::path& out, const JournalIndex& index) {
  const auto n = static_cast<std::int64_t>(index.throws.size());
  throw ScenarioError(out.string() + " holds results of " + count_text(n, "throw") +
                      "; run it with --resume to fly what is missing, or add --force to start "
                      "anew.");
}

}  // namespace

DirectoryLock::DirectoryLock(const fs::path& out) {
  const fs::path path = out / kLockFile;
  file_ = Descriptor(::open(path.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0644));
  if (!file_) {
    throw IoError(path.string() + " could not be written: " + std::strerror(errno) + ".");
  }
  // Workers must not inherit the lock, as they do that of flock().
  struct flock whole {};
  whole.l_type = F_WRLCK;
  whole.l_whence = SEEK_SET;
  if (::fcntl(file_.get(), F_SETLK, &whole) == 0) return;
  const int error = errno;
  if (error == ENOLCK || error == ENOSYS || error == EOPNOTSUPP || error == EINVAL) {
    return;  // a disk without locks, as clusters have: nothing keeps others away there
  }
  if (error != EACCES && error != EAGAIN) {
    throw IoError(path.string() + " could not be locked: " + std::strerror(error) + ".");
  }
  throw ScenarioError(out.string() + " is being written to by another dodgesim.");
}

void expect_free(const fs::path& out, bool force) {
  if (!holds_anything(out)) return;
  refuse_foreign(out, force);
  if (force) return;
  throw ScenarioError(out.string() +
                      " holds a campaign already; choose another directory, or add --force to "
                      "overwrite it.");
}

std::optional<JournalIndex> find_journal(const CampaignOptions& options,
                                         const CampaignIdentity& identity) {
  const fs::path& out = options.out;
  const fs::path journal = out / kJournalFile;
  if (!holds_anything(out)) return std::nullopt;
  refuse_foreign(out, options.force);
  if (options.force) return std::nullopt;
  if (!fs::exists(journal)) {
    // Stopped before the first result, unless there are tables of results.
    if (options.resume && any_result_file(out).empty()) return std::nullopt;
    throw ScenarioError(out.string() + " holds a campaign without " + kJournalFile +
                        "; choose another directory, or add --force to start anew.");
  }
  JournalIndex index = read_journal(journal);
  if (!options.resume) refuse_finished(out, index);
  if (index.identity != identity) {
    throw ScenarioError(out.string() + " holds results " + difference(index.identity, identity) +
                        "; choose another directory, or add --force to start anew.");
  }
  return index;
}

}  // namespace dodgesim

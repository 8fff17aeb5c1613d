// The results of a campaign as they come: one file that only grows, and what survives a kill, a
// crash or a full disk.
//
// It begins with what the campaign is (identity.h); then comes a record for each throw: size,
// checksum and bytes of its result (wire.h). add() hands it to the system, so that it survives the
// process; once a second it waits for the disk. Reading takes every record whose checksum is right;
// one that was damaged or cut off, as by a kill, is left out, and its throw can be flown again.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <map>
#include <string>

#include "sim/base/descriptor.h"
#include "sim/base/wall_clock.h"
#include "sim/campaign/identity.h"
#include "sim/outcome/result.h"

namespace dodgesim {

// No throw has results of more bytes; a larger number is damage.
inline constexpr std::uint32_t kLargestRecord = 1u << 30;

// Where a throw's record lies.
struct JournalRecord {
  std::uint64_t offset = 0;  // of its bytes
  std::uint32_t size = 0;
  std::uint64_t digest = 0;  // of the result, without the time that it took
  bool lost = false;         // the throw was not flown to its end: its worker was stopped or died
};

// What a journal holds.
struct JournalIndex {
  CampaignIdentity identity;
  std::map<int, JournalRecord> throws;  // by number
  int damaged = 0;                      // records that were left out, see damage_text()
  std::uint64_t end = 0;                // of the last intact record
};

// Throws IoError if the file cannot be read or is no journal.
JournalIndex read_journal(const std::filesystem::path& path);

// What to do about directories whose journals have damaged records.
std::string damage_text(const std::string& directories);

// The result of one record. Throws IoError if the file has changed since.
ThrowResult read_result(const std::filesystem::path& path, const JournalRecord& record);

// Calls `take` for every throw in order. Throws IoError.
void for_each_result(const std::filesystem::path& path, const JournalIndex& index,
                     const std::function<void(ThrowResult)>& take);

class Journal {
 public:
  // Begins a journal, in place of whatever is there; or goes on with one after its last intact
  // record. Throws IoError.
  Journal(const std::filesystem::path& path, const CampaignIdentity& identity);
  Journal(const std::filesystem::path& path, const JournalIndex& index);

  // Throws IoError; the result is in the file then as a whole, not at all or, where the file cannot
  // be cut, damaged. That somebody else has written to the file is an error, too: locks do not hold
  // between hosts on every shared disk.
  void add(const ThrowResult& result);
  void sync();  // returns when all is on the disk; throws IoError

 private:
  void open(int flags);
  void append(const std::string& bytes);
  void expect_only_writer() const;
  [[noreturn]] void fail(const std::string& what, int error) const;

  std::filesystem::path path_;
  Descriptor file_;
  std::uint64_t end_ = 0;
  WallClock::time_point synced_;
};

// Of the result without the time that it took: equal for equal flights.
std::uint64_t result_digest(const ThrowResult& result);

}  // namespace dodgesim

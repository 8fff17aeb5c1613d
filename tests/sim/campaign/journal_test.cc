#include "sim/campaign/journal.h"

#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/stat.h>

#include <csignal>

#include "sim/base/error.h"
#include "sim/base/input_file.h"
#include "sim/base/random.h"
#include "sim/files/csv.h"
#include "tests/complaint.h"
#include "tests/sim/campaign/campaign_fixture.h"

namespace dodgesim {
namespace {

namespace fs = std::filesystem;

class JournalTest : public CampaignTest {
 protected:
  // Of throws 0 to 9.
  void write_ten() {
    Journal journal(path_, identity_);
    for (int i = 0; i < 10; ++i) {
      journal.add(fly(i));
      ends_.push_back(fs::file_size(path_));
    }
  }
  std::string bytes() const { return read_file(path_); }
  void put(const std::string& bytes) const { testing::put(path_, bytes); }

  fs::path path_ = root_ / "results.bin";
  CampaignIdentity identity_ = {"seed: 1\n", "0.1.0 abc", "12ab", "34cd", false};
  std::vector<std::uintmax_t> ends_;  // of the records
};

TEST_F(JournalTest, ResultsAreReadAsTheyWereWritten) {
  write_ten();
  const JournalIndex index = read_journal(path_);
  EXPECT_EQ(index.identity, identity_);
  EXPECT_EQ(index.damaged, 0);
  ASSERT_EQ(index.throws.size(), 10u);
  int next = 0;
  for_each_result(path_, index, [&](const ThrowResult& result) {
    EXPECT_EQ(csv_row(result), csv_row(fly(next)));
    EXPECT_EQ(result.detection_rows.size(), static_cast<std::size_t>(next));
    ++next;
  });
  EXPECT_EQ(next, 10);
}

TEST_F(JournalTest, WhereThereIsNoneTheReaderLearnsWhatACampaignIs) {
  try {
    read_journal(path_);
    FAIL();
  } catch (const IoError& error) {
    EXPECT_EQ(std::string(error.what()),
              path_.string() + " could not be opened: No such file or directory; a campaign is " +
                  "named by the directory that `dodgesim run --out DIR` wrote.");
  }
}

TEST_F(JournalTest, CutOffAnywhereItKeepsEveryWholeRecord) {
  write_ten();
  const std::string whole = bytes();
  for (std::size_t size = 0; size < whole.size(); size += 13) {
    put(whole.substr(0, size));
    std::size_t records = 0;
    while (records < ends_.size() && ends_[records] <= size) ++records;
    try {
      const JournalIndex index = read_journal(path_);
      ASSERT_EQ(index.throws.size(), records) << size;
      Journal journal(path_, index);
      journal.add(fly(11));
      const JournalIndex then = read_journal(path_);
      ASSERT_EQ(then.throws.size(), records + 1) << size;
      ASSERT_EQ(then.throws.count(11), 1u);
    } catch (const IoError&) {
      ASSERT_EQ(records, 0u) << size;  // not even its beginning is there
    }
  }
}

TEST_F(JournalTest, AFlippedBitNeverPassesForAResult) {
  write_ten();
  const std::string whole = bytes();
  std::vector<std::uint64_t> digests;
  for (const auto& [number, record] : read_journal(path_).throws) digests.push_back(record.digest);
  RandomStream random(1, 0, "bits");
  for (int trial = 0; trial < 300; ++trial) {
    std::string broken = whole;
    const auto at = static_cast<std::size_t>(random.uniform(0, static_cast<double>(whole.size())));
    broken[at] = static_cast<char>(broken[at] ^ (1 << static_cast<int>(random.uniform(0, 8))));
    put(broken);
    try {
      const JournalIndex index = read_journal(path_);
      EXPECT_LT(index.throws.size(), 10u) << at;
      for (const auto& [number, record] : index.throws) {
        EXPECT_EQ(record.digest, digests[static_cast<std::size_t>(number)]);
      }
    } catch (const IoError&) {
      EXPECT_LT(at, ends_.front());  // its beginning
    }
  }
}

TEST_F(JournalTest, OneDamagedRecordCostsNoOther) {
  write_ten();
  std::string broken = bytes();
  broken[static_cast<std::size_t>(ends_[3] + 40)] ^= 1;
  put(broken);
  const JournalIndex index = read_journal(path_);
  EXPECT_EQ(index.damaged, 1);
  EXPECT_EQ(index.throws.size(), 9u);
  EXPECT_EQ(index.throws.count(4), 0u);
}

TEST_F(JournalTest, ADamagedHeaderCostsNoOther) {
  write_ten();
  const std::string whole = bytes();
  for (std::size_t at = 0; at < 16; ++at) {
    std::string broken = whole;
    broken[static_cast<std::size_t>(ends_[3]) + at] ^= 4;
    put(broken);
    const JournalIndex index = read_journal(path_);
    EXPECT_EQ(index.damaged, 1) << at;
    EXPECT_EQ(index.throws.size(), 9u) << at;
    EXPECT_EQ(index.throws.count(4), 0u) << at;
    EXPECT_EQ(index.end, ends_.back()) << at;
  }
}

TEST_F(JournalTest, TheTimeThatAThrowTookIsNoDifference) {
  ThrowResult a = fly(3), b = a;
  b.wall_s = a.wall_s + 1;
  EXPECT_EQ(result_digest(a), result_digest(b));
  b.events_hash ^= 1;
  EXPECT_NE(result_digest(a), result_digest(b));
}

TEST_F(JournalTest, OfTwoWritersThatNoLockKeepsApartOneIsStopped) {
  write_ten();
  const JournalIndex before = read_journal(path_);
  Journal here(path_, before), there(path_, before);
  here.add(fly(10));
  EXPECT_THROW(there.add(fly(11)), IoError);
  here.add(fly(11));
  const JournalIndex after = read_journal(path_);
  EXPECT_EQ(after.damaged, 0);
  EXPECT_EQ(after.throws.size(), 12u);
}

TEST_F(JournalTest, AFullDiskLeavesNoPartOfAResult) {
  write_ten();
  const JournalIndex before = read_journal(path_);
  {
    // As if the disk had room for half of the next record.
    Journal journal(path_, before);
    rlimit unlimited{};
    ::getrlimit(RLIMIT_FSIZE, &unlimited);
    const rlimit full = {fs::file_size(path_) + 20, unlimited.rlim_max};
    ::signal(SIGXFSZ, SIG_IGN);
    ::setrlimit(RLIMIT_FSIZE, &full);
    EXPECT_THROW(journal.add(fly(10)), IoError);
    ::setrlimit(RLIMIT_FSIZE, &unlimited);
    ::signal(SIGXFSZ, SIG_DFL);
    EXPECT_EQ(fs::file_size(path_), before.end);
    journal.add(fly(10));  // there is space again
  }
  EXPECT_EQ(read_journal(path_).throws.size(), 11u);
}

TEST_F(JournalTest, WhatCannotBeReadOrMadeIsAnError) {
  EXPECT_THROW(Journal(root_ / "no" / "such", identity_), IoError);
  EXPECT_THROW(read_journal(root_ / "none"), IoError);
  put("something else");
  EXPECT_THROW(read_journal(path_), IoError);
}

TEST_F(JournalTest, APipeIsNotWaitedFor) {
  ASSERT_EQ(::mkfifo(path_.c_str(), 0600), 0);
  EXPECT_EQ(testing::complaint<IoError>([&] { read_journal(path_); }),
            path_.string() + " is not a regular file.");
}

}  // namespace
}  // namespace dodgesim

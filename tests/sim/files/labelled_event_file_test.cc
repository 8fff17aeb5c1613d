#include "sim/files/labelled_event_file.h"

#include <gtest/gtest.h>

#include <cstring>

#include "sim/base/error.h"
#include "sim/files/npy_reader.h"
#include "tests/sim/files/temporary_directory.h"

namespace dodgesim {
namespace {

using testing::contents;
using testing::TemporaryDirectory;

const std::vector<Event> kEvents = {{5, 300, 2, 1}, {1LL << 40, 4, 239, -1}};
const std::vector<Cause> kCauses = {kCauseFirstObject, kCauseHotPixel};

TEST(LabelledEventFile, WritesTextWithTheCauseLast) {
  const TemporaryDirectory directory;
  LabelledEventFile file(directory / "e.txt");
  file.add(kEvents, kCauses);
  file.finish();
  EXPECT_EQ(contents(directory / "e.txt"), "5 300 2 1 1\n1099511627776 4 239 0 255\n");
}

TEST(LabelledEventFile, WritesRecordsThatNumPyReads) {
  const TemporaryDirectory directory;
  LabelledEventFile file(directory / "e.npy");
  file.add({kEvents.data(), 1}, {kCauses.data(), 1});
  file.add({kEvents.data() + 1, 1}, {kCauses.data() + 1, 1});
  file.finish();
  EXPECT_EQ(file.count(), 2u);
  NpyReader reader((directory / "e.npy").string());
  EXPECT_EQ(reader.header().shape, std::vector<std::uint64_t>{2});
  EXPECT_NE(contents(directory / "e.npy").find("('cause', '|u1')"), std::string::npos);
  constexpr std::size_t kBytes = 8 + 2 + 2 + 1 + 1;
  reader.require_size(kBytes);
  unsigned char records[2 * kBytes];
  reader.read(records, sizeof records);
  for (std::size_t i = 0; i < 2; ++i) {
    const unsigned char* record = records + i * kBytes;
    std::int64_t t_us = 0;
    std::uint16_t x = 0, y = 0;
    std::memcpy(&t_us, record, 8);
    std::memcpy(&x, record + 8, 2);
    std::memcpy(&y, record + 10, 2);
    EXPECT_EQ(t_us, kEvents[i].t_us);
    EXPECT_EQ(x, kEvents[i].x);
    EXPECT_EQ(y, kEvents[i].y);
    EXPECT_EQ(static_cast<std::int8_t>(record[12]), kEvents[i].polarity);
    EXPECT_EQ(record[13], kCauses[i]);
  }
}

TEST(LabelledEventFile, LeavesNothingBehindUnlessFinished) {
  const TemporaryDirectory directory;
  { LabelledEventFile(directory / "e.npy").add(kEvents, kCauses); }
  EXPECT_TRUE(std::filesystem::is_empty(directory.path()));
  EXPECT_THROW(LabelledEventFile(directory / "e.h5"), ScenarioError);
}

}  // namespace
}  // namespace dodgesim

#include "sim/files/mcap_writer.h"

#include "sim/base/error.h"
#include "sim/base/random.h"
#include "tests/complaint.h"
#include "tests/sim/files/mcap_reader.h"
#include "tests/sim/files/temporary_directory.h"

namespace dodgesim {
namespace {

using testing::complaint;
using testing::contents;
using testing::McapReader;
using testing::TemporaryDirectory;

// Several chunks, out of order in time, topics that begin late and one that stays empty.
void write(const std::filesystem::path& path, int messages) {
  RandomStream random(1, 0, "messages");
  McapWriter writer(path);
  const auto a = writer.add_topic("/a", "A", R"({"type":"object","title":"A"})");
  writer.add_topic("/empty", "Empty", "{}");
  std::uint16_t late = 0;
  for (int i = 0; i < messages; ++i) {
    if (i == messages / 2)
      late = writer.add_topic("/late", "A", R"({"type":"object","title":"A"})");
    const auto size = static_cast<std::size_t>(random.uniform(0, 3000));
    const auto jitter_us = static_cast<TimeUs>(random.uniform(0, 5000));
    writer.write(late != 0 && i % 3 == 0 ? late : a, 1000 * i + jitter_us,
                 "{\"i\":" + std::to_string(i) + ",\"text\":\"" + std::string(size, 'x') + "\"}");
  }
  writer.finish();
}

class Mcap : public ::testing::TestWithParam<int> {};
INSTANTIATE_TEST_SUITE_P(Messages, Mcap, ::testing::Values(0, 1, 2, 50, 3000));

TEST_P(Mcap, IsWhatTheSpecificationSays) {
  const TemporaryDirectory directory;
  write(directory / "a.mcap", GetParam());
  const McapReader reader(contents(directory / "a.mcap"));
  ASSERT_EQ(reader.messages().size(), static_cast<std::size_t>(GetParam()));
  EXPECT_GE(reader.chunks(), GetParam() / 750);
  for (int i = 0; i < GetParam(); ++i) {
    const auto& message = reader.messages()[static_cast<std::size_t>(i)];
    EXPECT_EQ(message.json.rfind("{\"i\":" + std::to_string(i) + ",", 0), 0u);
    EXPECT_EQ(message.schema, "A");
    EXPECT_EQ(message.time_ns % 1000, 0u);
    EXPECT_LT(message.time_ns - 1000000u * static_cast<unsigned>(i), 5000000u);
  }
}

TEST(McapWriter, MakesTheSameBytesOfTheSameMessages) {
  const TemporaryDirectory directory;
  write(directory / "a.mcap", 100);
  write(directory / "b.mcap", 100);
  EXPECT_TRUE(contents(directory / "a.mcap") == contents(directory / "b.mcap"));
}

TEST(McapWriter, LeavesNothingBehindUnlessFinished) {
  const TemporaryDirectory directory;
  { McapWriter(directory / "a.mcap").add_topic("/a", "A", "{}"); }
  EXPECT_TRUE(std::filesystem::is_empty(directory.path()));
}

TEST(McapWriter, ReportsAFullDisk) {
  const TemporaryDirectory directory;
  const std::string path = directory / "a.mcap";
  for (const int messages : {0, 3000}) {
    std::filesystem::create_symlink("/dev/full", path + ".partial");
    EXPECT_EQ(complaint<IoError>([&] { write(path, messages); }),
              path + " could not be written: No space left on device.");
    EXPECT_TRUE(std::filesystem::is_empty(directory.path()));
  }
  EXPECT_THROW(McapWriter(directory / "no/such/a.mcap"), IoError);
}

}  // namespace
}  // namespace dodgesim

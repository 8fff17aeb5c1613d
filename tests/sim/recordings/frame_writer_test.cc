#include "sim/recordings/frame_writer.h"

#include <gtest/gtest.h>

#include "sim/recordings/frame_reader.h"
#include "tests/sim/files/temporary_directory.h"

namespace dodgesim {
namespace {

using testing::TemporaryDirectory;

class FrameWriterTest : public ::testing::Test {
 protected:
  std::string path(const char* name) const { return (root_ / name).string(); }

  const TemporaryDirectory directory_;
  const std::filesystem::path root_ = directory_.path();
};

TEST_F(FrameWriterTest, WritesWhatTheReaderReads) {
  FrameWriter writer(path("f.npy"), path("t.npy"), 3, 2);
  const std::vector<float> first = {0, 1, 2, 3, 4, 5}, second = {5, 4, 3, 2, 1, 0.25F};
  writer.add(1000, first);
  writer.add(2250, second);
  EXPECT_EQ(writer.count(), 2);
  writer.commit();

  FrameReader reader(path("f.npy"), path("t.npy"));
  EXPECT_EQ(reader.width(), 3);
  EXPECT_EQ(reader.height(), 2);
  EXPECT_EQ(reader.frame_count(), 2);
  EXPECT_EQ(reader.first_us(), 1000);
  TimeUs t_us = -1;
  std::vector<float> luminance;
  ASSERT_TRUE(reader.next(t_us, luminance));
  EXPECT_EQ(t_us, 0);
  EXPECT_EQ(luminance, first);
  ASSERT_TRUE(reader.next(t_us, luminance));
  EXPECT_EQ(t_us, 1250);
  EXPECT_EQ(luminance, second);
  EXPECT_FALSE(reader.next(t_us, luminance));
}

TEST_F(FrameWriterTest, LeavesNothingBehindWithoutCommit) {
  { FrameWriter(path("f.npy"), path("t.npy"), 1, 1).add(0, {1}); }
  EXPECT_TRUE(std::filesystem::is_empty(root_));
}

}  // namespace
}  // namespace dodgesim

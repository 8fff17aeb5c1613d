#include "sim/files/staged_file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <fstream>

#include "sim/base/error.h"
#include "sim/files/output_file.h"
#include "tests/complaint.h"
#include "tests/sim/files/temporary_directory.h"

namespace dodgesim {
namespace {

namespace fs = std::filesystem;

using testing::contents;

std::string complaint_about(const fs::path& path) {
  return testing::complaint<IoError>([&] { StagedFile file(path); });
}

TEST(StagedFile, AppearsWholeOrNotAtAll) {
  const testing::TemporaryDirectory directory;
  const fs::path path = directory.path() / "file";
  write_file(path, "old");
  {
    OutputFile unfinished(path);
    unfinished.write("new");
  }
  EXPECT_EQ(contents(path), "old");
  EXPECT_FALSE(fs::exists(StagedFile::partial_name(path)));
  write_file(path, "new");
  EXPECT_EQ(contents(path), "new");
}

TEST(StagedFile, BelongsToOneProgramAtATime) {
  const testing::TemporaryDirectory directory;
  const fs::path path = directory.path() / "file";
  StagedFile first(path);
  const pid_t child = ::fork();
  if (child == 0) {
    ::_exit(complaint_about(path) == path.string() + " is being written by another program." ? 0
                                                                                             : 1);
  }
  int status = -1;
  ASSERT_EQ(::waitpid(child, &status, 0), child);
  EXPECT_EQ(status, 0);
  EXPECT_TRUE(fs::exists(StagedFile::partial_name(path)));
  first.commit();
  EXPECT_TRUE(fs::exists(path));
  StagedFile second(path);
}

// As HDF5 does.
TEST(StagedFile, StaysItsProgramsWhenItIsOpenedAndClosedOnceMore) {
  const testing::TemporaryDirectory directory;
  const fs::path path = directory.path() / "file";
  const StagedFile first(path);
  { const std::ifstream again(first.partial()); }
  EXPECT_EQ(complaint_about(path), path.string() + " is being written by another program.");
}

TEST(StagedFile, LeavesDevicesPipesAndDirectoriesAsTheyAre) {
  const testing::TemporaryDirectory directory;
  const fs::path pipe = directory.path() / "pipe";
  ASSERT_EQ(::mkfifo(pipe.c_str(), 0600), 0);
  EXPECT_EQ(complaint_about(pipe), pipe.string() + " is not a regular file.");
  EXPECT_TRUE(fs::is_fifo(pipe));
  EXPECT_EQ(complaint_about("/dev/null"), "/dev/null is not a regular file.");
  EXPECT_TRUE(fs::is_character_file("/dev/null"));
  EXPECT_THAT(complaint_about(directory.path()), ::testing::HasSubstr("Is a directory"));
}

TEST(StagedFile, WritesToWhatALinkNames) {
  const testing::TemporaryDirectory directory;
  const fs::path target = directory.path() / "target", link = directory.path() / "link";
  write_file(target, "old");
  fs::create_symlink("target", link);
  write_file(link, "new");
  EXPECT_TRUE(fs::is_symlink(link));
  EXPECT_EQ(contents(target), "new");
}

TEST(StagedFile, MakesWhatALinkNamesButRefusesACircle) {
  const testing::TemporaryDirectory directory;
  const fs::path nowhere = directory.path() / "nowhere", link = directory.path() / "link";
  fs::create_symlink("nowhere", link);
  write_file(link, "new");
  EXPECT_TRUE(fs::is_symlink(link));
  EXPECT_EQ(contents(nowhere), "new");
  const fs::path lost = directory.path() / "lost", circle = directory.path() / "circle";
  fs::create_symlink("no/such/folder", lost);
  EXPECT_THAT(complaint_about(lost), ::testing::HasSubstr("could not be created: No such file"));
  EXPECT_TRUE(fs::is_symlink(lost));
  fs::create_symlink("circle", circle);
  EXPECT_THAT(complaint_about(circle), ::testing::HasSubstr("Too many levels of symbolic links."));
  EXPECT_TRUE(fs::is_symlink(circle));
  const fs::path long_name = directory.path() / std::string(300, 'a');
  EXPECT_THAT(complaint_about(long_name), ::testing::HasSubstr("File name too long."));
}

}  // namespace
}  // namespace dodgesim

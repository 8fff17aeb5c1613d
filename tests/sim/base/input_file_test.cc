#include "sim/base/input_file.h"

#include <gtest/gtest.h>
#include <sys/stat.h>

#include "sim/base/error.h"
#include "tests/complaint.h"
#include "tests/sim/files/temporary_directory.h"

namespace dodgesim {
namespace {

using testing::complaint;
using testing::put;
using testing::TemporaryDirectory;

TEST(InputFile, IsReadWhole) {
  const TemporaryDirectory directory;
  const std::string bytes("a\0\r\n\xff", 5);
  EXPECT_EQ(read_file(put(directory / "a", bytes)), bytes);
  EXPECT_EQ(read_file(put(directory / "empty", "")), "");
}

TEST(InputFile, IsAFile) {
  const TemporaryDirectory directory;
  const auto complaint_about = [](const std::filesystem::path& path) {
    return complaint<IoError>([&] { read_file(path); });
  };
  const std::filesystem::path pipe = directory / "pipe", none = directory / "none";
  ASSERT_EQ(::mkfifo(pipe.c_str(), 0600), 0);
  EXPECT_EQ(complaint_about(pipe), pipe.string() + " is not a regular file.");
  EXPECT_EQ(complaint_about(directory.path()),
            directory.path().string() + " is not a regular file.");
  EXPECT_EQ(complaint_about(none), none.string() + " is missing.");
}

TEST(InputFile, ThatCannotBeReadIsNamedWithTheReason) {
  EXPECT_EQ(complaint<IoError>([] { read_file("/proc/self/mem"); }),
            "/proc/self/mem could not be read: Input/output error.");
}

}  // namespace
}  // namespace dodgesim

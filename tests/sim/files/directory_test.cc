#include "sim/files/directory.h"

#include <gtest/gtest.h>

#include "sim/base/error.h"
#include "tests/sim/files/temporary_directory.h"

namespace dodgesim {
namespace {

namespace fs = std::filesystem;

TEST(NewDirectory, RemovesWhatItMadeIfNothingWasPutThere) {
  const testing::TemporaryDirectory root;
  for (const char* name : {"a/b/c", "a/b/c/"}) {
    {
      const NewDirectory directory(root / name);
      EXPECT_TRUE(fs::is_directory(root / name));
    }
    EXPECT_FALSE(fs::exists(root / "a"));
  }
  {
    const NewDirectory directory(root / "a/b/c");
    testing::put(root / "a/b/file", "text");
  }
  EXPECT_TRUE(fs::exists(root / "a/b/file"));
  EXPECT_FALSE(fs::exists(root / "a/b/c"));
  { const NewDirectory there(root / "a/b"); }
  { const NewDirectory there(root.path()); }
  EXPECT_TRUE(fs::exists(root / "a/b"));
  EXPECT_THROW(NewDirectory(root / "a/b/file"), IoError);
  EXPECT_TRUE(fs::exists(root / "a/b/file"));
}

}  // namespace
}  // namespace dodgesim

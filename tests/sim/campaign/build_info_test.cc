#include "sim/campaign/build_info.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdlib>

#include "tests/sim/files/temporary_directory.h"

namespace dodgesim {
namespace {

using ::testing::HasSubstr;

// A work tree with one source of everything that is built.
class CommitTest : public ::testing::Test {
 protected:
  CommitTest() {
    for (const char* folder : {"dodge", "sim", "tools", "results"}) {
      std::filesystem::create_directories(root_ / folder);
      testing::put(root_ / folder / "a.cc", "int a;\n");
    }
    testing::put(root_ / "CMakeLists.txt", "");
    git("init -q");
    git("add .");
    git("-c user.name=a -c user.email=a@b commit -q -m a");
  }

  void git(const std::string& arguments) const {
    run("git -C " + root_.string() + " " + arguments);
  }

  // What the build is told of the tree.
  std::string header() const {
    const std::string out = (parent_ / "commit.h").string();
    run("cmake -DSOURCE_DIR=" + root_.string() + " -DOUTPUT=" + out +
        " -P " DODGESIM_SOURCE_DIR "/sim/campaign/commit.cmake");
    return testing::contents(out);
  }

  const testing::TemporaryDirectory parent_;
  const std::filesystem::path root_ = parent_ / "tree";

 private:
  static void run(const std::string& command) { EXPECT_EQ(std::system(command.c_str()), 0); }
};

TEST_F(CommitTest, AnySourceThatIsNotOfTheCommitModifiesIt) {
  EXPECT_THAT(header(), HasSubstr("DODGESIM_MODIFIED false"));
  testing::put(root_ / "results/new.md", "");
  EXPECT_THAT(header(), HasSubstr("DODGESIM_MODIFIED false")) << "it is not built";
  for (const std::string folder : {"dodge", "sim", "tools"}) {
    const std::filesystem::path source = root_ / folder / "new.cc";
    testing::put(source, "int b;\n");
    const std::string before = header();
    EXPECT_THAT(before, HasSubstr("DODGESIM_MODIFIED true")) << folder;
    testing::put(source, "int c;\n");
    EXPECT_NE(header(), before) << folder;
    std::filesystem::remove(source);
  }
  EXPECT_THAT(header(), HasSubstr("DODGESIM_MODIFIED false"));
}

}  // namespace
}  // namespace dodgesim

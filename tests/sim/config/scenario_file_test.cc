// Files that no scenario can be read from, and names that none can have.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include "sim/base/error.h"
#include "sim/config/scenario.h"
#include "tests/complaint.h"

namespace dodgesim {
namespace {

using ::testing::HasSubstr;

// The name that a scenario has without one, that of its file, is one of its texts, too.
TEST(ScenarioFile, AFileMustHaveANameThatACampaignCanHave) {
  const auto error_of_file = [](const std::string& file) {
    return testing::complaint<ScenarioError>([&] { parse_scenario("seed: 1\n", file, ""); });
  };
  EXPECT_EQ(error_of_file("b\xc3\xa4"
                          "d.yaml"),
            "");
  EXPECT_THAT(error_of_file("a\nb.yaml"),
              HasSubstr("The file's name, for want of the key name, has a line break"));
  EXPECT_THAT(error_of_file("a\xff.yaml"), HasSubstr("name, is not UTF-8 text."));
}

// yaml-cpp takes the rest of the file for the value.
TEST(ScenarioFile, AQuoteThatDoesNotEndIsRefused) {
  for (const std::string quote : {"\"", "'"}) {
    for (const std::string end : {"\n", "\r\n", "\n\n", ""}) {
      const std::string yaml = "seed: 4\ndescription: " + quote + "what it is for\nthrow: {}" + end;
      EXPECT_THROW(parse_scenario(yaml, "test.yaml", ""), ScenarioError) << yaml;
    }
  }
  const std::string whole = "description: \"it's\"\nname: 'a \"b\"'\n";
  EXPECT_EQ(parse_scenario(whole, "test.yaml", "").description, "it's");
}

TEST(ScenarioFile, AMissingFileAndWhatIsNoFileAreRefused) {
  EXPECT_THROW(load_scenario("/no/such/file.yaml", ""), ScenarioError);
  EXPECT_THROW(load_scenario("/", ""), ScenarioError);
  EXPECT_THROW(load_scenario("/dev/zero", ""), ScenarioError);
  const std::string pipe = ::testing::TempDir() + "dodgesim_pipe_" + std::to_string(::getpid());
  ASSERT_EQ(::mkfifo(pipe.c_str(), 0600), 0);
  EXPECT_THROW(load_scenario(pipe, ""), ScenarioError);
  ::unlink(pipe.c_str());
}

TEST(ScenarioFile, AFileThatCannotBeReachedIsNotSaidToBeMissing) {
  const std::string loop = ::testing::TempDir() + "dodgesim_loop_" + std::to_string(::getpid());
  ASSERT_EQ(::symlink(loop.c_str(), loop.c_str()), 0);
  try {
    load_scenario(loop, "");
    FAIL();
  } catch (const IoError& error) {
    EXPECT_EQ(error.what(), loop + " could not be read: Too many levels of symbolic links.");
  }
  ::unlink(loop.c_str());
}

}  // namespace
}  // namespace dodgesim

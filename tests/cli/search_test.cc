// tools/search with few throws: that it flies every value and reads what `dodgesim compare` says.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <regex>
#include <string>

#include "tests/cli/command_test.h"

namespace {

using dodgesim::testing::dodgesim;
using dodgesim::testing::Outcome;
using dodgesim::testing::shell;
using ::testing::ContainsRegex;
using ::testing::HasSubstr;

class SearchTest : public dodgesim::testing::CommandTest {
 protected:
  SearchTest() : CommandTest("search") {}
  static Outcome search(const std::string& arguments) {
    const std::string program = std::string(DODGESIM_BINARY_DIR) + "/dodgesim";
    return shell("DODGESIM=" + program + " " + DODGESIM_SOURCE_DIR + "/tools/search " + arguments);
  }
};

TEST_F(SearchTest, PrintsWhatCompareSaysOfEachValue) {
  const Outcome outcome = search("oracle " + path("out") + " --throws 1 -j 1 --set after_s=0.2");
  EXPECT_EQ(outcome.exit_code, 0) << outcome.output;
  const std::string key = "`dodger.velocity_limit.max_speed_mps` \\| ";
  EXPECT_THAT(outcome.output, ContainsRegex(key + "5 \\| [0-9]+ / 6 \\| \\| \\| present \\|"));

  const std::regex row(key + "3 \\| (\\d+) / (\\d+) \\| (\\d+) / (\\d+) \\| ([0-9.]+) \\|");
  std::smatch found;
  ASSERT_TRUE(std::regex_search(outcome.output, found, row)) << outcome.output;
  const std::string flights = path("out/oracle/");
  const std::string said =
      dodgesim("compare " + flights + "present " + flights + "max_speed_mps_3").output;
  EXPECT_THAT(said, HasSubstr("/max_speed_mps_3: " + found.str(1) + " of " + found.str(2)));
  EXPECT_THAT(said, HasSubstr(found.str(3) + " lost, " + found.str(4) + " gained"));
  EXPECT_THAT(said, HasSubstr("p = " + found.str(5) + ","));
}

// Stopped by the option before it flies; the first thing that it looks at are its present values.
TEST_F(SearchTest, StartsFromTheValuesOfTheProgram) {
  for (const char* what : {"falanga2020", "falanga2020_mono", "oracle", "dodgesim", "dodgesim_slow",
                           "dodgesim_thin"}) {
    const Outcome outcome = search(std::string(what) + " " + path("out") + " --no-such-option");
    EXPECT_EQ(outcome.exit_code, 1) << what;
    EXPECT_THAT(outcome.output, HasSubstr("--no-such-option"));
    EXPECT_THAT(outcome.output, ::testing::Not(HasSubstr("present values"))) << what;
  }
}

TEST_F(SearchTest, SaysWhatItCanLookFor) {
  const Outcome outcome = search("nothing " + path("out"));
  EXPECT_EQ(outcome.exit_code, 2);
  EXPECT_THAT(outcome.output,
              HasSubstr("falanga2020, falanga2020_mono, oracle, dodgesim, dodgesim_slow"));
}

}  // namespace

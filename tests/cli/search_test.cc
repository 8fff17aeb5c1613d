// tools/search with few throws: that it flies every value and reads what `dodgesim compare` says.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

#include "tests/cli/command_test.h"

namespace {

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

TEST_F(SearchTest, ComparesEachValueWithThePresentOneOnTheSameThrows) {
  const Outcome outcome = search("oracle " + path("out") + " --throws 12");
  EXPECT_EQ(outcome.exit_code, 0) << outcome.output;
  const std::string key = "\\| `dodger.velocity_limit.max_speed_mps` \\| ";
  EXPECT_THAT(outcome.output, ContainsRegex(key + "5 \\| [0-9]+ / 12 \\| \\| \\| present \\|"));
  // A slower vehicle is worse: its count, not that of the present value.
  EXPECT_THAT(outcome.output,
              ContainsRegex(key + "3 \\| [0-9]+ / 12 \\| [1-9] / [0-9]+ \\| [0-9.]+ "));
}

TEST_F(SearchTest, SaysWhatItCanLookFor) {
  const Outcome outcome = search("nothing " + path("out"));
  EXPECT_EQ(outcome.exit_code, 2);
  EXPECT_THAT(outcome.output, HasSubstr("falanga2020, oracle, dodgesim, dodgesim_slow"));
}

}  // namespace

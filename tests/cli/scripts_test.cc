// The scripts in tools/ refuse what they do not understand before they install or build anything.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>
#include <utility>

#include "tests/cli/program.h"

namespace {

using dodgesim::testing::Outcome;
using dodgesim::testing::shell;
using ::testing::HasSubstr;

Outcome script(const std::string& command) {
  return shell("timeout 20 " + std::string(DODGESIM_SOURCE_DIR) + "/tools/" + command);
}

TEST(Scripts, RefuseOptionsThatTheyWouldNotFollow) {
  for (const auto& [command, complaint] : {
           std::pair{"setup --lint --slurm", "one option at a time"},
           {"build --debug --asan", "one flag, then targets, not: --asan"},
           {"fuzz 0 csv", "Usage: tools/fuzz SECONDS"},  // libFuzzer would never end
           {"fuzz 5 csv none", "no target none; there are: camera csv"},
       }) {
    const Outcome outcome = script(command);
    EXPECT_EQ(outcome.exit_code, 2) << command;
    EXPECT_THAT(outcome.output, HasSubstr(complaint)) << command;
  }
}

}  // namespace

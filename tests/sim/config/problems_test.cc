// Scenarios with many mistakes, or with very many words.
#include "sim/config/problems.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/sim/config/bad_scenario.h"

namespace dodgesim {
namespace {

using ::testing::HasSubstr;
using ::testing::StartsWith;

TEST(Problems, AllProblemsAreReportedInFileOrder) {
  const std::string error = error_of(
      "throw:\n  size_m: -1\n  sped_mps: 3\nrepeats: 0\nseed: 1\nseed: 2\nnonsense_key: 1\n");
  EXPECT_EQ(error,
            "bad.yaml:2:11: throw.size_m is -1, but must be between 0.01 and 1.\n"
            "bad.yaml:3:3: throw.sped_mps is not a known key; did you mean throw.speed_mps?\n"
            "bad.yaml:4:10: repeats is 0, but must be between 1 and 1000000.\n"
            "bad.yaml:6:1: seed is given twice; it is already in line 5.\n"
            "bad.yaml:7:1: nonsense_key is not a known key.");
}

TEST(Problems, ALongListOfProblemsIsCut) {
  std::string yaml;
  for (int i = 0; i < 200; ++i) yaml += "nonsense_" + std::to_string(i) + ": 1\n";
  EXPECT_THAT(error_of(yaml), HasSubstr("bad.yaml: and 180 more problems."));
}

// What a campaign keeps has every value spelled out, and must be readable.
TEST(Problems, MoreValuesThanCanBeReadAgainAreRefused) {
  const auto speeds = [](int count) {
    std::string values = "!uniform [1, 8]";
    for (int i = 1; i < count; ++i) values += ", !uniform [1, 8." + std::to_string(1000 + i) + "]";
    return "throw: {}\ngrid: {speed_mps: [" + values + "]}\n";
  };
  EXPECT_EQ(error_of(speeds(200)), "");
  EXPECT_THAT(error_of(speeds(1640)),
              StartsWith("bad.yaml:2:8: There are more than 5000 values, which no such file needs. "
                         "That is so with every value spelled out."));
}

TEST(Problems, AnAliasIsOneProblem) {
  EXPECT_EQ(error_of("seed: &a 1\nrepeats: *a\nthrow: *a\n"),
            "bad.yaml:1:7: Anchors (&name) are not supported; write the value out.\n"
            "bad.yaml:2:10: Aliases (*name) are not supported; write the value out.\n"
            "bad.yaml:3:8: Aliases (*name) are not supported; write the value out.");
}

TEST(Problems, AnAliasBombIsRefusedWithoutBeingExpanded) {
  std::string yaml = "a0: &a0 [1, 1, 1, 1, 1, 1, 1, 1, 1, 1]\n";
  for (int i = 1; i < 12; ++i) {
    const std::string alias = "*a" + std::to_string(i - 1);
    yaml += "a" + std::to_string(i) + ": &a" + std::to_string(i) + " [" + repeat(alias + ", ", 9) +
            alias + "]\n";
  }
  const std::string error = error_of(yaml);
  EXPECT_THAT(error, HasSubstr("bad.yaml:1:5: Anchors (&name) are not supported"));
  EXPECT_THAT(error, HasSubstr("bad.yaml:2:10: Aliases (*name) are not supported"));
}

TEST(Problems, LongTextIsCutInTheMessageAtAWholeCharacter) {
  const std::string error =
      error_of("pilot: " + std::string(59, 'x') + repeat("\xc3\xa4", 50) + "\n");
  EXPECT_THAT(error, HasSubstr("\"" + std::string(59, 'x') + "...\""));
}

}  // namespace
}  // namespace dodgesim

#include "sim/config/scenario_changes.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "sim/base/error.h"
#include "sim/config/scenario.h"

namespace dodgesim {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

std::vector<std::string> changes(const std::string& before, const std::string& after) {
  std::vector<std::string> texts;
  for (const ScenarioChange& change : scenario_changes(before, after)) {
    texts.push_back(change.key + ": " + change.before + ", " + change.after);
  }
  return texts;
}

TEST(ScenarioChanges, NamesTheKeysThatDiffer) {
  EXPECT_THAT(changes("a: {b: 1, c: [1, 2]}\nd: x\n", "a: {b: 2, c: [1, 2]}\ne: y\n"),
              ElementsAre("a.b: 1, 2", "d: x, unset", "e: unset, y"));
}

TEST(ScenarioChanges, SeesDistributions) {
  EXPECT_THAT(changes("a: !uniform [1, 2]\n", "a: !choice [1, 2]\n"),
              ElementsAre("a: !uniform [1, 2], !choice [1, 2]"));
}

TEST(ScenarioChanges, OfResolvedScenariosLeaveOutTheirTitles) {
  Scenario before;
  Scenario after = before;
  after.name = "other";
  after.description = "other";
  EXPECT_THAT(changes(to_yaml(before), to_yaml(after)), IsEmpty());
  after.delays.compute_us = 23500;
  EXPECT_THAT(changes(to_yaml(before), to_yaml(after)),
              ElementsAre("delays.compute_us: 3500, 23500"));
}

TEST(ScenarioChanges, InASentenceAreTheFirstKeyAndHowManyMore) {
  EXPECT_EQ(scenario_difference("a: 1\nname: x\n", "a: 1\nname: y\n"),
            "only its name or description differs");
  EXPECT_EQ(scenario_difference("a: 1\n", "a: 2\n"), "a is 1, not 2");
  EXPECT_EQ(scenario_difference("a: 1\nb: 1\n", "a: 2\n"), "a is 1, not 2, and 1 more key differs");
  EXPECT_EQ(scenario_difference("a: 1\nb: 1\n", "c: 2\n"),
            "a is 1, not unset, and 2 more keys differ");
}

TEST(ScenarioChanges, RefusesWhatIsNoMap) {
  EXPECT_THROW(scenario_changes("- 1\n", "a: 1\n"), ScenarioError);
}

}  // namespace
}  // namespace dodgesim

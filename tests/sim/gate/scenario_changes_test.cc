#include "sim/gate/scenario_changes.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "sim/base/error.h"
#include "sim/config/scenario.h"

namespace dodgesim {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

TEST(ScenarioChanges, NamesTheKeysThatDiffer) {
  EXPECT_THAT(scenario_changes("a: {b: 1, c: [1, 2]}\nd: x\n", "a: {b: 2, c: [1, 2]}\ne: y\n"),
              ElementsAre("a.b was 1, is 2", "d was x, is not there", "e was not there, is y"));
}

TEST(ScenarioChanges, SeesDistributions) {
  EXPECT_THAT(scenario_changes("a: !uniform [1, 2]\n", "a: !choice [1, 2]\n"),
              ElementsAre("a was !uniform [1, 2], is !choice [1, 2]"));
}

TEST(ScenarioChanges, OfResolvedScenariosLeaveOutTheirTitles) {
  Scenario before;
  Scenario after = before;
  after.name = "other";
  after.description = "other";
  EXPECT_THAT(scenario_changes(to_yaml(before), to_yaml(after)), IsEmpty());
  after.delays.compute_us = 23500;
  EXPECT_THAT(scenario_changes(to_yaml(before), to_yaml(after)),
              ElementsAre("delays.compute_us was 3500, is 23500"));
}

TEST(ScenarioChanges, RefusesWhatIsNoMap) {
  EXPECT_THROW(scenario_changes("- 1\n", "a: 1\n"), ScenarioError);
}

}  // namespace
}  // namespace dodgesim

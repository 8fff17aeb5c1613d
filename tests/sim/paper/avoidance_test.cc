// The tables of the avoidance experiments.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "sim/paper/experiment.h"
#include "tests/sim/paper/synthetic_campaign.h"

namespace dodgesim {
namespace {

using testing::HasSubstr;
using testing::Not;

TEST(AvoidanceTables, NameTheShapeAboveItsCauses) {
  const PaperExperiment shapes = shapes_experiment();
  const LoadedCampaign dodged = campaign({thrown(0, true, false)});
  std::vector<LoadedCampaign> campaigns(shapes.flights.size(), dodged);
  campaigns[4] = campaign({thrown(0, true, true, "seen late")});  // the third shape
  const std::string tables = shapes.analyse(campaigns).markdown;
  EXPECT_THAT(tables, HasSubstr("\nmarker, 0.14 m:\n\n| cause of hits and crashes |"));
  EXPECT_THAT(tables, HasSubstr("| seen late | 1 | 0 |"));
  EXPECT_THAT(tables, Not(HasSubstr("\nball, 0.1 m:")));  // nothing hit it
}

}  // namespace
}  // namespace dodgesim

// Which pilot looks at a recording, and with which keys: two events are enough.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "sim/files/csv_table.h"
#include "tests/cli/command_test.h"

namespace dodgesim::testing {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

class DetectScenarioTest : public CommandTest {
 protected:
  DetectScenarioTest() {
    write("e.csv", "t_us,x,y,p\n100,5,5,1\n9000,6,6,0\n");
    write("c.yaml", "{width: 64, height: 48}");
  }

  Outcome detect(const std::string& options) const {
    return dodgesim("detect " + path("e.csv") + " --calibration " + path("c.yaml") + " --out " +
                    path("found") + " " + options);
  }
};

TEST_F(DetectScenarioTest, RunsThePilotOfAUser) {
  const std::string plugin = "--plugin " DODGESIM_BINARY_DIR "/tests/plugins/libobedient.so";
  EXPECT_EQ(detect("--set pilot=plugin " + plugin).exit_code, 0);
  EXPECT_EQ(CsvTable(root_ / "found/cycles.csv").rows(), 3u);
  for (const std::string when : {"exit", "exit at once"}) {
    const Outcome ended =
        detect("--set pilot=plugin --set 'plugin_parameters=" + when + "' " + plugin);
    EXPECT_EQ(ended.exit_code, 3);
    EXPECT_THAT(ended.output, HasSubstr("The pilot ended the program by exit()."));
  }
  EXPECT_EQ(detect("--set pilot=plugin --set 'plugin_parameters=have a child that exits' " + plugin)
                .exit_code,
            0);
  EXPECT_EQ(detect("--set pilot=plugin").exit_code, 2);
  EXPECT_EQ(detect(plugin).exit_code, 2);
}

TEST_F(DetectScenarioTest, TakesTheOnlyValueOfASweepAndRefusesSeveral) {
  write("s.yaml", "sweep: {delays.compute_us: [20000], room: [room, field]}\n");
  const std::string scenario = "--scenario " + path("s.yaml");
  EXPECT_THAT(detect(scenario).output, HasSubstr("a cycle comes every 20 ms"));
  const Outcome several = detect(scenario + " --set sweep.delays.compute_us=[0,8000]");
  EXPECT_EQ(several.exit_code, 2);
  EXPECT_THAT(several.output,
              HasSubstr("The scenario has several values of delays.compute_us: "
                        "choose one, such as --set 'sweep.delays.compute_us=[8000]'."));
  const Outcome chosen = detect(scenario + " --set sweep.delays.compute_us=[8000]");
  EXPECT_THAT(chosen.output, HasSubstr("a cycle comes every 8 ms"));
  EXPECT_THAT(chosen.output, Not(HasSubstr("no effect")));
}

}  // namespace
}  // namespace dodgesim::testing

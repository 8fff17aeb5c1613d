// What dodgesim detect refuses to do, and what it says of recordings that are not as they should
// be.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/cli/command_test.h"

namespace dodgesim::testing {
namespace {

namespace fs = std::filesystem;
using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;

class DetectRefusalsTest : public CommandTest {
 protected:
  DetectRefusalsTest() {
    write("c.yaml", "{width: 64, height: 48}");
    std::string events = "t_us,x,y,p\n";
    for (int i = 0; i < 100; ++i) events += std::to_string(5000 * i) + ",5,5,1\n";
    write("e.csv", events);
  }

  Outcome detect(const std::string& events, const std::string& options = "") const {
    return dodgesim("detect " + path(events) + " --calibration " + path("c.yaml") + " --out " +
                    path("found") + " " + options);
  }
};

TEST_F(DetectRefusalsTest, DoesNotOverwriteItsInputs) {
  const std::string events = contents("e.csv");
  fs::create_directory(root_ / "found");
  for (const char* name : {"found/detections.csv", "found/clusters.csv.partial"}) {
    write(name, events);
    const Outcome outcome =
        detect(std::string(name).ends_with("csv") ? name : "e.csv", "--range " + path(name));
    EXPECT_EQ(outcome.exit_code, 2);
    EXPECT_EQ(outcome.output,
              "--out " + path("found") + " would overwrite the input " + path(name) + ".\n");
    EXPECT_EQ(contents(name), events);
    fs::remove(root_ / name);
  }
  write("found/cycles.csv", "t_us,wx,wy,wz\n0,0,0,0\n");
  for (const char* option : {"--imu ", "--state ", "--range ", "--scenario "}) {
    EXPECT_THAT(detect("e.csv", option + path("found/cycles.csv")).output,
                HasSubstr("would overwrite the input"));
  }
  EXPECT_EQ(contents("found/cycles.csv"), "t_us,wx,wy,wz\n0,0,0,0\n");
}

}  // namespace
}  // namespace dodgesim::testing

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
    write("e2.csv", events);
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
  write("r.mp4", "t_us,range_m\n");
  EXPECT_THAT(detect("e.csv", "--range " + path("r.mp4") + " --video " + path("r.mp4")).output,
              HasSubstr("would overwrite the input"));
  for (const char* camera : {"", ":cam1"}) {
    EXPECT_THAT(dodgesim("detect " + path("e.csv") + " --calibration " + path("found/cycles.csv") +
                         camera + " --out " + path("found"))
                    .output,
                HasSubstr("would overwrite the input"));
  }
  EXPECT_EQ(contents("found/cycles.csv"), "t_us,wx,wy,wz\n0,0,0,0\n");
}

TEST_F(DetectRefusalsTest, NamesTheCalibrationsOfAPair) {
  for (const char* name : {"up.yaml", "down.yaml"}) {
    write(name, "{width: 64, height: 48, p_BC_m: [0, 0, " +
                    std::string(name == std::string("up.yaml") ? "0.1" : "0") + "]}");
  }
  const auto refusal = [this](const std::string& first, const std::string& second) {
    return dodgesim("detect " + path("e.csv") + " " + path("e2.csv") + " --calibration " +
                    path(first) + " " + path(second) + " --out " + path("found"))
        .output;
  };
  EXPECT_THAT(refusal("down.yaml", "up.yaml"),
              AllOf(HasSubstr(path("down.yaml") + " and " + path("up.yaml") + ": Stereo needs"),
                    HasSubstr("give the upper camera first.")));
  EXPECT_THAT(refusal("up.yaml", "up.yaml"), HasSubstr("give both the same place"));
}

TEST_F(DetectRefusalsTest, TakesNoFileForBothCameras) {
  fs::create_symlink(root_ / "e.csv", root_ / "same.csv");
  const Outcome outcome =
      dodgesim("detect " + path("e.csv") + " " + path("same.csv") + " --calibration " +
               path("c.yaml") + " " + path("c.yaml") + " --out " + path("found"));
  EXPECT_EQ(outcome.exit_code, 2);
  EXPECT_EQ(outcome.output,
            path("same.csv") + ": is given for both cameras; each needs its own events.\n");
}

TEST_F(DetectRefusalsTest, NamesTheFileOfEvents) {
  write("none.csv", "t_us,x,y,p\n");
  EXPECT_THAT(detect("none.csv").output, HasSubstr(path("none.csv") + " has no event."));
  std::string text = "0.5 5 5 1\n";
  for (int i = 0; i < 40; ++i) text += "1000 5 5 1\n";
  write("e.txt", text);
  const Outcome jump = detect("e.txt");
  EXPECT_EQ(jump.exit_code, 2);
  EXPECT_THAT(jump.output,
              AllOf(HasSubstr("e.txt: its times have fractions, and are taken for seconds."),
                    HasSubstr("e.txt has an event at 1000000000 us after one at 500000 us")));
  EXPECT_FALSE(fs::exists(path("found")));
}

TEST_F(DetectRefusalsTest, SaysWhatALogLacks) {
  const std::string names = "t_us,x,y,z,qw,qx,qy,qz,vx,vy,vz\n", rest = ",0,0,1,1,0,0,0,0,0,0\n";
  write("late.csv", names + "300000" + rest + "500000" + rest);
  EXPECT_THAT(detect("e.csv", "--state " + path("late.csv")).output,
              HasSubstr("State: before its first reading, 0.300 s after the first event, nothing "
                        "can be measured\nState: 2 readings, covers 0.195 of 0.495 s"));
  write("one.csv", names + "0" + rest);
  EXPECT_THAT(detect("e.csv", "--state " + path("one.csv")).output,
              AllOf(HasSubstr("State: 1 reading\n"), Not(HasSubstr("nothing can be measured")),
                    Not(HasSubstr("of one clock?"))));
}

TEST_F(DetectRefusalsTest, SaysThatThePilotLandsAndThatRangesAreOfNoUse) {
  std::string state = "t_us,x,y,z,qw,qx,qy,qz,vx,vy,vz\n", range = "t_us,range_m\n", mm = range;
  for (int ms = 0; ms < 500; ms += 5) {
    const std::string stamp = std::to_string(1000 * ms) + ",";
    state += stamp + "0,0," + (ms < 250 ? "1.0" : "1.5") + ",1,0,0,0,0,0,0\n";
    range += stamp + "1.0\n";
    mm += stamp + "1000\n";
  }
  write("state.csv", state);
  write("range.csv", range);
  write("mm.csv", mm);
  const std::string options =
      "--set dodger.height_monitor.persist_us=100000 --state " + path("state.csv") + " --range ";
  const std::string lands = detect("e.csv", options + path("range.csv")).output;
  EXPECT_THAT(lands, ::testing::ContainsRegex(
                         "The pilot lands in [0-9]+ cycles, from 0\\.3[0-9]+ s on: its height "
                         "estimate and the range readings disagree\n"));
  EXPECT_THAT(lands, Not(HasSubstr("are they in metres?")));
  EXPECT_THAT(detect("e.csv", options + path("mm.csv")).output,
              AllOf(HasSubstr("Range: no reading (of 100) lies within 0.5 to 60 m: are they in "
                              "metres?\n"),
                    Not(HasSubstr("lands"))));
}

// What is said of a log beside events of 20 ms.
class DetectImuTest : public DetectRefusalsTest {
 protected:
  std::string said_of(const std::string& readings, int begin_us) {
    std::string events = "t_us,x,y,p\n";
    for (int i = 0; i < 100; ++i) events += std::to_string(begin_us + 200 * i) + ",5,5,1\n";
    write("e.csv", events);
    write("i.csv", "t_us,wx,wy,wz\n" + readings);
    return detect("e.csv", "--imu " + path("i.csv")).output;
  }
};

// Not of the time before and after.
TEST_F(DetectImuTest, SaysHowLongTheImuWasSilentInTheRecording) {
  const std::string readings =
      "0,0,0,0\n9990000,0,0,0\n10005000,0,0,0\n10030000,0,0,0\n20000000,0,0,0\n";
  EXPECT_THAT(said_of(readings, 10'000'000),
              HasSubstr("IMU: 5 readings, covers 0.020 of 0.020 s, longest gap 25.0 ms\n"));
}

TEST_F(DetectImuTest, AsksForTheUnitOfAClockThatRunsAThousandTimesTooFast) {
  std::string readings;  // of 1 kHz, in ns
  for (int i = 0; i < 20; ++i) readings += std::to_string(1'000'000 * i) + ",0,0,0\n";
  EXPECT_THAT(said_of(readings, 0),
              HasSubstr("longest gap 1000.0 ms: are all times in microseconds, of one clock?"));
}

}  // namespace
}  // namespace dodgesim::testing

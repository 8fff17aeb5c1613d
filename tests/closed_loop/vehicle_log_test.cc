// A flight as the vehicle would record it; what `dodgesim detect` finds in it: tests/cli.
#include "sim/observers/vehicle_log.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <map>
#include <string>

#include "sim/base/error.h"
#include "tests/closed_loop/flights.h"
#include "tests/sim/files/temporary_directory.h"

namespace dodgesim {
namespace {

namespace fs = std::filesystem;

std::map<std::string, std::string> files_of(const fs::path& directory) {
  std::map<std::string, std::string> files;
  for (const auto& entry : fs::directory_iterator(directory)) {
    files[entry.path().filename().string()] = testing::contents(entry.path());
  }
  return files;
}

// 20 ms of a flight, with stereo or mono, of which the log is finished or not.
void record(const fs::path& directory, const std::string& depth, bool finished,
            const std::string& pilot = "falanga2020") {
  const Scenario s = scenario("pilot: " + pilot + "\nthrow: {launch_s: 0.1}\n" +
                              "dodger: {position: {depth: " + depth + "}}\n");
  FlightPlan plan = plan_throw(s, 0);
  plan.end_us = 20000;
  VehicleLog log(directory, s);
  fly(s, plan, &log);
  if (finished) log.finish();
}

TEST(VehicleLog, AppearsWholeOrNotAtAll) {
  const testing::TemporaryDirectory root;
  const fs::path directory = root / "rec";
  record(directory, "stereo", false);
  EXPECT_FALSE(fs::exists(directory));
  record(directory, "stereo", true);
  const auto stereo = files_of(directory);
  EXPECT_EQ(stereo.size(), 9u);
  record(directory, "mono", false);
  EXPECT_EQ(files_of(directory), stereo);
  record(directory, "mono", true);  // in place of the earlier one, which had a second camera
  const auto mono = files_of(directory);
  EXPECT_EQ(mono.size(), 7u);
  EXPECT_FALSE(mono.contains("bottom.h5"));
}

TEST(VehicleLog, OfAPilotWithoutCamerasHasTheRest) {
  const testing::TemporaryDirectory root;
  const fs::path directory = root / "rec";
  record(directory, "stereo", true);
  const auto seen = files_of(directory);
  record(directory, "stereo", true, "oracle");
  const auto told = files_of(directory);
  EXPECT_EQ(told.size(), 5u);
  EXPECT_EQ(told.at("truth.csv"), seen.at("truth.csv"));  // nothing has been thrown yet
  EXPECT_EQ(told.at("imu.csv"), seen.at("imu.csv"));
  EXPECT_NO_THROW(expect_recording_or_nothing(directory, "--record"));
  fs::remove(directory / "state.csv");
  EXPECT_THROW(expect_recording_or_nothing(directory, "--record"), ScenarioError);
}

TEST(VehicleLog, GivesWayToNoneThatTheDiskHasNoPlaceFor) {
  const testing::TemporaryDirectory root;
  const fs::path directory = root / "rec";
  record(directory, "mono", true);
  const auto before = files_of(directory);
  for (const auto& [name, contents] : before) {
    const fs::path partial = directory / (name + ".partial");
    fs::create_symlink("/dev/full", partial);
    EXPECT_THROW(record(directory, "stereo", true), IoError) << name;
    fs::remove(partial);
    EXPECT_EQ(files_of(directory), before) << name;
  }
}

}  // namespace
}  // namespace dodgesim

// dodgesim replay --frames: what a camera sees, for other event simulators and for frame cameras.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdint>
#include <cstring>
#include <filesystem>
#include <sstream>
#include <utility>

#include "tests/cli/command_test.h"

namespace dodgesim::testing {
namespace {

using ::testing::HasSubstr;

class ReplayFramesTest : public CommandTest {
 protected:
  ReplayFramesTest() {
    write("s.yaml",
          "seed: 3\nfly_oracle: false\nafter_s: 0.1\nmission: {start_m: [-2, 0, 2]}\n"
          "sensors: {camera: {width: 64, height: 48}, events: {preset: ideal}}\n"
          "throw: {distance_m: 1.5, speed_mps: 8, size_m: 0.2, launch_s: 0.1}\n");
    const Outcome run =
        dodgesim("run " + path("s.yaml") + " --out " + path("out") + " --throws 1 -j 1");
    EXPECT_EQ(run.exit_code, 0) << run.output;
  }

  Outcome replay(const std::string& options) const {
    return dodgesim("replay " + path("out") + " --throw 0 " + options);
  }
  std::string frames() const {
    return "--frames " + path("f.npy") + " --timestamps " + path("t.npy") + " ";
  }

  // Events of a recording as text with a stamp in [from_us, to_us): ON, OFF.
  std::pair<double, double> count(const std::string& name, long long from_us,
                                  long long to_us) const {
    std::istringstream lines(contents(name));
    std::pair<double, double> counts;
    std::string line;
    while (std::getline(lines, line)) {
      std::istringstream fields(line);
      long long t_us = 0;
      int x = 0, y = 0, p = 0;
      fields >> t_us >> x >> y >> p;
      if (t_us >= from_us && t_us < to_us) ++(p > 0 ? counts.first : counts.second);
    }
    return counts;
  }
};

// The ideal camera's events are those of the light alone, whoever takes the samples.
TEST_F(ReplayFramesTest, FramesOfAFlightGiveItsEventsAgain) {
  const Outcome flown =
      replay(frames() + "--frames-hz 4000 --camera bottom --events " + path("flown.txt"));
  ASSERT_EQ(flown.exit_code, 0) << flown.output;
  EXPECT_THAT(flown.output, HasSubstr("frames of the bottom camera: " + path("f.npy")));
  const Outcome emulated = dodgesim("emulate " + path("f.npy") + " --timestamps " + path("t.npy") +
                                    " --camera ideal --out " + path("emulated.txt"));
  ASSERT_EQ(emulated.exit_code, 0) << emulated.output;
  // Of the ball that comes into existence at 0.1 s the flight's cameras make no events.
  EXPECT_GT(count("emulated.txt", 100000, 100250).second, 20);
  const auto expected = count("flown.txt", 110000, 245000);
  const auto found = count("emulated.txt", 110000, 245000);
  EXPECT_GT(expected.first, 1000);
  EXPECT_NEAR(found.first / expected.first, 1, 0.04);
  EXPECT_NEAR(found.second / expected.second, 1, 0.04);
}

TEST_F(ReplayFramesTest, HaveTheRateAndTheShapeThatWereAskedFor) {
  ASSERT_EQ(replay(frames() + "--frames-hz 100").exit_code, 0);
  const std::string times = contents("t.npy");
  ASSERT_GE(times.size(), 128U + 80);
  EXPECT_EQ(contents("f.npy").size(), 128 + (times.size() - 128) / 8 * 48 * 64 * 4);
  EXPECT_THAT(contents("f.npy").substr(0, 128), HasSubstr(", 48, 64)"));
  const auto stamp_us = [&](std::size_t i) {
    std::int64_t t_us = 0;
    std::memcpy(&t_us, times.data() + 128 + 8 * i, 8);
    return t_us;
  };
  for (std::size_t i = 0; i < 10; ++i) {
    EXPECT_EQ(stamp_us(i), 10000 * static_cast<std::int64_t>(i + 1));
  }
}

TEST_F(ReplayFramesTest, NeedTheirInstants) {
  EXPECT_EQ(replay("--frames " + path("f.npy")).exit_code, 2);
  EXPECT_EQ(replay("--frames-hz 100").exit_code, 2);
  EXPECT_THAT(replay("--camera bottom").output, HasSubstr("neither is given"));
  const Outcome rare = replay(frames() + "--frames-hz 4");
  EXPECT_EQ(rare.exit_code, 3);
  EXPECT_THAT(rare.output, HasSubstr("too short for two frames at --frames-hz 4."));
  EXPECT_THAT(replay("--frames " + path("f.npy") + " --timestamps " + path("f.npy")).output,
              HasSubstr("--timestamps " + path("f.npy") + ": is the file of the frames."));
  EXPECT_FALSE(std::filesystem::exists(root_ / "f.npy"));
}

}  // namespace
}  // namespace dodgesim::testing

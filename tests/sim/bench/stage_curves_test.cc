#include "sim/bench/stage_curves.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <string>

#include "tests/sim/files/temporary_directory.h"

namespace dodgesim {
namespace {

namespace fs = std::filesystem;

std::vector<WindowTimes> windows() {
  // 10 us and 3 ns an event; 5 us and 20 ns a pixel; noise that is the same on both sides.
  std::vector<WindowTimes> windows;
  for (int i = 0; i < 40; ++i) {
    const double noise_us = i % 4 < 2 ? 0.5 : -0.5;
    const int step = i / 4;
    const double events = 500.0 * step, pixels = 30.0 * step;
    windows.push_back(
        {events, pixels, 10 + 3e-3 * events + noise_us, 5 + 0.02 * pixels - noise_us});
  }
  return windows;
}

TEST(StageCurves, HaveTheSlopesOfTheLoad) {
  EXPECT_NEAR(ego_motion_us_per_event(windows()), 3e-3, 1e-9);
  EXPECT_NEAR(clustering_us_per_pixel(windows()), 0.02, 1e-9);
  EXPECT_EQ(ego_motion_us_per_event({{100, 1, 5, 5}, {100, 1, 7, 5}}), 0);
}

TEST(StageCurves, AreDrawnAndWritten) {
  const testing::TemporaryDirectory directory;
  const fs::path out = directory / "curves";
  write_stage_curves(out, windows());
  EXPECT_GT(fs::file_size(out / "ego_motion.png"), 1000u);
  EXPECT_GT(fs::file_size(out / "clustering.png"), 1000u);
  std::ifstream csv(out / "windows.csv");
  std::string line;
  std::getline(csv, line);
  EXPECT_EQ(line, "events,pixels,ego_motion_us,clustering_us");
  std::getline(csv, line);
  EXPECT_EQ(line, "0,0,10.50,4.50");
}

}  // namespace
}  // namespace dodgesim

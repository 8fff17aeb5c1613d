#include "sim/observers/stage_panels.h"

#include <gtest/gtest.h>

#include <filesystem>

#include "sim/base/error.h"
#include "sim/camera/looking_forward.h"
#include "tests/closed_loop/flights.h"
#include "tests/closed_loop/pictures/decoded.h"
#include "tests/sim/files/temporary_directory.h"

namespace dodgesim {
namespace {

using testing::kBlack, testing::kGrey, testing::kWhite;

// A pilot that has seen one bar move in front of each camera.
std::unique_ptr<dodge::Dodger> dodger_with_events() {
  dodge::Config config;
  for (const double z : {0.075, -0.075}) {
    dodge::CameraModel camera;
    camera.X_BC.linear() = looking_forward();
    camera.X_BC.translation() = Eigen::Vector3d(0.12, 0, z);
    config.cameras.push_back(camera);
  }
  auto pilot = std::make_unique<dodge::Dodger>(config);
  pilot->set_capture(true);
  for (int i = 0; i <= 20; ++i) {
    pilot->add_imu({1000 * i, Eigen::Vector3d::Zero(), {0, 0, 9.81}});
    dodge::StateEstimate state;
    state.t_us = 1000 * i;
    pilot->add_state(state);
  }
  std::vector<dodge::Event> events;
  for (int column = 0; column < 10; ++column) {
    for (int row = 100; row < 130; ++row) {
      events.push_back({10500 + 900 * column, static_cast<std::uint16_t>(60 + column),
                        static_cast<std::uint16_t>(row),
                        static_cast<std::int8_t>(column < 5 ? 1 : -1)});
    }
  }
  for (int camera = 0; camera < 2; ++camera) pilot->add_events(camera, events);
  pilot->update(20000);
  return pilot;
}

TEST(StagePanels, ShowFiveStagesSideBySide) {
  const auto pilot = dodger_with_events();
  for (int camera = 0; camera < 2; ++camera) {
    cv::Mat3b panels;
    cv::hconcat(stage_panels(*pilot, camera, 320), panels);
    ASSERT_EQ(panels.size(), cv::Size(5 * 320, 240));
    const dodge::StageImages& stages = pilot->stage_images(camera);
    // Events: white brighter, black darker, grey nothing. Away from the caption.
    EXPECT_EQ(panels(115, 62), kWhite);
    EXPECT_EQ(panels(115, 68), kBlack);
    EXPECT_EQ(panels(200, 200), kGrey);
    // The other panels are black where there is no event, and marked where there is one.
    int marked = 0;
    for (int row = 90; row < 140; ++row) {
      for (int column = 40; column < 90; ++column) {
        const bool any = stages.count(row, column) > 0;
        EXPECT_EQ(panels(row, 320 + column), any ? kWhite : kBlack);
        EXPECT_EQ(panels(row, 960 + column) != kBlack, any || stages.threshold_mask(row, column));
        if (!any) {
          EXPECT_EQ(panels(row, 640 + column), kBlack);
        }
        marked += any;
      }
    }
    EXPECT_GT(marked, 200);
  }
}

TEST(StagePanels, AreEmptyWithoutCapture) {
  dodge::Config config;
  config.cameras.resize(2);
  config.cameras[1].X_BC.translation() = Eigen::Vector3d(0, 0, -0.15);
  for (dodge::CameraModel& camera : config.cameras) {
    camera.X_BC.linear() = looking_forward();
  }
  EXPECT_TRUE(stage_panels(dodge::Dodger(config), 0, 320).empty());
}

TEST(StageFilm, OfADirectoryThatCannotBeMadeIsAnIoError) {
  const testing::TemporaryDirectory directory;
  testing::put(directory / "file", "not a directory");
  EXPECT_THROW(StageFilm((directory / "file/stages").string()), IoError);
}

TEST(StageFilm, WritesOnePictureOfTheStagesACycleWhileAnObjectFlies) {
  const Scenario s = scenario(
      "mission: {start_m: [-2, 0, 2]}\n"
      "throw: {distance_m: 3, speed_mps: 5, launch_s: 0.1}\nafter_s: 0.1\n");
  FlightPlan plan = plan_throw(s, 0);
  plan.end_us = 120000;  // 20 ms after the launch
  const testing::TemporaryDirectory directory;
  std::filesystem::create_directory(directory / "stages");
  testing::put(directory / "stages/stages_000999000_us.png", "of an earlier flight");
  StageFilm film((directory / "stages").string());
  fly(s, plan, &film);
  EXPECT_EQ(film.pictures(), 5);  // cycles at 104 to 120 ms
  int files = 0;
  for (const auto& file : std::filesystem::directory_iterator(directory / "stages")) {
    ++files;
    EXPECT_EQ(testing::decoded(file.path().string()).at(0).size(), cv::Size(5 * 320, 2 * 240));
  }
  EXPECT_EQ(files, 5);
  EXPECT_TRUE(std::filesystem::exists(directory / "stages/stages_000104000_us.png"));
}

// However small or large a camera's image is.
TEST(TitledPanel, HasItsWidthAndATitleOfOneSize) {
  int dark = 0;
  for (const int width : {16, 64, 320, 1280}) {
    const cv::Mat3b panel =
        titled_panel(cv::Mat3b(width * 3 / 4, width, kWhite), 320, "mean time stamp");
    EXPECT_EQ(panel.size(), cv::Size(320, 240));
    cv::Mat1b black;
    cv::inRange(panel, cv::Scalar::all(0), cv::Scalar::all(60), black);
    const int now_dark = cv::countNonZero(black);
    EXPECT_GT(now_dark, 100);
    EXPECT_EQ(now_dark, dark == 0 ? now_dark : dark);
    dark = now_dark;
  }
}

}  // namespace
}  // namespace dodgesim

#include "sim/observers/film.h"

#include <gtest/gtest.h>

#include <unistd.h>

#include <filesystem>
#include <fstream>

#include "sim/base/error.h"
#include "tests/closed_loop/flights.h"
#include "tests/closed_loop/pictures/decoded.h"

namespace dodgesim {
namespace {

namespace fs = std::filesystem;

const cv::Vec3b kGrey(110, 110, 110), kWhite(255, 255, 255), kBlack(0, 0, 0);

// A folder of this test's own, removed afterwards.
class FilmTest : public ::testing::Test {
 protected:
  FilmTest() {
    const auto* test = ::testing::UnitTest::GetInstance()->current_test_info();
    folder_ = fs::temp_directory_path() /
              ("dodgesim_" + std::string(test->name()) + "_" + std::to_string(getpid()));
    fs::create_directories(folder_);
  }
  ~FilmTest() override { fs::remove_all(folder_); }

  std::string path(const std::string& name) const { return (folder_ / name).string(); }

  fs::path folder_;
};

TEST(EventPicture, ShowsOnWhiteAndOffBlackAtTheirPixels) {
  EventPicture picture(8, 6);
  picture.add(std::vector<Event>{{1, 7, 0, 1}, {2, 0, 5, -1}, {3, 2, 3, 1}, {4, 2, 3, -1}});
  const cv::Mat3b& image = picture.image();
  ASSERT_EQ(image.size(), cv::Size(8, 6));
  EXPECT_EQ(image(0, 7), kWhite);
  EXPECT_EQ(image(5, 0), kBlack);
  EXPECT_EQ(image(3, 2), kBlack);  // the last one
  EXPECT_EQ(image(1, 1), kGrey);
  picture.clear();
  EXPECT_EQ(image(0, 7), kGrey);
}

// The pilot `none` needs no eyes, so the test itself plays the event cameras.
TEST_F(FilmTest, WritesAVideoWithAPictureEvery4Ms) {
  const Scenario s = scenario("duration_s: 0.1\npilot: none\n");
  const std::string video = path("a.mp4");
  Film film(video, intrinsics(s.sensors.camera), 10);
  fly(s, plan_throw(s, 0), &film);
  film.close();
  EXPECT_EQ(testing::pictures_per_s(video), 25);
  const std::vector<cv::Mat3b> pictures = testing::decoded(video);
  EXPECT_EQ(pictures.size(), 25u);
  for (const cv::Mat3b& picture : pictures) EXPECT_EQ(picture.size(), cv::Size(640 + 320, 480));
  EXPECT_EQ(film.picture().size(), cv::Size(640 + 320, 480));
  // The outside view shows something; the event pictures are grey.
  cv::Scalar mean, sd;
  cv::meanStdDev(film.picture()(cv::Rect(0, 60, 640, 360)), mean, sd);
  EXPECT_GT(sd[1], 5);
  EXPECT_EQ(film.picture()(120, 800), kGrey);
  EXPECT_EQ(film.picture()(400, 800), kGrey);
}

TEST_F(FilmTest, ShowsAFlightAsSlowlyAsAskedFor) {
  const Scenario s = scenario("duration_s: 0.1\npilot: none\n");
  for (const double slow : {1.0, 3.0, 7.5}) {
    const std::string video = path("slow.mp4");
    Film film(video, intrinsics(s.sensors.camera), slow);
    fly(s, plan_throw(s, 0), &film);
    film.close();
    const auto pictures = static_cast<double>(testing::decoded(video).size());
    const double shown_s = pictures / testing::pictures_per_s(video);
    EXPECT_NEAR(shown_s, 0.1 * slow, 0.04) << slow;  // up to a picture
  }
}

TEST_F(FilmTest, ShowsTheTopCamerasEventsAboveThoseOfTheBottomOne) {
  const Scenario s = scenario("{}");
  Film film(path("b.mp4"), intrinsics(s.sensors.camera), 10);
  const std::vector<Event> top = {{1, 100, 60, 1}}, bottom = {{1, 200, 180, -1}};
  film.on_events(0, {1000, top});
  film.on_events(1, {1000, bottom});
  World world({s.models_dir, s.room, s.vehicle, {}});
  const auto tick = [&] { film.on_tick(world); };  // at time 0: a picture
  tick();
  EXPECT_EQ(film.picture()(60, 640 + 100), kWhite);
  EXPECT_EQ(film.picture()(240 + 180, 640 + 200), kBlack);
  EXPECT_EQ(film.picture()(240 + 60, 640 + 100), kGrey);
  tick();  // each event is shown once
  EXPECT_EQ(film.picture()(60, 640 + 100), kGrey);
}

TEST_F(FilmTest, AVideoThatCannotBeWrittenIsAnIoError) {
  EXPECT_THROW(Film(path("no/such/folder/a.mp4"), Intrinsics{}, 10), IoError);
}

TEST_F(FilmTest, AVideoThatIsGoneIsAnIoError) {
  const Scenario s = scenario("duration_s: 0.1\npilot: none\n");
  Film film(path("c.mp4"), intrinsics(s.sensors.camera), 10);
  fly(s, plan_throw(s, 0), &film);
  fs::remove(path("c.mp4.partial"));
  EXPECT_THROW(film.close(), IoError);
}

TEST_F(FilmTest, AVideoThatIsNotFinishedLeavesAnOtherOfItsName) {
  std::ofstream(path("d.mp4")) << "old";
  { const Film film(path("d.mp4"), Intrinsics{}, 10); }
  EXPECT_EQ(fs::file_size(path("d.mp4")), 3u);
  EXPECT_FALSE(fs::exists(path("d.mp4.partial")));
}

TEST_F(FilmTest, TwoDoNotTakeOneName) {
  const Film film(path("e.mp4"), Intrinsics{}, 10);
  EXPECT_THROW(Film(path("e.mp4"), Intrinsics{}, 10), IoError);
  EXPECT_TRUE(fs::exists(path("e.mp4.partial")));
}

TEST_F(FilmTest, ADirectoryThatCannotBeMadeIsAnIoError) {
  std::ofstream(path("file")) << "not a directory";
  EXPECT_THROW(StageFilm(path("file/stages")), IoError);
}

// A pilot that has seen one bar move in front of each camera.
std::unique_ptr<dodge::Dodger> dodger_with_events() {
  dodge::Config config;
  for (const double z : {0.075, -0.075}) {
    dodge::CameraModel camera;
    camera.X_BC.linear() << 0, 0, 1, -1, 0, 0, 0, -1, 0;
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
    const cv::Mat3b panels = stage_panels(*pilot, camera);
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
    camera.X_BC.linear() << 0, 0, 1, -1, 0, 0, 0, -1, 0;
  }
  EXPECT_TRUE(stage_panels(dodge::Dodger(config), 0).empty());
}

TEST_F(FilmTest, WritesOnePictureOfTheStagesACycleWhileAnObjectFlies) {
  const Scenario s = scenario(
      "mission: {start_m: [-2, 0, 2]}\n"
      "throw: {distance_m: 3, speed_mps: 5, launch_s: 0.1}\nafter_s: 0.1\n");
  FlightPlan plan = plan_throw(s, 0);
  plan.end_us = 120000;  // 20 ms after the launch
  StageFilm film(path("stages"));
  fly(s, plan, &film);
  EXPECT_EQ(film.pictures(), 5);  // cycles at 104 to 120 ms
  int files = 0;
  for (const auto& file : fs::directory_iterator(path("stages"))) {
    ++files;
    EXPECT_EQ(testing::decoded(file.path().string()).at(0).size(), cv::Size(5 * 320, 2 * 240));
  }
  EXPECT_EQ(files, 5);
  EXPECT_TRUE(fs::exists(path("stages/stages_000104000_us.png")));
}

}  // namespace
}  // namespace dodgesim

#include "sim/observers/film.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "sim/base/error.h"
#include "sim/flight/setup.h"
#include "tests/closed_loop/flights.h"
#include "tests/closed_loop/pictures/decoded.h"
#include "tests/sim/files/temporary_directory.h"

namespace dodgesim {
namespace {

namespace fs = std::filesystem;

using testing::kBlack, testing::kGrey, testing::kWhite;

class FilmTest : public ::testing::Test {
 protected:
  std::string path(const std::string& name) const { return (folder_ / name).string(); }

  const testing::TemporaryDirectory folder_;
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
  Film film(video, intrinsics(s.sensors.camera), 2, 10);
  fly(s, plan_throw(s, 0), &film);
  film.finish("dodged");
  EXPECT_EQ(testing::pictures_per_s(video), 25);
  const std::vector<cv::Mat3b> pictures = testing::decoded(video);
  EXPECT_EQ(pictures.size(), 25u + 25u);  // the last for a second, with the verdict
  EXPECT_GT(cv::norm(pictures[24], pictures[25], cv::NORM_INF), 100);
  EXPECT_LT(cv::norm(pictures[25], pictures[49], cv::NORM_INF), 30);
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
    Film film(video, intrinsics(s.sensors.camera), 2, slow);
    fly(s, plan_throw(s, 0), &film);
    film.finish("dodged");
    const auto pictures = static_cast<double>(testing::decoded(video).size());
    const double shown_s = pictures / testing::pictures_per_s(video);
    EXPECT_NEAR(shown_s, 0.1 * slow + 1, 0.05) << slow;  // up to a picture, and the verdict
  }
}

TEST_F(FilmTest, ShowsTheTopCamerasEventsAboveThoseOfTheBottomOne) {
  const Scenario s = scenario("{}");
  Film film(path("b.mp4"), intrinsics(s.sensors.camera), 2, 10);
  const std::vector<Event> top = {{1, 100, 60, 1}}, bottom = {{1, 200, 180, -1}};
  film.on_events(0, {1000, top});
  film.on_events(1, {1000, bottom});
  World world({s.models_dir, s.room, s.vehicle, {}});
  const auto tick = [&] { film.on_tick(world); };  // at time 0: a picture
  tick();
  EXPECT_EQ(film.picture()(60, 640 + 100), kWhite);
  EXPECT_EQ(film.picture()(240 + 180, 640 + 200), kBlack);
  EXPECT_EQ(film.picture()(240 + 60, 640 + 100), kGrey);
  tick();
  EXPECT_EQ(film.picture()(60, 640 + 100), kWhite) << "until there are others";
  const std::vector<Event> next = {{2, 101, 60, 1}};
  film.on_events(0, {2000, next});
  tick();
  EXPECT_EQ(film.picture()(60, 640 + 100), kGrey);
  EXPECT_EQ(film.picture()(60, 640 + 101), kWhite);
  EXPECT_EQ(film.picture()(240 + 180, 640 + 200), kBlack) << "of the other camera";
  film.on_events(0, {-4000, next});  // long ago
  tick();
  tick();
  EXPECT_EQ(film.picture()(60, 640 + 101), kGrey);
}

TEST_F(FilmTest, ShowsNoEventsOfCamerasThatNobodyUses) {
  const Scenario s = scenario("{}");
  World world({s.models_dir, s.room, s.vehicle, {}});
  Film blind(path("blind.mp4"), intrinsics(s.sensors.camera), 0, 10);
  blind.on_tick(world);
  EXPECT_EQ(blind.picture().size(), cv::Size(640, 480));
  Film mono(path("mono.mp4"), intrinsics(s.sensors.camera), 1, 10);
  mono.on_tick(world);
  EXPECT_EQ(mono.picture().size(), cv::Size(640 + 320, 480));
  EXPECT_EQ(mono.picture()(120, 800), kGrey);
  EXPECT_EQ(mono.picture()(400, 800), kBlack);
}

TEST_F(FilmTest, AVideoThatCannotBeWrittenIsAnIoError) {
  EXPECT_THROW(Film(path("no/such/folder/a.mp4"), Intrinsics{}, 2, 10), IoError);
}

TEST_F(FilmTest, AVideoThatIsGoneIsAnIoError) {
  const Scenario s = scenario("duration_s: 0.1\npilot: none\n");
  Film film(path("c.mp4"), intrinsics(s.sensors.camera), 2, 10);
  fly(s, plan_throw(s, 0), &film);
  fs::remove(path("c.mp4.partial"));
  EXPECT_THROW(film.finish("dodged"), IoError);
}

TEST_F(FilmTest, AVideoThatIsNotFinishedLeavesAnOtherOfItsName) {
  std::ofstream(path("d.mp4")) << "old";
  { const Film film(path("d.mp4"), Intrinsics{}, 2, 10); }
  EXPECT_EQ(fs::file_size(path("d.mp4")), 3u);
  EXPECT_FALSE(fs::exists(path("d.mp4.partial")));
}

TEST_F(FilmTest, TwoDoNotTakeOneName) {
  const Film film(path("e.mp4"), Intrinsics{}, 2, 10);
  EXPECT_THROW(Film(path("e.mp4"), Intrinsics{}, 2, 10), IoError);
  EXPECT_TRUE(fs::exists(path("e.mp4.partial")));
}

}  // namespace
}  // namespace dodgesim

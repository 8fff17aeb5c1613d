#include "sim/files/video_file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <opencv2/videoio.hpp>

#include "sim/base/error.h"
#include "tests/sim/files/temporary_directory.h"

namespace dodgesim {
namespace {

namespace fs = std::filesystem;

class VideoFileTest : public ::testing::Test {
 protected:
  std::string path() const { return (directory_ / "video.mp4").string(); }

  const testing::TemporaryDirectory directory_;
};

// Left half blue, right half red; sides that H.264 does not take as they are.
TEST_F(VideoFileTest, ShowsThePicturesInTheirColours) {
  cv::Mat3b picture(47, 61, cv::Vec3b(200, 30, 30));
  picture.colRange(31, 61).setTo(cv::Vec3b(30, 30, 200));
  VideoFile video(path(), picture.cols, picture.rows, 12.5);
  for (int i = 0; i < 5; ++i) video.write(picture.data);
  video.close();
  cv::VideoCapture reader(path(), cv::CAP_FFMPEG);
  ASSERT_TRUE(reader.isOpened());
  EXPECT_EQ(reader.get(cv::CAP_PROP_FPS), 12.5);
  cv::Mat3b shown;
  int pictures = 0;
  for (; reader.read(shown); ++pictures) {
    EXPECT_EQ(shown.size(), cv::Size(62, 48));
    EXPECT_LT(cv::norm(shown(20, 10) - cv::Vec3b(200, 30, 30)), 30);
    EXPECT_LT(cv::norm(shown(20, 50) - cv::Vec3b(30, 30, 200)), 30);
  }
  EXPECT_EQ(pictures, 5);
}

TEST_F(VideoFileTest, ThatIsNotClosedIsRemoved) {
  { const VideoFile video(path(), 16, 16, 25); }
  EXPECT_FALSE(fs::exists(path()));
}

TEST_F(VideoFileTest, WithoutAPlaceIsAnIoError) {
  EXPECT_THROW(VideoFile((directory_ / "no" / "video.mp4").string(), 16, 16, 25), IoError);
}

TEST_F(VideoFileTest, NeedsFfmpeg) {
  const std::string programs = std::getenv("PATH");
  ::setenv("PATH", directory_.path().c_str(), 1);
  EXPECT_THAT([this] { VideoFile(path(), 16, 16, 25); },
              ::testing::ThrowsMessage<IoError>(::testing::HasSubstr("the program ffmpeg")));
  ::setenv("PATH", programs.c_str(), 1);
}

}  // namespace
}  // namespace dodgesim

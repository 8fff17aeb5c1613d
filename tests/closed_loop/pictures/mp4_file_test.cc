#include "sim/files/mp4_file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>

#include "sim/base/error.h"
#include "tests/closed_loop/pictures/decoded.h"
#include "tests/sim/files/temporary_directory.h"

namespace dodgesim {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;

class Mp4FileTest : public ::testing::Test {
 protected:
  std::string path() const { return (directory_ / "video.mp4").string(); }

  const testing::TemporaryDirectory directory_;
};

// Left half blue, right half red; sides that H.264 does not take as they are.
TEST_F(Mp4FileTest, ShowsThePicturesInTheirColours) {
  cv::Mat3b picture(47, 61, cv::Vec3b(200, 30, 30));
  picture.colRange(31, 61).setTo(cv::Vec3b(30, 30, 200));
  Mp4File video(path(), picture.cols, picture.rows, 12.5);
  for (int i = 0; i < 5; ++i) video.write(picture.data);
  video.close();
  EXPECT_EQ(testing::pictures_per_s(path()), 12.5);
  const std::vector<cv::Mat3b> pictures = testing::decoded(path());
  for (const cv::Mat3b& shown : pictures) {
    EXPECT_EQ(shown.size(), cv::Size(62, 48));
    EXPECT_LT(cv::norm(shown(20, 10) - cv::Vec3b(200, 30, 30)), 30);
    EXPECT_LT(cv::norm(shown(20, 50) - cv::Vec3b(30, 30, 200)), 30);
  }
  EXPECT_EQ(pictures.size(), 5u);
}

TEST_F(Mp4FileTest, ThatIsNotClosedIsRemoved) {
  { const Mp4File video(path(), 16, 16, 25); }
  EXPECT_TRUE(fs::is_empty(directory_.path()));
  testing::put(path(), "an earlier video");
  { const Mp4File video(path(), 16, 16, 25); }
  EXPECT_EQ(testing::contents(path()), "an earlier video");
}

TEST_F(Mp4FileTest, WithoutAPlaceIsAnIoError) {
  EXPECT_THROW(Mp4File((directory_ / "no" / "video.mp4").string(), 16, 16, 25), IoError);
}

// Only these programs are there.
class Programs {
 public:
  explicit Programs(const std::string& folder) {
    const char* before = std::getenv("PATH");
    if (before != nullptr) before_ = before;
    ::setenv("PATH", folder.c_str(), 1);
  }
  ~Programs() { ::setenv("PATH", before_.c_str(), 1); }
  Programs(const Programs&) = delete;
  Programs& operator=(const Programs&) = delete;

 private:
  std::string before_;
};

TEST_F(Mp4FileTest, NeedsFfmpeg) {
  const Programs none(directory_.path().string());
  EXPECT_THAT([this] { Mp4File(path(), 16, 16, 25); },
              ::testing::ThrowsMessage<IoError>(::testing::AllOf(
                  HasSubstr("The video " + path()), HasSubstr("the program ffmpeg is needed"))));
  EXPECT_TRUE(fs::is_empty(directory_.path()));
}

TEST_F(Mp4FileTest, SaysWhatFfmpegSays) {
  std::ofstream(directory_ / "ffmpeg")
      << "#!/bin/sh\necho first >&2\necho no such codec >&2\nexit 1\n";
  fs::permissions(directory_ / "ffmpeg", fs::perms::owner_all);
  const Programs broken(directory_.path().string());
  const std::vector<std::uint8_t> picture(3 * 16 * 16);
  Mp4File video(path(), 16, 16, 25);
  EXPECT_THAT(
      [&] {
        for (;;) video.write(picture.data());
      },
      ::testing::ThrowsMessage<IoError>("The video " + path() +
                                        " could not be written by ffmpeg: no such codec."));
  EXPECT_THROW(video.close(), IoError);
}

}  // namespace
}  // namespace dodgesim

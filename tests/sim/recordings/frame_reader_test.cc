#include "sim/recordings/frame_reader.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>

#include <limits>

#include "sim/base/error.h"
#include "tests/complaint.h"
#include "tests/sim/files/video_files.h"

namespace dodgesim {
namespace {

using testing::bytes_of;
using testing::complaint;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using testing::header;
using testing::npy;
using testing::npy_array;
using testing::put;
using ::testing::StartsWith;
using testing::TemporaryDirectory;

using Floats = std::vector<float>;
using Times = std::vector<std::int64_t>;

class FrameReaderTest : public ::testing::Test {
 protected:
  std::string frames_file(const std::string& bytes) { return put(root_ / "f.npy", bytes); }
  std::string times_file(const std::string& bytes) { return put(root_ / "t.npy", bytes); }

  // Both files, with two frames of 1 x 2 px in place of what is not given.
  const Floats four_ = {0.5f, 1, 2, 0};
  const std::string good_frames_ = npy_array("<f4", four_, 1, 2);
  const std::string good_times_ = npy_array("<i8", Times{10, 20});

  // Everything that is there to be complained about, up to the last picture.
  template <class Error = ScenarioError>
  std::string refusal(const std::string& frames, const std::string& times) {
    return complaint<Error>([&] {
      FrameReader video(frames_file(frames), times_file(times));
      TimeUs t_us = 0;
      Floats luminance;
      while (video.next(t_us, luminance)) continue;
    });
  }
  void expect_bad_frames(const std::string& frames, const std::string& message) {
    const std::string refused = refusal(frames, good_times_);
    EXPECT_THAT(refused, StartsWith((root_ / "f.npy").string() + " "));
    EXPECT_THAT(refused, HasSubstr(message));
  }
  void expect_bad_times(const std::string& times, const std::string& message) {
    const std::string refused = refusal(good_frames_, times);
    EXPECT_THAT(refused, StartsWith((root_ / "t.npy").string() + " "));
    EXPECT_THAT(refused, HasSubstr(message));
  }

  TemporaryDirectory root_;
};

TEST_F(FrameReaderTest, ReadsFloatsOfEveryVersionOfTheFormat) {
  for (const int version : {1, 2, 3}) {
    const Floats values = {0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 1e30f};
    FrameReader video(frames_file(npy(version, header("<f4", "(2, 2, 3)"), bytes_of(values))),
                      times_file(npy(version, header("<i8", "(2,)"), bytes_of(Times{-5, 7}))));
    EXPECT_EQ(video.frame_count(), 2);
    EXPECT_EQ(video.height(), 2);
    EXPECT_EQ(video.width(), 3);
    EXPECT_EQ(video.first_us(), -5);
    EXPECT_EQ(video.duration_us(), 12);
    TimeUs t_us = -1;
    Floats luminance;
    ASSERT_TRUE(video.next(t_us, luminance));
    EXPECT_EQ(t_us, 0);
    EXPECT_THAT(luminance, ElementsAre(0, 1, 2, 3, 4, 5));
    ASSERT_TRUE(video.next(t_us, luminance));
    EXPECT_EQ(t_us, 12) << "from the first picture";
    EXPECT_THAT(luminance, ElementsAre(6, 7, 8, 9, 10, 1e30f));
    EXPECT_FALSE(video.next(t_us, luminance));
  }
}

TEST_F(FrameReaderTest, TakesBytesAsShares) {
  FrameReader video(frames_file(npy_array("|u1", std::vector<std::uint8_t>{0, 1, 128, 255}, 1, 2)),
                    times_file(good_times_));
  TimeUs t_us = 0;
  Floats luminance;
  ASSERT_TRUE(video.next(t_us, luminance));
  EXPECT_THAT(luminance, ElementsAre(0.0f, 1 / 255.0f));
  ASSERT_TRUE(video.next(t_us, luminance));
  EXPECT_THAT(luminance, ElementsAre(128 / 255.0f, 1.0f));
}

TEST_F(FrameReaderTest, TakesInstantsFromAnyOrigin) {
  constexpr std::int64_t kNow = 1600000000000000;  // unix time
  constexpr std::int64_t kGap = (std::int64_t{1} << 30) - 1;
  constexpr std::int64_t kLast = std::int64_t{1} << 60;
  EXPECT_EQ(refusal(good_frames_, npy_array("<i8", Times{kNow, kNow + kGap})), "");
  EXPECT_EQ(refusal(good_frames_, npy_array("<i8", Times{-kNow - kGap, -kNow})), "");
  EXPECT_EQ(refusal(good_frames_, npy_array("<i8", Times{-kLast, -kLast + 1})), "");
  EXPECT_EQ(refusal(good_frames_, npy_array("<i8", Times{kLast - 1, kLast})), "");
}

TEST_F(FrameReaderTest, RefusesFilesThatAreNoArrays) {
  expect_bad_frames("", "is not a .npy file");
  expect_bad_frames("\x93NUMP", "is not a .npy file");
  expect_bad_frames("PK\x03\x04 an .npz file", "is not a .npy file");
  expect_bad_frames(npy(4, header("<f4", "(2, 1, 2)"), bytes_of(four_)), "is of version 4");
  expect_bad_frames(good_frames_.substr(0, 9), "is truncated within its header");
  expect_bad_frames(good_frames_.substr(0, 40), "is truncated within its header");
  expect_bad_frames(npy(1, "{'descr': '<f4'}", ""), "has a header that cannot be read: ");
  expect_bad_frames(npy(2, std::string(100000, ' '), ""), "has a header of 100000 bytes");
}

TEST_F(FrameReaderTest, RefusesOtherTypesAndOrders) {
  const std::string doubles(4 * 8, '\0');
  expect_bad_frames(npy(1, header("<f8", "(2, 1, 2)"), doubles),
                    "holds dtype '<f8', but frames must be float32 ('<f4', linear luminance) or");
  expect_bad_frames(npy(1, header(">f4", "(2, 1, 2)"), bytes_of(four_)),
                    "holds dtype '>f4' (big-endian), but");
  expect_bad_frames(npy(1, header("<f4", "(2, 1, 2)", "True"), bytes_of(four_)),
                    "is in Fortran order");
  expect_bad_frames(npy(1, "{'descr': [('a', '<f4')], 'fortran_order': False, 'shape': (2, 1, 2)}",
                        bytes_of(four_)),
                    "holds records [('a', '<f4')], but");
  expect_bad_times(npy(1, header("<f8", "(2,)"), std::string(16, '\0')),
                   "holds dtype '<f8', but time stamps must be int64 ('<i8') microseconds");
  expect_bad_times(npy(1, header(">i8", "(2,)"), std::string(16, '\0')), "(big-endian)");
}

TEST_F(FrameReaderTest, RefusesOtherShapes) {
  const std::string bytes = bytes_of(four_);
  expect_bad_frames(npy(1, header("<f4", "(4,)"), bytes), "has the shape (4,), but frames must be");
  expect_bad_frames(npy(1, header("<f4", "(2, 1, 2, 1)"), bytes), "has the shape (2, 1, 2, 1)");
  expect_bad_frames(npy(1, header("<f4", "(0, 1, 2)"), ""), "at least two frames");
  expect_bad_frames(npy(1, header("<f4", "(1, 2, 2)"), bytes), "at least two frames");
  expect_bad_frames(npy(1, header("<f4", "(2, 0, 2)"), ""), "have no pixels");
  expect_bad_frames(npy(1, header("|u1", "(2, 1, 4097)"), std::string(2 * 4097, '\0')),
                    "up to 4096 rows and columns");
  expect_bad_times(npy_array("<i8", Times{1, 2, 3}), "has the shape (3,), but ");
  expect_bad_times(npy_array("<i8", Times{1}), "has 2 frames: (2,) is needed");
  expect_bad_times(npy_array("<i8", Times{1, 2}, 1, 1), "has the shape (2, 1, 1)");
}

TEST_F(FrameReaderTest, RefusesFilesOfAnotherSize) {
  expect_bad_frames(good_frames_.substr(0, good_frames_.size() - 1),
                    "is truncated: its array of shape (2, 1, 2) needs 16 bytes, but 15 bytes");
  expect_bad_frames(good_frames_ + "\n", "holds 1 byte too many");
  expect_bad_frames(npy(1, header("<f4", "(9223372036854775807, 9, 9)"), "abc"),
                    "is truncated: its array of shape (9223372036854775807, 9, 9) needs more");
  expect_bad_times(good_times_ + "more", "holds 4 bytes too many");
  expect_bad_times(good_times_.substr(0, good_times_.size() - 8), "is truncated");
}

TEST_F(FrameReaderTest, RefusesLuminanceThatIsNone) {
  const float nan = std::numeric_limits<float>::quiet_NaN();
  const float infinity = std::numeric_limits<float>::infinity();
  for (const float bad : {nan, infinity, -infinity, -1e-30f}) {
    expect_bad_frames(npy_array("<f4", Floats{1, 2, 3, 4, bad, 6, 7, 8}, 2, 2),
                      " in frame 1, row 0, column 0, but luminance must be finite and not");
    expect_bad_frames(npy_array("<f4", Floats{1, 2, 3, bad, 5, 6, 7, 8}, 2, 2),
                      " in frame 0, row 1, column 1, but luminance");
  }
  EXPECT_EQ(refusal(npy_array("<f4", Floats{1, 2, 3, -0.0f}, 1, 2), good_times_), "");
}

TEST_F(FrameReaderTest, RefusesInstantsThatDoNotIncreaseOrJump) {
  expect_bad_times(npy_array("<i8", Times{5, 5}),
                   "does not increase: time stamp 1 (5 us) does not follow 5 us");
  expect_bad_times(npy_array("<i8", Times{5, -5}), "does not increase");
  expect_bad_times(npy_array("<i8", Times{0, std::int64_t{1} << 30}),
                   "follows 0 us by more than 1073741823 us");
  expect_bad_times(npy_array("<i8", Times{INT64_MIN, INT64_MAX}), "has a gap");
  expect_bad_times(npy_array("<i8", Times{1600000000000000000, 1600000000001000000}),
                   "are these nanoseconds?");
  expect_bad_times(npy_array("<i8", Times{INT64_MIN, INT64_MIN + 1}), "within 2^60 us of 0");
}

TEST_F(FrameReaderTest, ReportsWhatTheSystemRefuses) {
  frames_file(good_frames_);
  times_file(good_times_);
  const std::string frames = (root_ / "f.npy").string();
  const std::string none = (root_ / "none.npy").string();
  EXPECT_EQ(complaint<IoError>([&] { FrameReader(none, frames); }),
            none + " could not be opened: No such file or directory.");
  EXPECT_EQ(complaint<IoError>([&] { FrameReader(frames, none); }),
            none + " could not be opened: No such file or directory.");
  const std::string directory = root_.path().string();
  EXPECT_EQ(complaint<ScenarioError>([&] { FrameReader(directory, frames); }),
            directory + " is not a regular file, which an array must be.");
  const std::string pipe = (root_ / "pipe").string();
  ASSERT_EQ(::mkfifo(pipe.c_str(), 0600), 0);
  EXPECT_THAT(complaint<ScenarioError>([&] { FrameReader(pipe, frames); }),
              HasSubstr("is not a regular file"));
}

TEST_F(FrameReaderTest, NoticesAFileThatShrinks) {
  const std::string path = frames_file(npy_array("<f4", Floats(100000, 1.0f), 100, 500));
  FrameReader video(path, times_file(good_times_));
  std::filesystem::resize_file(path, 1000);
  TimeUs t_us = 0;
  Floats luminance;
  EXPECT_THAT(complaint<IoError>([&] {
                video.next(t_us, luminance);
                video.next(t_us, luminance);
              }),
              HasSubstr("it became shorter meanwhile"));
}

}  // namespace
}  // namespace dodgesim

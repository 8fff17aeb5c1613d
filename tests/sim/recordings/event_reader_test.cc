// What event_writer.h writes reads back; files of other programs; and files that are none.
#include "sim/recordings/event_reader.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <limits>
#include <vector>

#include "sim/base/error.h"
#include "tests/complaint.h"
#include "tests/sim/files/temporary_directory.h"
#include "tests/sim/recordings/random_events.h"
#include "tests/sim/recordings/read_events.h"

namespace dodgesim {
namespace {

using ::testing::AllOf;
using testing::complaint;
using testing::contents;
using ::testing::ElementsAre;
using ::testing::EndsWith;
using testing::Events;
using ::testing::HasSubstr;
using testing::put;
using testing::random_recording;
using testing::read_events;
using testing::recording_of;
using testing::TemporaryDirectory;

class Reading : public ::testing::Test {
 protected:
  std::string file(const std::string& name, const std::string& bytes) const {
    return put(root_ / name, bytes);
  }
  // Of reading all of that file.
  std::string refusal(const std::string& name, const std::string& bytes) const {
    const std::string path = file(name, bytes);
    return complaint<ScenarioError>([&] { read_events(path); });
  }

  TemporaryDirectory root_;
};

class WrittenRecording : public Reading,
                         public ::testing::WithParamInterface<std::pair<const char*, std::size_t>> {
};

// Around the sizes of a reader's portions.
INSTANTIATE_TEST_SUITE_P(Formats, WrittenRecording,
                         ::testing::Values(std::pair("e.h5", 0), std::pair("e.h5", 32768),
                                           std::pair("e.h5", 70001), std::pair("e.npy", 0),
                                           std::pair("e.npy", 16384), std::pair("e.npy", 40001),
                                           std::pair("e.txt", 0), std::pair("e.txt", 16384),
                                           std::pair("e.txt", 40001), std::pair("e.raw", 0),
                                           std::pair("e.raw", 16384), std::pair("e.raw", 40001)));

TEST_P(WrittenRecording, ReadsBackOnTheClockOfItsOffset) {
  const auto& [name, count] = GetParam();
  const TimeUs offset_us = 1600000000000000;
  Events events = random_recording(count, 7 + count);
  Recording recording = recording_of(events, offset_us);
  for (const bool has_causes : {false, true}) {
    recording.has_causes = has_causes;
    const auto writer = make_event_writer(root_ / name, recording);
    const std::vector<Cause> causes(has_causes ? events.size() : 0, Cause{254});
    writer->add(events, causes);
    writer->commit();
    Events expected = events;
    for (Event& event : expected) event.t_us += offset_us;
    EXPECT_TRUE(read_events(root_ / name) == expected) << has_causes;
  }
}

TEST_F(Reading, TextMayBeInSecondsAndHaveRemarks) {
  EXPECT_THAT(read_events(file("e.txt", "# t x y p\n0.000009 59 32 1\n12.5 0 479 0\n")),
              ElementsAre(Event{9, 59, 32, 1}, Event{12500000, 0, 479, -1}));
  // A fraction tells, in whatever line and however it is written.
  EXPECT_THAT(read_events(file("f.txt", "9 59 32 1\n12.5 0 479 0\n")),
              ElementsAre(Event{9000000, 59, 32, 1}, Event{12500000, 0, 479, -1}));
  EXPECT_THAT(read_events(file("g.txt", "1e-05 1 2 1\n1.4999999999999999e-05 3 4 0\n")),
              ElementsAre(Event{10, 1, 2, 1}, Event{15, 3, 4, -1}));
}

TEST_F(Reading, TextMayBeginWithTheSizeOfTheImage) {
  EXPECT_THAT(read_events(file("e.txt", "640 480\n0.000009 59 32 1\n")),
              ElementsAre(Event{9, 59, 32, 1}));
  EXPECT_THAT(read_events(file("f.txt", "# of E2VID\n640 480\n9 59 32 1\n")),
              ElementsAre(Event{9, 59, 32, 1}));
  EXPECT_THAT(refusal("g.txt", "240 180\n0.000009 59 32 1\n"),
              EndsWith("g.txt:1: the image is 240 x 180, but the calibration says 640 x 480."));
  EXPECT_THAT(refusal("h.txt", "9 59 32 1\n640 480\n"), HasSubstr("h.txt:2: y is missing"));
  EXPECT_THAT(refusal("i.csv", "t_us,x,y,p\n640,480\n"), HasSubstr("i.csv:2: y is missing"));
}

TEST_F(Reading, TextInWholeMicrosecondsMayHaveTheirPoint) {
  EXPECT_THAT(read_events(file("e.txt", "6.6e+05 1.25e+02 1.07e+02 1.0\n660001.000 5 190 0.0\n")),
              ElementsAre(Event{660000, 125, 107, 1}, Event{660001, 5, 190, -1}));
  // After the first 16,384 events the unit is settled.
  std::string whole;
  for (int i = 0; i < 16384; ++i) whole += std::to_string(i) + " 1 2 1\n";
  EXPECT_THAT(refusal("f.txt", whole + "16384.5 1 2 1\n"),
              AllOf(HasSubstr("f.txt:16385: t is \"16384.5\""), HasSubstr("whole number")));
}

TEST_F(Reading, ColumnsOfCsvMayStandInAnyOrder) {
  EXPECT_THAT(read_events(file("e.csv", "x, y,p,t_us,label\r\n3,4,1,17,ball\r\n5,6,-1,18,\r\n")),
              ElementsAre(Event{17, 3, 4, 1}, Event{18, 5, 6, -1}));
}

TEST_F(Reading, KeepsTheOrderOfTheFile) {
  EXPECT_THAT(read_events(file("e.csv", "t_us,x,y,p\n9,1,1,1\n7,2,2,0\n")),
              ElementsAre(Event{9, 1, 1, 1}, Event{7, 2, 2, -1}));
}

TEST_F(Reading, SaysInWhichLineAnEventIsNone) {
  EXPECT_THAT(refusal("e.csv", "t_us,x,y,p\n1,2,3,1\n1,640,3,1\n"),
              HasSubstr("e.csv:3: x is 640, but must be from 0 to 639."));
  EXPECT_THAT(refusal("e.csv", "t_us,x,y,p\n1,2,-1,1\n"), HasSubstr("y is -1"));
  EXPECT_THAT(refusal("e.csv", "t_us,x,y,p\n1,2,3,2\n"), HasSubstr("p is 2"));
  EXPECT_THAT(refusal("e.csv", "t_us,x,y,p\n-1,2,3,1\n"), HasSubstr("t [us] is -1"));
  EXPECT_THAT(refusal("e.csv", "t_us,x,y,p\n1700000000000000000,2,3,1\n"),
              HasSubstr("Are these nanoseconds?"));
  EXPECT_THAT(refusal("e.csv", "t_us,x,y,p\n1,2,3\n"), HasSubstr("e.csv:2: p is missing"));
  EXPECT_THAT(refusal("e.csv", "t_us,x,y,p\n1,2,3,0.1\n"), HasSubstr("p is \"0.1\""));
  EXPECT_THAT(refusal("e.csv", "t,x,y,p\n1,2,3,1\n"), HasSubstr("there is no column t_us"));
  EXPECT_THAT(refusal("e.csv", ""), HasSubstr("is empty"));
  EXPECT_THAT(refusal("e.txt", "1 2 3 1\n\n1 2 x 1\n"), HasSubstr("e.txt:3: y is \"x\""));
  EXPECT_THAT(refusal("e.txt", "0.5 2 3 1\n1e30 2 3 1\n"), HasSubstr("e.txt:2: t is \"1e30\""));
  EXPECT_THAT(refusal("e.dat", ""), EndsWith("decides on the format of the events."));
}

TEST_F(Reading, SaysWhichEventOfABinaryFileIsNone) {
  Events events = random_recording(20000, 3);
  events[17000].y = 480;
  for (const char* name : {"e.npy", "e.h5", "e.raw"}) {
    testing::write(root_ / name, recording_of(events), events);
    EXPECT_THAT(
        complaint<ScenarioError>([&] { read_events(root_ / name); }),
        HasSubstr(std::string(name) + ", event 17000: y is 480, but must be from 0 to 479"));
  }
}

// A header and words, little-endian.
template <class Word>
std::string raw(const std::string& header, const std::vector<Word>& words) {
  return header +
         std::string(reinterpret_cast<const char*>(words.data()), words.size() * sizeof(Word));
}

constexpr const char* kEvt2 = "% evt 2.0\n% end\n";
constexpr const char* kEvt3 = "% format EVT3;height=480;width=640\n% end\n";

TEST_F(Reading, TakesEvt2) {
  EXPECT_THAT(
      read_events(file(
          "e.raw",
          raw<std::uint32_t>(kEvt2, {1u << 28 | 5u << 22 | 7u << 11 | 9u,  // before the clock
                                     8u << 28 | 3, 1u << 28 | 5u << 22 | 7u << 11 | 9u,
                                     0xau << 28 | 1, 0xeu << 28, 63u << 22 | 639u << 11 | 479u}))),
      ElementsAre(Event{3 * 64 + 5, 7, 9, 1}, Event{3 * 64 + 63, 639, 479, -1}));
}

TEST_F(Reading, TakesEvt3) {
  EXPECT_THAT(
      read_events(file("e.raw", raw<std::uint16_t>(kEvt3, {0x2805,  // before the clock
                                                           0x8001, 0x6010, 0x0009, 0x2807,  // ON
                                                           0x8001,                          // again
                                                           0x2008, 0xa101, 0xe001,          // OFF
                                                           0x3864, 0x4801, 0x5082,  // 100 to 119
                                                           0x8002, 0x0809, 0x2001, 0x1004, 0x2002,
                                                           0x3003, 0x4001, 0x0003, 0x2004}))),
      ElementsAre(Event{4112, 7, 9, 1}, Event{4112, 8, 9, -1}, Event{4112, 100, 9, 1},
                  Event{4112, 111, 9, 1}, Event{4112, 113, 9, 1}, Event{4112, 119, 9, 1},
                  Event{8192, 1, 9, -1},    // the lower bits begin anew; row of the second camera
                  Event{8192, 4, 3, -1}));  // what stands in the row of grey levels is none
}

TEST_F(Reading, CountsHowOftenTheClockOfRawHasWrapped) {
  EXPECT_THAT(
      read_events(file("e.raw", raw<std::uint16_t>(kEvt3, {0x8fff, 0x6fff, 0x0001, 0x2001, 0x8000,
                                                           0x2001, 0x8fff, 0x8001, 0x2001}))),
      ElementsAre(Event{(1 << 24) - 1, 1, 1, -1}, Event{1 << 24, 1, 1, -1},
                  Event{(2 << 24) + 4096, 1, 1, -1}));
  // A word of the clock that comes a little late is no turn.
  EXPECT_THAT(
      read_events(file("f.raw", raw<std::uint32_t>(kEvt2, {8u << 28 | 0xfffffff, 1, 8u << 28, 1,
                                                           8u << 28 | 5, 1, 8u << 28 | 4, 1}))),
      ElementsAre(Event{(TimeUs{1} << 34) - 64, 0, 1, -1}, Event{TimeUs{1} << 34, 0, 1, -1},
                  Event{(TimeUs{1} << 34) + 320, 0, 1, -1},
                  Event{(TimeUs{1} << 34) + 256, 0, 1, -1}));
}

TEST_F(Reading, TakesHeadersOfRawWithAndWithoutAnEnd) {
  const std::vector<std::uint32_t> words = {8u << 28 | 0x25, 1u << 28 | 2u << 11 | 3u};  // "%..."
  for (const char* header :
       {"% date 2014-02-28\n% evt 2.0\n% geometry 640x480\n", "% evt 2.0\n% end\n",
        "% evt 2.0\n% format EVT2;height=480;width=640\n% generation 3.1\n% end\n"}) {
    EXPECT_THAT(read_events(file("e.raw", raw(header, words))),
                ElementsAre(Event{0x25 * 64, 2, 3, 1}));
  }
  // A word that was cut.
  EXPECT_THAT(read_events(file("e.raw", raw(kEvt2, words) + "abc")),
              ElementsAre(Event{0x25 * 64, 2, 3, 1}));
}

TEST_F(Reading, RefusesRawOfAnotherImageOrFormat) {
  const std::vector<std::uint16_t> words = {0x8000, 0x6000, 0x0000, 0x2000};
  const auto refused = [&](const std::string& header) {
    return refusal("e.raw", raw(header, words));
  };
  EXPECT_THAT(refused("% format EVT3;height=720;width=640\n% end\n"),
              HasSubstr("its header says height 720, but the calibration says 480."));
  EXPECT_THAT(refused("% evt 3.0\n% geometry 1280x480\n% end\n"),
              HasSubstr("its header says width 1280, but the calibration says 640."));
  EXPECT_THAT(refused("% format EVT21;height=480;width=640\n% end\n"),
              HasSubstr("must have a header that names the format EVT2 or EVT3, but names EVT21."));
  EXPECT_THAT(refused("% evt 2.1\n% geometry 640x480\n% end\n"), HasSubstr("but names EVT2.1."));
  EXPECT_THAT(refused(""), HasSubstr("but names none."));
  EXPECT_THAT(refused(std::string("% ") + std::string(5000, 'x')), HasSubstr("but names none."));
  EXPECT_THAT(refused("% evt 3.0\n% t_offset_us 9000000000000000000\n% end\n"),
              HasSubstr("t_offset_us 9000000000000000000"));
  // An event beside the image, of a header that does not say how large it is.
  EXPECT_THAT(
      refusal("e.raw", raw<std::uint16_t>("% evt 3.0\n% end\n", {0x8000, 0x6000, 0x0000, 0x2281})),
      HasSubstr("e.raw, event 0: x is 641, but must be from 0 to 639."));
}

TEST_F(Reading, SaysThatAFileIsCutOrAbsent) {
  const Events events = random_recording(90000, 6);
  testing::write(root_ / "e.h5", recording_of(events), events);
  const std::string whole = contents(root_ / "e.h5");
  put(root_ / "cut.h5", whole.substr(0, whole.size() / 2));
  EXPECT_THROW(read_events(root_ / "cut.h5"), std::runtime_error);
  for (const char* name : {"none.h5", "none.txt", "none.csv", "none.raw"}) {
    EXPECT_THAT(complaint<IoError>([&] { read_events(root_ / name); }), HasSubstr(name));
  }
}

}  // namespace
}  // namespace dodgesim

// What event_writer.h writes reads back; files of other programs; and files that are none.
#include "sim/recordings/event_reader.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <hdf5.h>

#include <filesystem>
#include <fstream>

#include "sim/base/error.h"
#include "tests/sim/files/temporary_directory.h"
#include "tests/sim/recordings/random_events.h"

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
using testing::random_events;
using testing::recording_of;
using testing::TemporaryDirectory;

constexpr ImageSize kImage = {640, 480};

Events all(EventReader& reader) {
  Events events;
  for (auto portion = reader.next(); !portion.empty(); portion = reader.next()) {
    events.insert(events.end(), portion.begin(), portion.end());
  }
  return events;
}

Events read(const std::filesystem::path& path, const ImageSize& image = kImage) {
  return all(*open_events(path.string(), image));
}

Events random_recording(std::size_t count, std::uint64_t seed) {
  Events events = random_events(count, seed);
  for (Event& event : events) {
    event.x = static_cast<std::uint16_t>(event.x % kImage.width);
    event.y = static_cast<std::uint16_t>(event.y % kImage.height);
  }
  return events;
}

class Reading : public ::testing::Test {
 protected:
  std::string file(const std::string& name, const std::string& bytes) const {
    return put(root_ / name, bytes);
  }
  // Of reading all of that file.
  std::string refusal(const std::string& name, const std::string& bytes) const {
    const std::string path = file(name, bytes);
    return complaint<ScenarioError>([&] { read(path); });
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
                                           std::pair("e.txt", 40001)));

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
    writer->finish();
    Events expected = events;
    for (Event& event : expected) event.t_us += offset_us;
    EXPECT_TRUE(read(root_ / name) == expected) << has_causes;
  }
}

TEST_F(Reading, TextMayBeInSecondsAndHaveRemarks) {
  EXPECT_THAT(read(file("e.txt", "# t x y p\n0.000009 59 32 1\n12.5 0 479 0\n")),
              ElementsAre(Event{9, 59, 32, 1}, Event{12500000, 0, 479, -1}));
  // Which of the two it is, the first line decides.
  EXPECT_THAT(refusal("f.txt", "9 59 32 1\n12.5 0 479 0\n"),
              AllOf(HasSubstr("f.txt:2: t is \"12.5\""), HasSubstr("whole number")));
}

TEST_F(Reading, ColumnsOfCsvMayStandInAnyOrder) {
  EXPECT_THAT(read(file("e.csv", "x, y,p,t_us,label\r\n3,4,1,17,ball\r\n5,6,-1,18,\r\n")),
              ElementsAre(Event{17, 3, 4, 1}, Event{18, 5, 6, -1}));
}

TEST_F(Reading, KeepsTheOrderOfTheFile) {
  EXPECT_THAT(read(file("e.csv", "t_us,x,y,p\n9,1,1,1\n7,2,2,0\n")),
              ElementsAre(Event{9, 1, 1, 1}, Event{7, 2, 2, -1}));
}

TEST_F(Reading, SaysInWhichLineAnEventIsNone) {
  EXPECT_THAT(refusal("e.csv", "t_us,x,y,p\n1,2,3,1\n1,640,3,1\n"),
              HasSubstr("e.csv:3: x is 640, but must be from 0 to 639."));
  EXPECT_THAT(refusal("e.csv", "t_us,x,y,p\n1,2,-1,1\n"), HasSubstr("y is -1"));
  EXPECT_THAT(refusal("e.csv", "t_us,x,y,p\n1,2,3,2\n"), HasSubstr("p is 2"));
  EXPECT_THAT(refusal("e.csv", "t_us,x,y,p\n-1,2,3,1\n"), HasSubstr("t [us] is -1"));
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
  for (const char* name : {"e.npy", "e.h5"}) {
    testing::write(root_ / name, recording_of(events), events);
    EXPECT_THAT(
        complaint<ScenarioError>([&] { read(root_ / name); }),
        HasSubstr(std::string(name) + ", event 17000: y is 480, but must be from 0 to 479"));
  }
}

TEST_F(Reading, RefusesArraysThatAreNoEvents) {
  const auto front = [](const std::string& descr, const std::string& shape) {
    const std::string header =
        "{'descr': " + descr + ", 'fortran_order': False, 'shape': " + shape + ", }\n";
    return std::string("\x93NUMPY\x01\x00", 8) + static_cast<char>(header.size()) + '\0' + header;
  };
  EXPECT_THAT(refusal("e.npy", front("'<f4'", "(0,)")), HasSubstr("items of <f4"));
  const std::string fields = "[('t', '<i8'), ('x', '<u2'), ('y', '<u2'), ('p', '|i1')]";
  EXPECT_THAT(refusal("e.npy", front(fields, "(0, 2)")), HasSubstr("(0, 2)"));
  EXPECT_NE(refusal("e.npy", front(fields, "(3,)") + std::string(38, '\0')), "");
}

TEST_F(Reading, RefusesHdf5OfAnotherImageOrLayout) {
  const Events events = random_recording(100, 5);
  testing::write(root_ / "e.h5", recording_of(events), events);
  EXPECT_THAT(complaint<ScenarioError>([&] {
                read(root_ / "e.h5", {320, 480});
              }),
              HasSubstr("events/width is 640, but the calibration says 320"));
  EXPECT_THAT(refusal("f.h5", "no HDF5"), HasSubstr("cannot be opened as HDF5"));
  const hid_t empty = H5Fcreate((root_ / "g.h5").c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, H5P_DEFAULT);
  H5Fclose(empty);
  EXPECT_THAT(complaint<ScenarioError>([&] { read(root_ / "g.h5"); }),
              HasSubstr("has no events/t"));
}

TEST_F(Reading, RefusesHdf5WhoseNumbersAreNotWhole) {
  const Events events = random_recording(100, 5);
  testing::write(root_ / "e.h5", recording_of(events), events);
  const hid_t file = H5Fopen((root_ / "e.h5").c_str(), H5F_ACC_RDWR, H5P_DEFAULT);
  H5Ldelete(file, "events/t", H5P_DEFAULT);
  const hsize_t size = events.size();
  const hid_t space = H5Screate_simple(1, &size, nullptr);
  const hid_t seconds =
      H5Dcreate2(file, "events/t", H5T_NATIVE_DOUBLE, space, H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT);
  H5Dclose(seconds);
  H5Sclose(space);
  H5Fclose(file);
  EXPECT_THAT(complaint<ScenarioError>([&] { read(root_ / "e.h5"); }),
              HasSubstr("events/t has no whole numbers"));
}

TEST_F(Reading, SaysThatAFileIsCutOrAbsent) {
  const Events events = random_recording(90000, 6);
  testing::write(root_ / "e.h5", recording_of(events), events);
  const std::string whole = contents(root_ / "e.h5");
  put(root_ / "cut.h5", whole.substr(0, whole.size() / 2));
  EXPECT_THROW(read(root_ / "cut.h5"), std::runtime_error);
  for (const char* name : {"none.h5", "none.txt", "none.csv"}) {
    EXPECT_THAT(complaint<IoError>([&] { read(root_ / name); }), HasSubstr(name));
  }
}

}  // namespace
}  // namespace dodgesim

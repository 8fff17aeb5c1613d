// What event_writer.h writes reads back; files of other programs; and files that are none.
#include "sim/recordings/event_reader.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <hdf5.h>

#include <filesystem>
#include <limits>
#include <vector>

#include "sim/base/error.h"
#include "tests/complaint.h"
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
    EXPECT_TRUE(read(root_ / name) == expected) << has_causes;
  }
}

TEST_F(Reading, TextMayBeInSecondsAndHaveRemarks) {
  EXPECT_THAT(read(file("e.txt", "# t x y p\n0.000009 59 32 1\n12.5 0 479 0\n")),
              ElementsAre(Event{9, 59, 32, 1}, Event{12500000, 0, 479, -1}));
  // A fraction tells, in whatever line and however it is written.
  EXPECT_THAT(read(file("f.txt", "9 59 32 1\n12.5 0 479 0\n")),
              ElementsAre(Event{9000000, 59, 32, 1}, Event{12500000, 0, 479, -1}));
  EXPECT_THAT(read(file("g.txt", "1e-05 1 2 1\n1.4999999999999999e-05 3 4 0\n")),
              ElementsAre(Event{10, 1, 2, 1}, Event{15, 3, 4, -1}));
}

TEST_F(Reading, TextMayBeginWithTheSizeOfTheImage) {
  EXPECT_THAT(read(file("e.txt", "640 480\n0.000009 59 32 1\n")), ElementsAre(Event{9, 59, 32, 1}));
  EXPECT_THAT(read(file("f.txt", "# of E2VID\n640 480\n9 59 32 1\n")),
              ElementsAre(Event{9, 59, 32, 1}));
  EXPECT_THAT(refusal("g.txt", "240 180\n0.000009 59 32 1\n"),
              EndsWith("g.txt:1: the image is 240 x 180, but the calibration says 640 x 480."));
  EXPECT_THAT(refusal("h.txt", "9 59 32 1\n640 480\n"), HasSubstr("h.txt:2: y is missing"));
  EXPECT_THAT(refusal("i.csv", "t_us,x,y,p\n640,480\n"), HasSubstr("i.csv:2: y is missing"));
}

TEST_F(Reading, TextInWholeMicrosecondsMayHaveTheirPoint) {
  EXPECT_THAT(read(file("e.txt", "6.6e+05 1.25e+02 1.07e+02 1.0\n660001.000 5 190 0.0\n")),
              ElementsAre(Event{660000, 125, 107, 1}, Event{660001, 5, 190, -1}));
  // After the first 16,384 events the unit is settled.
  std::string whole;
  for (int i = 0; i < 16384; ++i) whole += std::to_string(i) + " 1 2 1\n";
  EXPECT_THAT(refusal("f.txt", whole + "16384.5 1 2 1\n"),
              AllOf(HasSubstr("f.txt:16385: t is \"16384.5\""), HasSubstr("whole number")));
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
        complaint<ScenarioError>([&] { read(root_ / name); }),
        HasSubstr(std::string(name) + ", event 17000: y is 480, but must be from 0 to 479"));
  }
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

// A file of HDF5 under construction.
class Hdf5Writer {
 public:
  explicit Hdf5Writer(const std::filesystem::path& path)
      : file_(H5Fcreate(path.c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, H5P_DEFAULT)) {}
  Hdf5Writer(const Hdf5Writer&) = delete;
  Hdf5Writer& operator=(const Hdf5Writer&) = delete;
  ~Hdf5Writer() { H5Fclose(file_); }

  // `name` may be "group/name" of a new group. With more than one column, a table.
  template <class Value>
  void list(const std::string& name, hid_t type, const std::vector<Value>& values,
            hsize_t columns = 1) {
    const hsize_t size[] = {values.size() / columns, columns};
    const hid_t space = H5Screate_simple(columns == 1 ? 1 : 2, size, nullptr);
    const hid_t links = H5Pcreate(H5P_LINK_CREATE);
    H5Pset_create_intermediate_group(links, 1);
    const hid_t set = H5Dcreate2(file_, name.c_str(), type, space, links, H5P_DEFAULT, H5P_DEFAULT);
    H5Dwrite(set, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data());
    H5Dclose(set);
    H5Pclose(links);
    H5Sclose(space);
  }

  // t, x, y and p below a prefix.
  void lists(const std::string& prefix, const std::vector<std::int64_t>& t) {
    list(prefix + "t", H5T_NATIVE_INT64, t);
    list<std::uint16_t>(prefix + "x", H5T_NATIVE_UINT16, {1, 2});
    list<std::uint16_t>(prefix + "y", H5T_NATIVE_UINT16, {3, 4});
    list<std::uint8_t>(prefix + "p", H5T_NATIVE_UINT8, {1, 0});
  }

 private:
  hid_t file_;
};

// As Prophesee has them.
struct Record {
  std::uint16_t x, y;
  std::int16_t p;
  std::int64_t t;
};

void put_records(const std::filesystem::path& path, const std::string& name,
                 const std::vector<Record>& records, hid_t type_of_t = H5T_NATIVE_INT64) {
  const hid_t type = H5Tcreate(H5T_COMPOUND, sizeof(Record));
  H5Tinsert(type, "x", HOFFSET(Record, x), H5T_NATIVE_UINT16);
  H5Tinsert(type, "y", HOFFSET(Record, y), H5T_NATIVE_UINT16);
  H5Tinsert(type, "p", HOFFSET(Record, p), H5T_NATIVE_INT16);
  H5Tinsert(type, "t", HOFFSET(Record, t), type_of_t);
  Hdf5Writer(path).list(name, type, records);
  H5Tclose(type);
}

TEST_F(Reading, TakesHdf5OfSeveralLayouts) {
  const std::string path = root_ / "e.h5";
  const auto expected = ElementsAre(Event{7, 1, 3, 1}, Event{8, 2, 4, -1});
  for (const char* prefix : {"events/", ""}) {
    Hdf5Writer(path).lists(prefix, {7, 8});
    EXPECT_THAT(read(path), expected) << prefix;
  }
  for (const char* name : {"CD/events", "events"}) {
    put_records(path, name, {{1, 3, 1, 7}, {2, 4, 0, 8}});
    EXPECT_THAT(read(path), expected) << name;
  }
  Hdf5Writer(path).list<std::uint32_t>("events", H5T_NATIVE_UINT32, {7, 1, 3, 1, 8, 2, 4, 0}, 4);
  EXPECT_THAT(read(path), expected);
}

TEST_F(Reading, TakesHdf5sOffsetIfItIsWhole) {
  const std::string path = root_ / "e.h5";
  const auto with_offset = [&path](hid_t type, const auto& offset) {
    Hdf5Writer file(path);
    file.lists("events/", {7, 8});
    file.list("t_offset", type, std::vector{offset});
  };
  with_offset(H5T_NATIVE_DOUBLE, 1e9);
  EXPECT_THAT(read(path),
              ElementsAre(Event{1'000'000'007, 1, 3, 1}, Event{1'000'000'008, 2, 4, -1}));
  const auto refused = [&path] { return complaint<ScenarioError>([&] { read(path); }); };
  with_offset(H5T_NATIVE_DOUBLE, 0.25);
  EXPECT_THAT(refused(), HasSubstr("t_offset must be one whole number"));
  with_offset(H5T_NATIVE_DOUBLE, std::nan(""));
  EXPECT_THAT(refused(), HasSubstr("t_offset must be one whole number"));
  const std::string range = ", but must be from -1152921504606846976 to 1152921504606846976 us";
  with_offset(H5T_NATIVE_INT64, std::int64_t{1700000000000000000});
  EXPECT_EQ(refused(),
            path + ": t_offset is 1700000000000000000" + range + ": are these nanoseconds?");
  with_offset(H5T_NATIVE_INT64, std::numeric_limits<std::int64_t>::min());
  EXPECT_THAT(refused(), HasSubstr("t_offset is -9223372036854775808" + range));
  with_offset(H5T_NATIVE_UINT64, std::numeric_limits<std::uint64_t>::max());
  EXPECT_THAT(refused(), HasSubstr("t_offset is 18446744073709551615" + range));
}

TEST_F(Reading, RefusesHdf5WhoseNumbersAreNotWhole) {
  const std::string path = root_ / "e.h5";
  const auto refused = [&path] { return complaint<ScenarioError>([&] { read(path); }); };
  Hdf5Writer(path).list<double>("events/t", H5T_NATIVE_DOUBLE, {0.5, 0.6});
  EXPECT_THAT(refused(), HasSubstr("events/t has no whole numbers"));
  put_records(path, "CD/events", {{1, 3, 1, 7}}, H5T_NATIVE_DOUBLE);
  EXPECT_THAT(refused(), HasSubstr("CD/events, t has no whole numbers"));
  Hdf5Writer(path).list<double>("events", H5T_NATIVE_DOUBLE, {0.5, 0.6});
  EXPECT_THAT(refused(), HasSubstr("events has no field t"));
  Hdf5Writer(path).list<float>("events", H5T_NATIVE_FLOAT, {7, 1, 3, 1, 8, 2, 4, 0}, 4);
  EXPECT_THAT(refused(), HasSubstr("events, t has no whole numbers"));
  Hdf5Writer(path).list<int>("events/t", H5T_NATIVE_INT, {7, 1, 3, 1, 8, 2, 4, 0}, 4);
  EXPECT_THAT(refused(), HasSubstr("events/t must be a list"));
  Hdf5Writer(path).lists("events/", {std::numeric_limits<std::int64_t>::max(), 8});
  EXPECT_THAT(refused(), HasSubstr("event 0: t [us] is"));
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
      read(file("e.raw", raw<std::uint32_t>(
                             kEvt2, {1u << 28 | 5u << 22 | 7u << 11 | 9u,  // before the clock
                                     8u << 28 | 3, 1u << 28 | 5u << 22 | 7u << 11 | 9u,
                                     0xau << 28 | 1, 0xeu << 28, 63u << 22 | 639u << 11 | 479u}))),
      ElementsAre(Event{3 * 64 + 5, 7, 9, 1}, Event{3 * 64 + 63, 639, 479, -1}));
}

TEST_F(Reading, TakesEvt3) {
  EXPECT_THAT(
      read(file("e.raw", raw<std::uint16_t>(kEvt3, {0x2805,  // before the clock
                                                    0x8001, 0x6010, 0x0009, 0x2807,  // ON
                                                    0x8001,                          // again
                                                    0x2008, 0xa101, 0xe001,          // OFF
                                                    0x3864, 0x4801, 0x5082,          // 100 to 119
                                                    0x8002, 0x0809, 0x2001, 0x1004, 0x2002,
                                                    0x3003, 0x4001, 0x0003, 0x2004}))),
      ElementsAre(Event{4112, 7, 9, 1}, Event{4112, 8, 9, -1}, Event{4112, 100, 9, 1},
                  Event{4112, 111, 9, 1}, Event{4112, 113, 9, 1}, Event{4112, 119, 9, 1},
                  Event{8192, 1, 9, -1},    // the lower bits begin anew; row of the second camera
                  Event{8192, 4, 3, -1}));  // what stands in the row of grey levels is none
}

TEST_F(Reading, CountsHowOftenTheClockOfRawHasWrapped) {
  EXPECT_THAT(read(file("e.raw", raw<std::uint16_t>(kEvt3, {0x8fff, 0x6fff, 0x0001, 0x2001, 0x8000,
                                                            0x2001, 0x8fff, 0x8001, 0x2001}))),
              ElementsAre(Event{(1 << 24) - 1, 1, 1, -1}, Event{1 << 24, 1, 1, -1},
                          Event{(2 << 24) + 4096, 1, 1, -1}));
  // A word of the clock that comes a little late is no turn.
  EXPECT_THAT(read(file("f.raw", raw<std::uint32_t>(kEvt2, {8u << 28 | 0xfffffff, 1, 8u << 28, 1,
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
    EXPECT_THAT(read(file("e.raw", raw(header, words))), ElementsAre(Event{0x25 * 64, 2, 3, 1}));
  }
  // A word that was cut.
  EXPECT_THAT(read(file("e.raw", raw(kEvt2, words) + "abc")),
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
  EXPECT_THROW(read(root_ / "cut.h5"), std::runtime_error);
  for (const char* name : {"none.h5", "none.txt", "none.csv", "none.raw"}) {
    EXPECT_THAT(complaint<IoError>([&] { read(root_ / name); }), HasSubstr(name));
  }
}

}  // namespace
}  // namespace dodgesim

// Random recordings, written and read back by readers of our own: the HDF5 library by itself, and
// the bytes of the other formats.
#include "sim/recordings/event_writer.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <hdf5.h>
#include <sys/resource.h>

#include <algorithm>
#include <csignal>
#include <cstring>

#include "sim/base/error.h"
#include "sim/files/npy_header.h"
#include "tests/complaint.h"
#include "tests/sim/files/temporary_directory.h"
#include "tests/sim/recordings/random_events.h"

namespace dodgesim {
namespace {

using testing::complaint;
using testing::contents;
using testing::Events;
using ::testing::HasSubstr;
using testing::random_events;
using testing::recording_of;
using testing::TemporaryDirectory;
using testing::write;

constexpr const char* kEnds[] = {".h5", ".npy", ".txt", ".raw"};

class Hdf5File {
 public:
  explicit Hdf5File(const std::string& path)
      : file_(H5Fopen(path.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT)) {
    EXPECT_GE(file_, 0) << path;
  }
  ~Hdf5File() { H5Fclose(file_); }

  // The values of a dataset, which has the given type in the file.
  template <class T>
  std::vector<T> read(const char* name, hid_t type, int dimensions = 1) const {
    const hid_t dataset = H5Dopen2(file_, name, H5P_DEFAULT);
    EXPECT_GE(dataset, 0) << name;
    const hid_t file_type = H5Dget_type(dataset);
    EXPECT_TRUE(H5Tequal(file_type, type)) << name;
    const hid_t space = H5Dget_space(dataset);
    EXPECT_EQ(H5Sget_simple_extent_ndims(space), dimensions) << name;
    std::vector<T> values(static_cast<std::size_t>(H5Sget_simple_extent_npoints(space)));
    EXPECT_GE(H5Dread(dataset, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data()), 0) << name;
    H5Sclose(space);
    H5Tclose(file_type);
    H5Dclose(dataset);
    return values;
  }

  // Whether the dataset holds the instant at which it was made.
  bool is_dated(const char* name) const {
    H5O_info_t info;
    EXPECT_GE(H5Oget_info_by_name2(file_, name, &info, H5O_INFO_TIME, H5P_DEFAULT), 0);
    return info.ctime != 0;
  }

  // Identifiers of the filters of a dataset.
  std::vector<H5Z_filter_t> filters(const char* name) const {
    const hid_t dataset = H5Dopen2(file_, name, H5P_DEFAULT);
    const hid_t properties = H5Dget_create_plist(dataset);
    std::vector<H5Z_filter_t> filters;
    for (unsigned i = 0; i < static_cast<unsigned>(H5Pget_nfilters(properties)); ++i) {
      unsigned flags = 0;
      std::size_t count = 1;
      unsigned level = 0;
      filters.push_back(H5Pget_filter2(properties, i, &flags, &count, &level, 0, nullptr, nullptr));
      EXPECT_TRUE(filters.back() != H5Z_FILTER_DEFLATE || level == 1u);
    }
    H5Pclose(properties);
    H5Dclose(dataset);
    return filters;
  }

 private:
  hid_t file_;
};

void expect_hdf5(const std::string& path, const Recording& recording, const Events& events) {
  const Hdf5File file(path);
  const auto x = file.read<std::uint16_t>("events/x", H5T_STD_U16LE);
  const auto y = file.read<std::uint16_t>("events/y", H5T_STD_U16LE);
  const auto t = file.read<std::uint32_t>("events/t", H5T_STD_U32LE);
  const auto p = file.read<std::uint8_t>("events/p", H5T_STD_U8LE);
  ASSERT_EQ(x.size(), events.size());
  ASSERT_EQ(y.size(), events.size());
  ASSERT_EQ(t.size(), events.size());
  ASSERT_EQ(p.size(), events.size());
  for (std::size_t i = 0; i < events.size(); ++i) {
    const Event read = {t[i], x[i], y[i], static_cast<std::int8_t>(p[i] == 1 ? 1 : -1)};
    ASSERT_EQ(read, events[i]) << i;
    ASSERT_LE(p[i], 1);
  }
  // The definition, one millisecond after the other.
  std::vector<std::uint64_t> ms_to_idx = {0};
  if (!events.empty()) ms_to_idx.resize(static_cast<std::size_t>(t.back() / 1000 + 1));
  for (std::size_t ms = 0; ms < ms_to_idx.size(); ++ms) {
    ms_to_idx[ms] = static_cast<std::uint64_t>(
        std::lower_bound(t.begin(), t.end(), static_cast<std::uint32_t>(1000 * ms)) - t.begin());
  }
  EXPECT_EQ(file.read<std::uint64_t>("ms_to_idx", H5T_STD_U64LE), ms_to_idx);
  EXPECT_EQ(file.read<std::int64_t>("t_offset", H5T_STD_I64LE, 0),
            std::vector<std::int64_t>{recording.t_offset_us});
  EXPECT_EQ(file.read<std::int64_t>("events/height", H5T_STD_I64LE, 0),
            std::vector<std::int64_t>{recording.height});
  EXPECT_EQ(file.read<std::int64_t>("events/width", H5T_STD_I64LE, 0),
            std::vector<std::int64_t>{recording.width});
}

class RecordingOfSize : public ::testing::TestWithParam<std::size_t> {
 protected:
  TemporaryDirectory root_;
  const Events events_ = random_events(GetParam(), GetParam());
};

// None, one, around the size of a chunk, several chunks.
INSTANTIATE_TEST_SUITE_P(Sizes, RecordingOfSize,
                         ::testing::Values(0, 1, 2, 32767, 32768, 32769, 200000));

TEST_P(RecordingOfSize, ReadsBackFromHdf5) {
  const Recording recording = recording_of(events_, 1600000000000000);
  const std::string path = root_ / "events.h5";
  write(path, recording, events_);
  expect_hdf5(path, recording, events_);
}

TEST_P(RecordingOfSize, ReadsBackFromNpy) {
  const TimeUs offset_us = -123456789012345;
  write(root_ / "events.npy", recording_of(events_, offset_us), events_);
  const std::string file = contents(root_ / "events.npy");
  const std::size_t front =
      10 + static_cast<unsigned char>(file[8]) + 256u * static_cast<unsigned char>(file[9]);
  const NpyHeader header = parse_npy_header(file.substr(10, front - 10));
  EXPECT_EQ(header.dtype, "[('t', '<i8'), ('x', '<u2'), ('y', '<u2'), ('p', '|i1')]");
  EXPECT_EQ(header.shape, std::vector<std::uint64_t>{events_.size()});
  ASSERT_EQ(file.size(), front + 13 * events_.size());
  for (std::size_t i = 0; i < events_.size(); ++i) {
    const char* record = file.data() + front + 13 * i;
    Event event;
    std::memcpy(&event.t_us, record, 8);
    std::memcpy(&event.x, record + 8, 2);
    std::memcpy(&event.y, record + 10, 2);
    std::memcpy(&event.polarity, record + 12, 1);
    event.t_us -= offset_us;
    ASSERT_EQ(event, events_[i]) << i;
  }
}

TEST_P(RecordingOfSize, ReadsBackFromText) {
  const TimeUs offset_us = 1600000000000000;
  write(root_ / "events.txt", recording_of(events_, offset_us), events_);
  std::ifstream file(root_ / "events.txt");
  Events read;
  int p = 0;
  for (Event event; file >> event.t_us >> event.x >> event.y >> p;) {
    ASSERT_TRUE(p == 0 || p == 1);
    event.t_us -= offset_us;
    event.polarity = static_cast<std::int8_t>(p == 1 ? 1 : -1);
    read.push_back(event);
  }
  EXPECT_TRUE(file.eof());
  EXPECT_TRUE(read == events_);
}

// Words of 32 bits behind the header: 8 and the clock's upper 28 bits, or the polarity, its lower
// 6 bits, 11 bits of x and 11 of y.
TEST_P(RecordingOfSize, ReadsBackFromRaw) {
  Events events = events_;
  for (Event& event : events) {
    event.x %= 2048;
    event.y %= 2048;
  }
  write(root_ / "events.raw", {2048, 2048, 77, 1 << 30}, events);
  const std::string file = contents(root_ / "events.raw");
  EXPECT_THAT(file, HasSubstr("\n% format EVT2;height=2048;width=2048\n"));
  EXPECT_THAT(file, HasSubstr("\n% geometry 2048x2048\n"));
  EXPECT_THAT(file, HasSubstr("\n% t_offset_us 77\n"));
  Events read;
  TimeUs high_us = -1;
  for (std::size_t i = file.find("% end\n") + 6; i + 4 <= file.size(); i += 4) {
    std::uint32_t word = 0;
    std::memcpy(&word, file.data() + i, 4);
    if (word >> 28 == 8) {
      ASSERT_LT(high_us, TimeUs{word & 0xfffffff} << 6);
      high_us = TimeUs{word & 0xfffffff} << 6;
      continue;
    }
    ASSERT_LE(word >> 28, 1u);
    read.push_back({high_us + (word >> 22) % 64, static_cast<std::uint16_t>((word >> 11) % 2048),
                    static_cast<std::uint16_t>(word % 2048),
                    static_cast<std::int8_t>(word >> 28 == 1 ? 1 : -1)});
  }
  EXPECT_TRUE(read == events);
}

// Causes are handed over in the same portions as the events.
TEST(EventWriter, SaysWhyEachEventHappened) {
  TemporaryDirectory root;
  const Events events = random_events(40000, 11);
  std::vector<Cause> causes(events.size());
  for (std::size_t i = 0; i < causes.size(); ++i) causes[i] = static_cast<Cause>(i * 7);
  Recording recording = recording_of(events);
  recording.has_causes = true;
  for (const std::string end : {".h5", ".npy", ".txt"}) {
    const auto writer = make_event_writer(root / ("a" + end), recording);
    const std::size_t half = 20001;
    writer->add({events.data(), half}, {causes.data(), half});
    writer->add({events.data() + half, events.size() - half},
                {causes.data() + half, events.size() - half});
    writer->commit();
  }
  expect_hdf5(root / "a.h5", recording, events);
  EXPECT_EQ(Hdf5File(root / "a.h5").read<Cause>("events/cause", H5T_STD_U8LE), causes);

  const std::string npy = contents(root / "a.npy");
  EXPECT_THAT(
      npy.substr(0, 192),
      HasSubstr("[('t', '<i8'), ('x', '<u2'), ('y', '<u2'), ('p', '|i1'), ('cause', '|u1')]"));
  ASSERT_EQ(npy.size(), 192 + 14 * events.size());
  std::ifstream text(root / "a.txt");
  Event event;
  int p = 0, cause = 0;
  for (std::size_t i = 0; i < events.size(); ++i) {
    TimeUs t_us = 0;
    std::memcpy(&t_us, npy.data() + 192 + 14 * i, 8);
    ASSERT_EQ(t_us, events[i].t_us);
    ASSERT_EQ(static_cast<Cause>(npy[192 + 14 * i + 13]), causes[i]) << i;
    ASSERT_TRUE(text >> event.t_us >> event.x >> event.y >> p >> cause);
    ASSERT_EQ(event.t_us, events[i].t_us);
    ASSERT_EQ(cause, causes[i]) << i;
  }
  EXPECT_FALSE(text >> p);
}

TEST(EventWriter, CompressesHdf5WithFiltersThatEveryReaderHas) {
  TemporaryDirectory root;
  const Events events = random_events(100000, 5);
  write(root / "events.h5", recording_of(events), events);
  const Hdf5File file(root / "events.h5");
  for (const char* name : {"events/x", "events/y", "events/t", "events/p", "ms_to_idx"}) {
    EXPECT_EQ(file.filters(name),
              (std::vector<H5Z_filter_t>{H5Z_FILTER_SHUFFLE, H5Z_FILTER_DEFLATE}))
        << name;
  }
}

TEST(EventWriter, MakesTheSameBytesOfTheSameRecording) {
  TemporaryDirectory root;
  const Events events = random_events(50000, 6);
  for (const std::string end : kEnds) {
    write(root / ("a" + end), recording_of(events), events);
    write(root / ("b" + end), recording_of(events), events);
    EXPECT_TRUE(contents(root / ("a" + end)) == contents(root / ("b" + end))) << end;
  }
  for (const char* name : {"events/x", "events/y", "events/t", "events/p", "events/height",
                           "events/width", "ms_to_idx", "t_offset"}) {
    EXPECT_FALSE(Hdf5File(root / "a.h5").is_dated(name)) << name;
  }
}

TEST(EventWriter, KeepsTheLastStampThatHdf5CanHold) {
  TemporaryDirectory root;
  const Events events = {{0, 1, 2, 1}, {UINT32_MAX, 3, 4, -1}};
  write(root / "long.h5", recording_of(events), events);
  expect_hdf5(root / "long.h5", recording_of(events), events);
  EXPECT_THAT(complaint<ScenarioError>([&] {
                make_event_writer(root / "longer.h5", {640, 480, 0, TimeUs{UINT32_MAX} + 1});
              }),
              HasSubstr("cannot hold the recording of 4294967296 us"));
  EXPECT_NO_THROW(make_event_writer(root / "longer.npy", {640, 480, 0, TimeUs{UINT32_MAX} + 1}));
}

TEST(EventWriter, RefusesWhatRawHasNoPlaceFor) {
  TemporaryDirectory root;
  const auto refusal = [&](const Recording& recording) {
    return complaint<ScenarioError>([&] { make_event_writer(root / "e.raw", recording); });
  };
  constexpr TimeUs kEndUs = TimeUs{1} << 34;
  EXPECT_EQ(refusal({2048, 2048, 0, kEndUs - 1}), "");
  EXPECT_THAT(refusal({640, 480, 0, kEndUs}), HasSubstr("e.raw cannot hold the recording of"));
  EXPECT_THAT(refusal({640, 2049, 0, 0}), HasSubstr("pictures of 640 x 2049 px"));
}

TEST(EventWriter, LeavesNothingBehindUnlessFinished) {
  TemporaryDirectory root;
  const Events events = random_events(100000, 7);
  for (const std::string end : kEnds) {
    {
      const auto writer = make_event_writer(root / ("a" + end), recording_of(events));
      writer->add(events);
    }
    EXPECT_TRUE(std::filesystem::is_empty(root.path())) << end;
  }
}

TEST(EventWriter, ReplacesAFileOnlyWithAWholeOne) {
  TemporaryDirectory root;
  for (const std::string end : kEnds) {
    testing::put(root / ("a" + end), "old");
    const auto writer = make_event_writer(root / ("a" + end), {4, 4, 0, 10});
    writer->add(Events{{1, 2, 3, 1}});
    EXPECT_EQ(contents(root / ("a" + end)), "old");
    writer->commit();
    EXPECT_NE(contents(root / ("a" + end)), "old");
  }
}

TEST(EventWriter, RefusesWhatItCannotCreate) {
  TemporaryDirectory root;
  for (const std::string end : kEnds) {
    const std::string nowhere = root / ("no/such/events" + end);
    EXPECT_EQ(complaint<IoError>([&] { make_event_writer(nowhere, {}); }),
              nowhere + " could not be created: No such file or directory.");
    const std::string directory = root / ("d" + end);
    std::filesystem::create_directory(directory);
    EXPECT_EQ(complaint<IoError>([&] { make_event_writer(directory, {}); }),
              directory + " could not be created: Is a directory.");
  }
  for (const std::string name : {"events", "events.csv", "events.h5.gz", ".h5"}) {
    EXPECT_THAT(complaint<ScenarioError>([&] { make_event_writer(root / name, {}); }),
                HasSubstr("must end in .h5 (or .hdf5), .npy, .txt or .raw"));
  }
}

TEST(EventWriter, ReportsAFullDisk) {
  TemporaryDirectory root;
  for (const std::string end : kEnds) {
    const std::string path = root / ("a" + end);
    for (const std::size_t count : {0, 10, 200000}) {
      if (count == 0 && end == ".txt") continue;  // nothing to write
      std::filesystem::create_symlink("/dev/full", path + ".partial");
      const Events events = random_events(count, 8);
      EXPECT_EQ(complaint<IoError>([&] { write(path, recording_of(events), events); }),
                path + " could not be written: No space left on device.");
      EXPECT_TRUE(std::filesystem::is_empty(root.path())) << end;
    }
  }
}

// A disk that becomes full anywhere in the file.
TEST(EventWriter, ReportsEveryByteThatFindsNoPlace) {
  TemporaryDirectory root;
  const Events events = random_events(70000, 9);
  std::signal(SIGXFSZ, SIG_IGN);
  rlimit before{};
  ::getrlimit(RLIMIT_FSIZE, &before);
  for (const std::string end : kEnds) {
    const std::string path = root / ("a" + end);
    write(path, recording_of(events), events);
    const std::string whole = contents(path);
    for (std::size_t step = 0; step <= 40; ++step) {
      std::filesystem::remove(path);
      const std::size_t limit = step < 40 ? whole.size() * step / 40 : whole.size();
      for (const std::size_t bytes : {limit, limit > 0 ? limit - 1 : 0}) {
        const rlimit small = {bytes, before.rlim_max};
        ::setrlimit(RLIMIT_FSIZE, &small);
        const std::string refusal =
            complaint<IoError>([&] { write(path, recording_of(events), events); });
        ::setrlimit(RLIMIT_FSIZE, &before);
        if (bytes == whole.size()) {
          EXPECT_EQ(refusal, "");
          EXPECT_TRUE(contents(path) == whole);
          std::filesystem::remove(path);
        } else {
          EXPECT_EQ(refusal, path + " could not be written: File too large.") << bytes;
        }
        EXPECT_TRUE(std::filesystem::is_empty(root.path())) << end << " " << bytes;
      }
    }
  }
}

}  // namespace
}  // namespace dodgesim

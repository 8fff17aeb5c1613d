// Events that other programs wrote as HDF5; event_reader_test.cc has those of our own.
#include "sim/recordings/hdf5_event_reader.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <hdf5.h>

#include <bit>
#include <cmath>
#include <filesystem>
#include <limits>
#include <string>
#include <vector>

#include "sim/base/error.h"
#include "tests/complaint.h"
#include "tests/sim/files/temporary_directory.h"
#include "tests/sim/recordings/random_events.h"
#include "tests/sim/recordings/read_events.h"

namespace dodgesim {
namespace {

using testing::complaint;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using testing::read_events;

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

  // x, y, p and, unless it is empty, t between a prefix and a suffix.
  void lists(const std::string& prefix, const std::vector<std::int64_t>& t,
             const std::string& suffix = "") {
    if (!t.empty()) list(prefix + "t" + suffix, H5T_NATIVE_INT64, t);
    list<std::uint16_t>(prefix + "x" + suffix, H5T_NATIVE_UINT16, {1, 2});
    list<std::uint16_t>(prefix + "y" + suffix, H5T_NATIVE_UINT16, {3, 4});
    list<std::uint8_t>(prefix + "p" + suffix, H5T_NATIVE_UINT8, {1, 0});
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

class Hdf5Events : public ::testing::Test {
 protected:
  std::string refusal() const {
    return complaint<ScenarioError>([&] { read_events(path_); });
  }

  testing::TemporaryDirectory root_;
  const std::filesystem::path path_ = root_ / "e.h5";
};

TEST_F(Hdf5Events, OfAnotherImageOrLayoutAreRefused) {
  const testing::Events events = testing::random_recording(100, 5);
  testing::write(path_, testing::recording_of(events), events);
  EXPECT_THAT(complaint<ScenarioError>([&] {
                read_events(path_, {320, 480});
              }),
              HasSubstr("events/width is 640, but the calibration says 320"));
  testing::put(path_, "no HDF5");
  EXPECT_THAT(refusal(), HasSubstr("cannot be opened as HDF5"));
  const hid_t empty = H5Fcreate(path_.c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, H5P_DEFAULT);
  H5Fclose(empty);
  EXPECT_THAT(refusal(), HasSubstr("has no events/t"));
}

TEST_F(Hdf5Events, HaveSeveralLayouts) {
  const auto expected = ElementsAre(Event{7, 1, 3, 1}, Event{8, 2, 4, -1});
  for (const char* prefix : {"events/", ""}) {
    Hdf5Writer(path_).lists(prefix, {7, 8});
    EXPECT_THAT(read_events(path_), expected) << prefix;
  }
  for (const char* name : {"CD/events", "events"}) {
    put_records(path_, name, {{1, 3, 1, 7}, {2, 4, 0, 8}});
    EXPECT_THAT(read_events(path_), expected) << name;
  }
  Hdf5Writer(path_).list<std::uint32_t>("events", H5T_NATIVE_UINT32, {7, 1, 3, 1, 8, 2, 4, 0}, 4);
  EXPECT_THAT(read_events(path_), expected);
}

TEST_F(Hdf5Events, MayBeInSecondsOrRealMicroseconds) {
  const auto put_at = [this](const std::vector<double>& t) {
    Hdf5Writer file(path_);
    file.lists("events/", {}, "s");
    file.list("events/ts", H5T_NATIVE_DOUBLE, t);
  };
  put_at({0.000007, 12});
  EXPECT_THAT(read_events(path_), ElementsAre(Event{7, 1, 3, 1}, Event{12'000'000, 2, 4, -1}));
  EXPECT_TRUE(open_events(path_, testing::kImage)->in_seconds());
  put_at({7, 8});
  EXPECT_THAT(read_events(path_), ElementsAre(Event{7, 1, 3, 1}, Event{8, 2, 4, -1}));
  EXPECT_FALSE(open_events(path_, testing::kImage)->in_seconds());
  for (const double t : {1e300, -1e300, std::numeric_limits<double>::quiet_NaN()}) {
    put_at({0.5, t});
    EXPECT_THAT(refusal(), HasSubstr("event 1: t is")) << t;
  }
  put_at({-0.5, 1});
  EXPECT_THAT(refusal(), HasSubstr("event 0: t [us] is -500000, but must be from 0"));
  put_records(path_, "CD/events", {{1, 3, 1, std::bit_cast<std::int64_t>(0.25)}},
              H5T_NATIVE_DOUBLE);
  EXPECT_THAT(read_events(path_), ElementsAre(Event{250'000, 1, 3, 1}));
}

TEST_F(Hdf5Events, MayHaveAWholeOffset) {
  const auto with_offset = [this](hid_t type, const auto& offset) {
    Hdf5Writer file(path_);
    file.lists("events/", {7, 8});
    file.list("t_offset", type, std::vector{offset});
  };
  with_offset(H5T_NATIVE_DOUBLE, 1e9);
  EXPECT_THAT(read_events(path_),
              ElementsAre(Event{1'000'000'007, 1, 3, 1}, Event{1'000'000'008, 2, 4, -1}));
  with_offset(H5T_NATIVE_DOUBLE, 0.25);
  EXPECT_THAT(refusal(), HasSubstr("t_offset must be one whole number"));
  with_offset(H5T_NATIVE_DOUBLE, std::nan(""));
  EXPECT_THAT(refusal(), HasSubstr("t_offset must be one whole number"));
  const std::string range = ", but must be from -1152921504606846976 to 1152921504606846976 us";
  with_offset(H5T_NATIVE_INT64, std::int64_t{1700000000000000000});
  EXPECT_EQ(refusal(), path_.string() + ": t_offset is 1700000000000000000" + range +
                           ": are these nanoseconds?");
  with_offset(H5T_NATIVE_INT64, std::numeric_limits<std::int64_t>::min());
  EXPECT_THAT(refusal(), HasSubstr("t_offset is -9223372036854775808" + range));
  with_offset(H5T_NATIVE_UINT64, std::numeric_limits<std::uint64_t>::max());
  EXPECT_THAT(refusal(), HasSubstr("t_offset is 18446744073709551615" + range));
}

TEST_F(Hdf5Events, HaveWholePixels) {
  {
    Hdf5Writer file(path_);
    file.list<std::int64_t>("events/t", H5T_NATIVE_INT64, {7, 8});
    file.list<float>("events/x", H5T_NATIVE_FLOAT, {1, 2});
  }
  EXPECT_THAT(refusal(), HasSubstr("events/x has no whole numbers"));
  Hdf5Writer(path_).list<double>("events", H5T_NATIVE_DOUBLE, {0.5, 0.6});
  EXPECT_THAT(refusal(), HasSubstr("events has no field t"));
  Hdf5Writer(path_).list<float>("events", H5T_NATIVE_FLOAT, {7, 1, 3, 1, 8, 2, 4, 0}, 4);
  EXPECT_THAT(refusal(), HasSubstr("events, t has no whole numbers"));
  Hdf5Writer(path_).list<int>("events/t", H5T_NATIVE_INT, {7, 1, 3, 1, 8, 2, 4, 0}, 4);
  EXPECT_THAT(refusal(), HasSubstr("events/t must be a list"));
  Hdf5Writer(path_).lists("events/", {std::numeric_limits<std::int64_t>::max(), 8});
  EXPECT_THAT(refusal(), HasSubstr("event 0: t [us] is"));
}

}  // namespace
}  // namespace dodgesim

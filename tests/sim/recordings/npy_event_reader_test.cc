// Arrays of events that other programs wrote; event_reader_test.cc has those of our own.
#include "sim/recordings/npy_event_reader.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "sim/base/error.h"
#include "sim/files/npy_header.h"
#include "tests/complaint.h"
#include "tests/sim/files/temporary_directory.h"

namespace dodgesim {
namespace {

using ::testing::AllOf;
using testing::complaint;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using testing::put;

class NpyEvents : public ::testing::Test {
 protected:
  std::string file(const std::string& name, const std::string& bytes) const {
    return put(root_ / name, bytes);
  }
  static std::vector<Event> read(const std::string& path) {
    const auto reader = open_npy_events(path, {640, 480});
    const auto events = reader->next();
    return {events.begin(), events.end()};
  }
  std::string refusal(const std::string& name, const std::string& bytes) const {
    const std::string path = file(name, bytes);
    return complaint<ScenarioError>([&] { read(path); });
  }

  testing::TemporaryDirectory root_;
};

TEST_F(NpyEvents, RecordsOfAnArrayMayHaveOtherFieldsInAnyOrder) {
  // As Prophesee's tools write them, and with a truth, another number and padding.
  EXPECT_THAT(read(file("e.npy",
                        npy_front("[('x', '<u2'), ('y', '<u2'), ('p', '<i2'), ('t', '<i8')]", {1}) +
                            std::string("\x01\x01\2\0\xff\xff\7\0\0\0\0\0\0\0", 14))),
              ElementsAre(Event{7, 257, 2, -1}));
  EXPECT_THAT(
      read(file("e.npy", npy_front("[('p', '|b1'), ('', '|V2'), ('t', '<u4'), ('size', '<f4'), "
                                   "('y', '|u1'), ('x', '|u1')]",
                                   {2}) +
                             std::string("\1--\1\0\0\x80....\3\4\0--\2\0\0\x80....\xc8\6", 26))),
      ElementsAre(Event{0x80000001, 4, 3, 1}, Event{0x80000002, 6, 200, -1}));
  EXPECT_THAT(
      refusal("e.npy", npy_front("[('t', '<u8'), ('x', '|i1'), ('y', '|i1'), ('p', '|i1')]", {1}) +
                           std::string(8, '\xff') + "abc"),
      AllOf(HasSubstr("e.npy, event 0: t [us] is 9223372036854775807"), HasSubstr("nanoseconds")));
}

TEST_F(NpyEvents, RefusesArraysThatAreNoEvents) {
  for (const std::string descr :
       {"'<f4'", "[('t', '<f8'), ('x', '<u2'), ('y', '<u2'), ('p', '|i1')]",
        "[('t', '<i8'), ('x', '>u2'), ('y', '<u2'), ('p', '|i1')]",
        "[('t', '<i8'), ('x', '<u2'), ('y', '<u2')]",
        "[('t', '<i8'), ('x', '<u2'), ('y', '<u2'), ('p', '|b9')]",
        "[('t', '|b0'), ('x', '|b0'), ('y', '|b0'), ('p', '|b0')]",
        "[('t', '<u16'), ('x', '<u2'), ('y', '<u2'), ('p', '|i1')]",
        "[('t', '<i8'), ('x', '<i3'), ('y', '<u2'), ('p', '|i1')]",
        "[('t', '<i8'), ('x', '<u2', (2,)), ('y', '<u2'), ('p', '|i1')]"}) {
    EXPECT_THAT(
        refusal("e.npy", npy_front(descr, {0})),
        HasSubstr(
            "but must have records with the fields t [us], x, y and p, each a little-endian"));
  }
  const std::string fields = "[('t', '<i8'), ('x', '<u2'), ('y', '<u2'), ('p', '|i1')]";
  EXPECT_THAT(refusal("e.npy", npy_front(fields, {0, 2})), HasSubstr("(0, 2)"));
  EXPECT_NE(refusal("e.npy", npy_front(fields, {3}) + std::string(38, '\0')), "");
}

}  // namespace
}  // namespace dodgesim

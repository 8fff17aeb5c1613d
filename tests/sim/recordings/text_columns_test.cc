// The same lines as different programs write them, of events and of sensor logs alike.
#include "sim/recordings/text_columns.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>

#include "sim/base/error.h"
#include "sim/recordings/event_reader.h"
#include "sim/recordings/sensor_log.h"
#include "tests/complaint.h"
#include "tests/sim/files/temporary_directory.h"

namespace dodgesim {
namespace {

using testing::complaint;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using testing::put;
using testing::TemporaryDirectory;

class Dialects : public ::testing::TestWithParam<const char*> {
 protected:
  TemporaryDirectory root_;
};

// NAMES, FIRST and SECOND are lines without their ends.
std::string filled_in(std::string text, const std::array<std::string, 3>& lines) {
  const std::array<std::string, 3> marks = {"NAMES", "FIRST", "SECOND"};
  for (std::size_t i = 0; i < marks.size(); ++i) {
    text.replace(text.find(marks[i]), marks[i].size(), lines[i]);
  }
  return text;
}

INSTANTIATE_TEST_SUITE_P(
    Programs, Dialects,
    ::testing::Values("NAMES\nFIRST\nSECOND\n", "NAMES\nFIRST\nSECOND",          // no last end
                      "NAMES\r\nFIRST\r\nSECOND\r\n\r\n",                        // Windows
                      "\xef\xbb\xbfNAMES\nFIRST\nSECOND\n",                      // Excel
                      "# by me\n\nNAMES\n# from here on\nFIRST\n\nSECOND\n \n",  // by hand
                      "# NAMES\nFIRST\nSECOND\n", "#NAMES\nFIRST\nSECOND\n"));   // numpy.savetxt

TEST_P(Dialects, AreOneToTheReaders) {
  const std::string events =
      put(root_ / "events.csv",
          filled_in(GetParam(), {"t_us, \"x\" ,y,p,label", " 7 ,\t1, \"2\",1,\"a, \"\"b\"\"\"",
                                 "8.000e+00,3.0,4,0"}));
  const auto reader = open_events(events, {10, 10});
  EXPECT_THAT(reader->next(), ElementsAre(Event{7, 1, 2, 1}, Event{8, 3, 4, -1}));
  const std::string log = put(
      root_ / "log.csv",
      filled_in(GetParam(), {"wx, wy,\"wz\",t_us,label", " 1, 2e0,\"3\",7,\"a,b\"", "4,5,6,8.0"}));
  const std::vector<ImuReading> imu = read_imu_log(log);
  ASSERT_EQ(imu.size(), 2u);
  EXPECT_EQ(imu[0].t_us, 7);
  EXPECT_EQ(imu[0].w_B_radps, Eigen::Vector3d(1, 2, 3));
  EXPECT_EQ(imu[1].t_us, 8);
  EXPECT_EQ(imu[1].w_B_radps, Eigen::Vector3d(4, 5, 6));
}

TEST(TextColumns, MayBeSeparatedBySemicolonsOrTabs) {
  const TemporaryDirectory root;
  for (const std::string s : {";", "\t", " ;\t"}) {
    TextColumns file(put(root / "f.csv", "a" + s + "b" + s + "c\n1" + s + s + "3\n"));
    file.read_names({"a", "c"});
    ASSERT_TRUE(file.next());
    EXPECT_EQ(file.integer(file.column("a")), 1);
    EXPECT_EQ(file.text(file.column("b")), "");
    EXPECT_EQ(file.integer(file.column("c")), 3);
  }
}

TEST(TextColumns, SaysWhatIsMissing) {
  const TemporaryDirectory root;
  const auto refusal = [&root](const std::string& text) {
    return complaint<ScenarioError>([&] {
      TextColumns file(put(root / "f.csv", text));
      file.read_names({"a", "b"});
      const Column a = file.column("a");
      while (file.next()) file.integer(a);
    });
  };
  EXPECT_EQ(refusal("b,a\n1,2\n"), "");
  EXPECT_THAT(refusal(""), HasSubstr("f.csv is empty"));
  EXPECT_THAT(refusal("# only\n# remarks\n"), HasSubstr("f.csv is empty"));
  EXPECT_THAT(refusal("1,2\n"), HasSubstr("f.csv:1: there is no column a; the first line must "
                                          "name a and b."));
  EXPECT_THAT(refusal("a,b,a\n1,2,3\n"), HasSubstr("f.csv:1: the column a comes twice."));
  EXPECT_THAT(refusal("b,a\n1\n"), HasSubstr("f.csv:2: a is missing; the line has 1 cell."));
  EXPECT_THAT(refusal("b,a\n1,\"2\n"), HasSubstr("f.csv:2: a is \"\"2\", but must be a whole"));
  EXPECT_THAT(refusal("b,a\n1,1e30\n"), HasSubstr("must be a whole number"));
}

// Decimal commas shift all cells behind them.
TEST(TextColumns, RefusesCellsBeyondTheNames) {
  const TemporaryDirectory root;
  const std::string path = root / "f.csv";
  const auto refusal = [&](const std::string& text) {
    return complaint<ScenarioError>([&] { read_imu_log(put(path, "t_us,wx,wy,wz\n" + text)); });
  };
  EXPECT_EQ(refusal("1,0,0,0\n2,0,5,0,5,0,5\n"),
            path +
                ":3: the line has 7 cells, but 4 columns have names: are there commas in place of "
                "decimal points?");
  EXPECT_EQ(refusal("1,0,0,0,\n2,0,0,0, ,\n"), "");
  // Without names there may be more, such as the causes of events.
  EXPECT_EQ(open_events(put(root / "e.txt", "1 2 3 1 254 7\n"), {10, 10})->next().size(), 1u);
}

TEST(TextColumns, QuotesNoControlCharacters) {
  const TemporaryDirectory root;
  const std::string path = put(root / "e.txt", std::string("1 2 3 1\n1\0 2 3 1\n", 17));
  EXPECT_EQ(complaint<ScenarioError>([&] {
              open_events(path, {10, 10})->next();
            }),
            path + ":2: t is \"1\\x00\", but must be a number.");
}

TEST(TextColumns, SaysThatAFileIsNoPlainText) {
  const TemporaryDirectory root;
  const auto refusal = [&](const std::string& name, const std::string& bytes) {
    return complaint<ScenarioError>([&] { open_events(put(root / name, bytes), {10, 10}); });
  };
  for (const char* name : {"e.txt", "e.csv"}) {
    const std::string path = root / name;
    EXPECT_EQ(refusal(name, "\x1f\x8b\b"),
              path + " is compressed by gzip: unpack it first (gunzip).");
    for (const char* mark : {"\xff\xfe", "\xfe\xff"}) {
      EXPECT_EQ(refusal(name, mark), path + " is text in UTF-16, but must be in ASCII or UTF-8.");
    }
  }
}

}  // namespace
}  // namespace dodgesim

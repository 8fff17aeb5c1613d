#include "sim/campaign/csv.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <limits>
#include <sstream>

#include "sim/base/error.h"
#include "sim/campaign/wire.h"
#include "tests/sim/campaign/fake_throws.h"
#include "tests/sim/files/temporary_directory.h"

namespace dodgesim {
namespace {

struct Nested {
  double a = 0.1;
  bool b = true;
  template <class Visitor>
  void visit(Visitor& v) {
    v("a", a);
    v("b", b);
  }
};

struct Row {
  int n = -3;
  Nested nested;
  std::array<double, 2> p{1.5, 2};
  std::optional<std::array<double, 2>> absent;
  std::optional<TimeUs> t_us = 12;
  std::string text = "a, \"b\"\nc";
  double nan = std::numeric_limits<double>::quiet_NaN();
  template <class Visitor>
  void visit(Visitor& v) {
    v("n", n);
    v("nested", nested);
    v("p", p);
    v("absent", absent);
    v("t_us", t_us);
    v("text", text);
    v("nan", nan);
  }
};

TEST(Csv, HeaderAndRowFollowTheList) {
  EXPECT_EQ(csv_header<Row>(), "n,nested_a,nested_b,p_0,p_1,absent_0,absent_1,t_us,text,nan\n");
  EXPECT_EQ(csv_row(Row{}), "-3,0.1,1,1.5,2,,,12,\"a, \"\"b\"\" c\",nan\n");
}

TEST(Csv, AResultHasAsManyCellsAsItsHeader) {
  const std::string header = csv_header<ThrowResult>();
  const std::string row = csv_row(ball(3, 0.1, 2, 4));
  EXPECT_EQ(std::count(header.begin(), header.end(), ','), std::count(row.begin(), row.end(), ','));
}

// scenarios/README.md, whose test is in tests/cli/, has a table for each of the files.
void expect_documented(const std::string& file, const std::string& header) {
  const std::string readme =
      testing::contents(std::filesystem::path(DODGESIM_SOURCE_DIR) / "scenarios/README.md");
  const std::size_t begin = readme.find("\n`" + file + "`:\n");
  ASSERT_NE(begin, std::string::npos) << file;
  const std::string table = readme.substr(begin, readme.find("|\n\n", begin) - begin);
  std::istringstream columns(header.substr(0, header.size() - 1));
  for (std::string column; std::getline(columns, column, ',');) {
    std::string name = column.substr(0, column.find_last_not_of("_0123456789") + 1);
    if (name != column) name += "_0";
    for (const std::string pilot : {"none_", "oracle_"}) {
      const bool of_pilot = name.starts_with(pilot) && name != "none_after_room";
      if (file == "throws.csv" && of_pilot) name.replace(0, pilot.size(), "flown_");
    }
    EXPECT_NE(table.find("`" + name + "`"), std::string::npos) << file << ": " << column;
  }
}

TEST(Csv, EveryColumnIsDocumented) {
  expect_documented("throws.csv", csv_header<ThrowResult>());
  expect_documented("objects.csv", csv_header<ObjectRow>());
  expect_documented("detections.csv", csv_header<DetectionRow>());
}

ThrowResult full_result() {
  ThrowResult result = ball(7, 0.1, 2.5, 4);
  result.flown = flown(true);
  result.none = failed("It broke, \"badly\".");
  result.first_detection_us = 1234567;
  result.first_detection_distance_m = 1.4142135623730951;
  result.events = {123456789012, 5};
  result.events_lost = {3, 4};
  result.events_hash = 0xfedcba9876543210;
  result.wall_s = 1.25;
  DetectionRow row;
  row.throw_index = 7;
  row.p_W = {1, 2, 3};
  row.object = 0;
  row.true_p_W = {1.5, 2.5, 3.5};
  result.detection_rows = {row, DetectionRow{}};
  result.truth_rows = {{7, 500000, true, {100, 40, 20, 10}}, {7, 504000, false, {9, 0, 0, 0}}};
  return result;
}

TEST(Wire, AResultArrivesAsItWasSent) {
  const ThrowResult sent = full_result();
  const ThrowResult received = result_from_bytes(to_bytes(sent));
  EXPECT_EQ(csv_row(received), csv_row(sent));
  EXPECT_EQ(received.wall_s, sent.wall_s);
  ASSERT_EQ(received.detection_rows.size(), 2u);
  EXPECT_EQ(csv_row(received.detection_rows[0]), csv_row(sent.detection_rows[0]));
  EXPECT_FALSE(received.detection_rows[1].true_p_W.has_value());
  ASSERT_EQ(received.truth_rows.size(), 2u);
  EXPECT_EQ(csv_row(received.truth_rows[0]), "7,500000,1,100,40,20,10,0.5,0.25\n");
  EXPECT_EQ(csv_row(received.truth_rows[1]), "7,504000,0,9,0,0,0,,\n");
}

TEST(Wire, AnIncompleteResultIsNoticedAtEveryLength) {
  const std::string bytes = to_bytes(full_result());
  for (std::size_t n = 0; n < bytes.size(); ++n) {
    EXPECT_THROW(result_from_bytes(bytes.substr(0, n)), IoError) << n;
  }
  EXPECT_THROW(result_from_bytes(bytes + "x"), IoError);
}

}  // namespace
}  // namespace dodgesim

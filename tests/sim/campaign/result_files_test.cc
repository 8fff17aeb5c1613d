#include "sim/campaign/result_files.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <sstream>

#include "sim/files/csv.h"
#include "tests/sim/files/temporary_directory.h"
#include "tests/sim/tables/fake_throws.h"

namespace dodgesim {
namespace {

TEST(ResultFiles, AResultHasAsManyCellsAsItsHeader) {
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

TEST(ResultFiles, EveryColumnIsDocumented) {
  expect_documented("throws.csv", csv_header<ThrowResult>());
  expect_documented("objects.csv", csv_header<ObjectRow>());
  expect_documented("detections.csv", csv_header<DetectionRow>());
}

}  // namespace
}  // namespace dodgesim

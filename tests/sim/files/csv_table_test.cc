#include "sim/files/csv_table.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "sim/base/error.h"
#include "sim/files/csv.h"

namespace dodgesim {
namespace {

using ::testing::HasSubstr;
using ::testing::ThrowsMessage;

TEST(CsvTable, ReadsCellsByColumn) {
  const CsvTable table("a,b\n1,two\n\"x,\"\"y\"\"\",\n", "t.csv");
  ASSERT_EQ(table.rows(), 2U);
  EXPECT_EQ(table.at(0, "b"), "two");
  EXPECT_EQ(table.at(1, "a"), "x,\"y\"");
  EXPECT_EQ(table.at(1, "b"), "");
  EXPECT_TRUE(table.has("a"));
  EXPECT_FALSE(table.has("c"));
}

TEST(CsvTable, ReadsBackWhatWasWritten) {
  for (const std::string text : {"plain", "", "a,b", "say \"no\"", "\"", ",", "\"\",\""}) {
    const CsvTable table("v,w\n" + csv_cell(text) + "," + csv_cell(text) + "\n", "t.csv");
    EXPECT_EQ(table.at(0, "v"), text);
    EXPECT_EQ(table.at(0, "w"), text);
  }
}

TEST(CsvTable, TakesLineEndsOfAnyKind) {
  const CsvTable table("a,b\r\n1,2\r\n3,4", "t.csv");
  ASSERT_EQ(table.rows(), 2U);
  EXPECT_EQ(table.at(1, "b"), "4");
}

TEST(CsvTable, SaysWhereAFileIsBroken) {
  const auto read = [](const char* text) { return [text] { CsvTable(text, "t.csv"); }; };
  EXPECT_THAT(read("a,b\n1\n"),
              ThrowsMessage<IoError>(HasSubstr("t.csv:2: There are 1 cells, not 2.")));
  EXPECT_THAT(read("a\n\"x\n"), ThrowsMessage<IoError>(HasSubstr("t.csv:2: A quote is not")));
  EXPECT_THAT(read("a,a\n"), ThrowsMessage<IoError>(HasSubstr("\"a\" comes twice")));
  EXPECT_THAT(read("a\n\"x\"y\n"), ThrowsMessage<IoError>(HasSubstr("behind a closed quote")));
  EXPECT_THAT(read("a\nx\"y\n"), ThrowsMessage<IoError>(HasSubstr("within a cell")));
  EXPECT_THAT([] { CsvTable("a\n1\n", "t.csv").at(0, "b"); },
              ThrowsMessage<IoError>(HasSubstr("t.csv has no column \"b\"")));
  const CsvTable numbers("a,b,c\n-1.5,7,x\n", "t.csv");
  EXPECT_EQ(numbers.number(0, "a"), -1.5);
  EXPECT_EQ(numbers.integer(0, "b"), 7);
  EXPECT_THAT([&] { numbers.integer(0, "a"); },
              ThrowsMessage<IoError>(HasSubstr("t.csv:2: a is \"-1.5\", not an integer.")));
  const CsvTable answers("yes,no,other\n1,0,yes\n", "t.csv");
  EXPECT_TRUE(answers.boolean(0, "yes"));
  EXPECT_FALSE(answers.boolean(0, "no"));
  EXPECT_THAT([&] { answers.boolean(0, "other"); },
              ThrowsMessage<IoError>(HasSubstr("t.csv:2: other is \"yes\", not 0 or 1.")));
  EXPECT_THAT([&] { numbers.number(0, "c"); }, ThrowsMessage<IoError>(HasSubstr("not a number")));
  EXPECT_THROW(CsvTable(std::filesystem::path("/nowhere/throws.csv")), IoError);
}

}  // namespace
}  // namespace dodgesim

#include "sim/files/json.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <stdexcept>

namespace dodgesim {
namespace {

TEST(JsonText, KeepsTheOrderOfItsMembers) {
  const std::string text = R"({"b":1,"a":[2.5,null,"x"],"c":{"z":true,"y":false}})";
  EXPECT_EQ(to_text(parse_json(text)), text);
}

TEST(JsonText, HasALineForEachMemberIfIndented) {
  EXPECT_EQ(to_text({{"a", 1}, {"b", {2}}}, 2), "{\n  \"a\": 1,\n  \"b\": [\n    2\n  ]\n}");
}

TEST(JsonText, HasReplacementCharactersForWhatIsNotUtf8) {
  EXPECT_EQ(to_text("caf\xe9 \xc3\xa9"), "\"caf\xef\xbf\xbd \xc3\xa9\"");
}

TEST(ParseJson, SaysWhereATextIsNone) {
  try {
    parse_json("{\"a\": 1,\n \"b\": }");
    FAIL();
  } catch (const std::invalid_argument& error) {
    EXPECT_THAT(error.what(), ::testing::HasSubstr("line 2, column 7"));
  }
  EXPECT_THROW(parse_json(""), std::invalid_argument);
  EXPECT_THROW(parse_json("[1e999]"), std::invalid_argument);
}

}  // namespace
}  // namespace dodgesim

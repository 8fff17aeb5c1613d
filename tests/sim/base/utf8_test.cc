#include "sim/base/utf8.h"

#include <gtest/gtest.h>

namespace dodgesim {
namespace {

TEST(Utf8, TheFirstCharacterBeyondAsciiHasItsNumber) {
  EXPECT_EQ(beyond_ascii("a\xc2\xa0\xd0\xb5"), "U+00A0");
  EXPECT_EQ(beyond_ascii("\xe2\x80\x8b"), "U+200B");
  EXPECT_EQ(beyond_ascii("\xf0\x9f\x9a\x81"), "U+1F681");
  EXPECT_EQ(beyond_ascii("abc"), "");
  EXPECT_EQ(beyond_ascii(""), "");
  EXPECT_EQ(beyond_ascii("\x85"), "");
}

TEST(Utf8, IsShownWithoutControlCharacters) {
  EXPECT_EQ(printable("2,5 \xc2\xb5s"), "2,5 \xc2\xb5s");
  EXPECT_EQ(printable(std::string("1\0\x1b[2J\x7f", 7)), "1\\x00\\x1b[2J\\x7f");
  EXPECT_EQ(printable("\xff\xc3"), "\\xff\\xc3");
  EXPECT_EQ(printable("\xc2\x9b"), "\\xc2\\x9b");  // begins commands of terminals
}

}  // namespace
}  // namespace dodgesim

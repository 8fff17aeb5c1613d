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

}  // namespace
}  // namespace dodgesim

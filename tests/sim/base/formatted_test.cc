#include "sim/base/formatted.h"

#include <gtest/gtest.h>

namespace dodgesim {
namespace {

TEST(Formatted, IsWhatPrintfWouldPrint) {
  EXPECT_EQ(formatted("%.2f m/s, %d of %s", 1.005, 3, "ten"), "1.00 m/s, 3 of ten");
  EXPECT_EQ(formatted("95 %%"), "95 %");
  EXPECT_EQ(formatted("%s", ""), "");
}

TEST(Formatted, HasRoomForAnyLength) {
  const std::string text(5000, 'x');
  EXPECT_EQ(formatted("<%s>", text.c_str()), "<" + text + ">");
}

}  // namespace
}  // namespace dodgesim

#include "sim/files/markup.h"

#include <gtest/gtest.h>

namespace dodgesim {
namespace {

TEST(Markup, LeavesNothingThatIsTakenForMarkup) {
  EXPECT_EQ(markup_escaped("a <b> & \"c\""), "a &lt;b&gt; &amp; &quot;c&quot;");
  EXPECT_EQ(markup_escaped("two\nlines\tand \x01"), "two\nlines\tand ?");
  EXPECT_EQ(markup_escaped("10 µm"), "10 µm");
}

}  // namespace
}  // namespace dodgesim

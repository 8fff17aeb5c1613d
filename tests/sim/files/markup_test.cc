#include "sim/files/markup.h"

#include <gtest/gtest.h>

namespace dodgesim {
namespace {

// What XML 1.0 allows, whatever a name holds.
TEST(Markup, ReplacesWhatIsNoCharacter) {
  EXPECT_EQ(markup_escaped("o\xe9x"), "o\xef\xbf\xbdx");                      // Latin 1
  EXPECT_EQ(markup_escaped("\xed\xa0\x80"), markup_escaped("\xff\xff\xff"));  // half of a pair
  EXPECT_EQ(markup_escaped("a\xef\xbf\xbf"), "a\xef\xbf\xbd");                // U+FFFF
  EXPECT_EQ(markup_escaped("cut \xe2\x82"), "cut \xef\xbf\xbd\xef\xbf\xbd");
  EXPECT_EQ(markup_escaped("\U0001F681 \u00b5"), "\U0001F681 \u00b5");
}

TEST(Markup, LeavesNothingThatIsTakenForMarkup) {
  EXPECT_EQ(markup_escaped("a <b> & \"c\""), "a &lt;b&gt; &amp; &quot;c&quot;");
  EXPECT_EQ(markup_escaped("two\nlines\tand \x01"), "two\nlines\tand ?");
  EXPECT_EQ(markup_escaped("10 µm"), "10 µm");
}

TEST(Markup, MarkdownShowsTheTextAsItIs) {
  EXPECT_EQ(markdown_escaped("goal_flight, 10 cm (-20 %)"), "goal_flight, 10 cm (-20 %)");
  EXPECT_EQ(markdown_escaped("<b> __x__ a|b [c] \\"), R"(\<b\> \_\_x\_\_ a\|b \[c\] \\)");
}

}  // namespace
}  // namespace dodgesim

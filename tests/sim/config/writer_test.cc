#include "sim/config/writer.h"

#include <gtest/gtest.h>

#include "sim/config/yaml_tree.h"

namespace dodgesim {
namespace {

TEST(InQuotes, AnyTextOfUtf8IsReadBack) {
  std::string text = "\"\\ \xc3\xa4 \xc2\x9b";
  for (char c = 0; c < 0x20; ++c) text += c;
  text += '\x7f';
  Problems problems("text");
  EXPECT_EQ(parse_yaml_value(in_quotes(text), problems, 0).text, text);
  EXPECT_EQ(in_quotes("\a\x7f\n"), "\"\\x07\\x7f\\n\"");
}

}  // namespace
}  // namespace dodgesim

#include "sim/world/mjcf.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

#include "sim/base/error.h"
#include "tests/complaint.h"

namespace dodgesim {
namespace {

using ::testing::HasSubstr;

TEST(MjcfTest, PrintsElementsOnTheLinesThatTheyHad) {
  EXPECT_EQ(print_mjcf(parse_mjcf("<?xml version='1.0'?><!-- < --><a  x = '1' >\n<b />\n\n"
                                  "<c><d\ny='2'\nz=\"\"></d>\n</c>\n</a>",
                                  "test")),
            "<a x=\"1\">\n<b/>\n\n<c><d y=\"2\" z=\"\"></d></c></a>");
}

TEST(MjcfTest, ScalesMeshesWithAndWithoutAScaleOrAnEndOfTheirOwn) {
  auto tags = parse_mjcf("<a><mesh name='m'></mesh><mesh scale='2 2 2'/></a>", "test");
  scale_body(tags, 0.5, 3, "test");
  EXPECT_EQ(print_mjcf(tags),
            "<a><mesh name=\"m\" scale=\"0.5 0.5 0.5\"></mesh><mesh scale=\"1 1 1\"/></a>");
}

TEST(MjcfTest, NamesTheLineOfWhatIsWrong) {
  const auto complaint = [](const std::string& text) -> std::string {
    return testing::complaint<ScenarioError>([&] { parse_mjcf(text, "test"); });
  };
  EXPECT_THAT(complaint("<a>\n<b></a>"),
              ::testing::StartsWith("test:2: The model is not valid XML"));
  EXPECT_THAT(complaint("<a>\n\ntext</a>"), ::testing::StartsWith("test:3: "));
  EXPECT_THAT(complaint("<a\nx=''\ny='&lt;'/>"), ::testing::StartsWith("test:3: The value of 'y'"));
  EXPECT_THAT(complaint("<a>\n<![CDATA[ ]]></a>"), HasSubstr("nothing else"));
  EXPECT_THAT(complaint("<!DOCTYPE a [<!ENTITY x 'y'>]>\n<a/>"), ::testing::StartsWith("test:1: "));
  EXPECT_THAT(complaint("<a x='1' x='2'/>"), HasSubstr("not valid XML"));
  EXPECT_THAT(complaint(std::string("<a/>\0<b/>", 9)), HasSubstr("zero byte"));
  std::string wide = "<a";
  for (int i = 0; i <= 20000; ++i) wide += " a" + std::to_string(i) + "=''";
  EXPECT_THAT(complaint(wide + "/>"), HasSubstr("more than 20000 attributes"));
  std::string deep;
  for (int i = 0; i < 100000; ++i) deep += "<a>";
  EXPECT_THAT(complaint(deep), HasSubstr("DEPTH"));
}

}  // namespace
}  // namespace dodgesim

#include "sim/base/joined.h"

#include <gtest/gtest.h>

#include <vector>

namespace dodgesim {
namespace {

TEST(Joined, PutsCommasBetweenAndItsOwnWordBeforeTheLast) {
  const auto alternatives = [](const std::vector<std::string>& names) {
    return joined(names, {}, " or ");
  };
  EXPECT_EQ(alternatives({}), "");
  EXPECT_EQ(alternatives({"a"}), "a");
  EXPECT_EQ(alternatives({"a", "b"}), "a or b");
  EXPECT_EQ(alternatives({"a", "b", "c"}), "a, b or c");
  EXPECT_EQ(joined(std::vector<std::string>{"a", "b", "c"}), "a, b, c");
}

TEST(Joined, TakesTheTextOfAnItemFromAFunctionOrAMember) {
  struct Named {
    std::string name;
  };
  EXPECT_EQ(joined(std::vector<Named>{{"x"}, {"y"}}, &Named::name), "x, y");
  EXPECT_EQ(joined(std::vector<int>{1, 2}, [](int n) { return std::to_string(n); }), "1, 2");
}

}  // namespace
}  // namespace dodgesim

#include "sim/files/csv.h"

#include <gtest/gtest.h>

#include <limits>

#include "sim/base/time.h"

namespace dodgesim {
namespace {

struct Nested {
  double a = 0.1;
  bool b = true;
  template <class Visitor>
  void visit(Visitor& v) {
    v("a", a);
    v("b", b);
  }
};

struct Row {
  int n = -3;
  Nested nested;
  std::array<double, 2> p{1.5, 2};
  std::optional<std::array<double, 2>> absent;
  std::optional<TimeUs> t_us = 12;
  std::string text = "a, \"b\"\nc";
  double nan = std::numeric_limits<double>::quiet_NaN();
  template <class Visitor>
  void visit(Visitor& v) {
    v("n", n);
    v("nested", nested);
    v("p", p);
    v("absent", absent);
    v("t_us", t_us);
    v("text", text);
    v("nan", nan);
  }
};

TEST(Csv, HeaderAndRowFollowTheList) {
  EXPECT_EQ(csv_header<Row>(), "n,nested_a,nested_b,p_0,p_1,absent_0,absent_1,t_us,text,nan\n");
  EXPECT_EQ(csv_row(Row{}), "-3,0.1,1,1.5,2,,,12,\"a, \"\"b\"\" c\",nan\n");
}

}  // namespace
}  // namespace dodgesim

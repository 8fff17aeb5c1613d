// Table 3 of measurements that nobody has taken.
#include "sim/paper/experiment.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "sim/base/error.h"

namespace dodgesim {
namespace {

using ::testing::HasSubstr;

// Each quantity of the case with a median of its own: 0.001 times its place, shares 0.01 times.
std::vector<Measurement> measured() {
  std::vector<Measurement> all;
  for (const BenchCase& bench : pilot_cases()) {
    for (const Quantity& quantity : bench.quantities) {
      const double scale = quantity.unit == "ms" ? 1e-3 : quantity.unit == "1" ? 1e-2 : 1;
      const double value = scale * static_cast<double>(all.size() + 1);
      all.push_back({quantity, {0, value, 1e6}});
    }
  }
  return all;
}

TEST(Table3, PutsMedianTimesBesideThePapers) {
  const PaperTables tables = table3_of(measured());
  EXPECT_THAT(tables.markdown, HasSubstr("| ego-motion compensation | 1.31 (0.35), 37 % | "
                                         "0.001 (0.002), 3 % | 0.017 (0.018), 19 % | "
                                         "0.033 (0.034), 35 % |"));
  EXPECT_THAT(tables.markdown,
              HasSubstr("| together | 3.56 (0.45) | 0.013 (0.014) | 0.029 (0.030) | "));
  EXPECT_THAT(tables.markdown, HasSubstr("| windows |  | 16 | 32 | 48 |"));
  EXPECT_THAT(tables.markdown, HasSubstr("Least squares: 49.0 ns an event"));
  EXPECT_THAT(tables.csv, HasSubstr("\npilot.6000.detection,0.0290,ms\n"));
}

TEST(Table3, SaysWhichQuantityItLacks) {
  std::vector<Measurement> some = measured();
  some.erase(some.begin() + 2);
  EXPECT_THROW(table3_of(some), ScenarioError);
}

}  // namespace
}  // namespace dodgesim

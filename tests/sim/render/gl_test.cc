#include "sim/render/gl.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "sim/base/error.h"
#include "tests/complaint.h"

namespace dodgesim {
namespace {

TEST(Gl, FunctionsAreFoundInOsmesa) {
  EXPECT_NE(find_in_osmesa("glEnable"), nullptr);
  EXPECT_EQ(osmesa::GetCurrentContext(), nullptr);
  EXPECT_THAT(testing::complaint<SimulationError>([] { find_in_osmesa("glDisenable"); }),
              ::testing::HasSubstr("no function glDisenable"));
}

}  // namespace
}  // namespace dodgesim

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <iterator>

#include "sim/render/osmesa_context.h"

namespace dodgesim {
namespace {

long threads() {
  const std::filesystem::directory_iterator tasks("/proc/self/task");
  return std::distance(begin(tasks), end(tasks));
}

// Workers that are forked from a process with Mesa's threads may wait for ever for one of them.
TEST(RendererName, StartsNoThread) {
  const long before = threads();
  const std::string name = renderer_name();
  EXPECT_THAT(name, ::testing::HasSubstr("llvmpipe"));
  EXPECT_EQ(threads(), before);
  EXPECT_EQ(name, OsmesaContext(GlProfile::kCore33, 1, 1).renderer());
}

}  // namespace
}  // namespace dodgesim

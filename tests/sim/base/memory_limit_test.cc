#include "sim/base/memory_limit.h"

#include <gtest/gtest.h>

#include <cstddef>
#include <new>
#include <string>

#include "sim/base/child_process.h"

namespace dodgesim {
namespace {

TEST(MemoryLimit, AnAllocationBeyondItThrows) {
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
  GTEST_SKIP() << "Sanitizers reserve more address space than any limit allows.";
#endif
  const auto allocate_gb = [](std::size_t gb) {
    return ask_child(
               [gb] {
                 limit_memory(2048);
                 try {
                   ::operator delete(::operator new(gb << 30));
                   return std::to_string(gb);
                 } catch (const std::bad_alloc&) {
                   return std::string("too much");
                 }
               },
               20000)
        .said;
  };
  EXPECT_EQ(allocate_gb(1), "1");
  EXPECT_EQ(allocate_gb(3), "too much");
}

TEST(MemoryLimit, AStricterOneStays) {
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
  GTEST_SKIP() << "Nothing is limited.";
#endif
  const auto after = [](std::int64_t first_mb, std::int64_t then_mb) {
    return ask_child(
               [=] {
                 limit_memory(first_mb);
                 limit_memory(then_mb);
                 return std::to_string(memory_limit_mb().value());
               },
               20000)
        .said;
  };
  EXPECT_EQ(after(2048, 4096), "2048");
  EXPECT_EQ(after(4096, 2048), "2048");
}

TEST(MemoryLimit, TheMachineHasSomeMemory) { EXPECT_GT(physical_memory_mb(), 256); }

}  // namespace
}  // namespace dodgesim

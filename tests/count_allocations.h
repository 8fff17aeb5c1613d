// Counts the calls of the malloc family, to which operator new and OpenCV's allocator come down.
// One file of a test program includes this: malloc is replaced in all of it.
#pragma once

#include <atomic>
#include <cerrno>
#include <cstdlib>

#if defined(__has_feature)
#if __has_feature(address_sanitizer) || __has_feature(thread_sanitizer)
#define DODGESIM_OWN_MALLOC 0
#endif
#endif
#if !defined(DODGESIM_OWN_MALLOC)
#if !defined(__GLIBC__) || defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
#define DODGESIM_OWN_MALLOC 0  // sanitizers replace malloc themselves
#else
#define DODGESIM_OWN_MALLOC 1
#endif
#endif

namespace {
std::atomic<long> allocations = 0;  // of all threads, since the program's start
}

#if DODGESIM_OWN_MALLOC
// glibc's own allocator under the names it keeps for programs that replace malloc.
extern "C" {
// NOLINTBEGIN(bugprone-reserved-identifier)
void* __libc_malloc(std::size_t size);
void* __libc_calloc(std::size_t count, std::size_t size);
void* __libc_realloc(void* block, std::size_t size);
void* __libc_memalign(std::size_t alignment, std::size_t size);

void* malloc(std::size_t size) noexcept {
  ++allocations;
  return __libc_malloc(size);
}
void* calloc(std::size_t count, std::size_t size) noexcept {
  ++allocations;
  return __libc_calloc(count, size);
}
void* realloc(void* block, std::size_t size) noexcept {
  ++allocations;
  return __libc_realloc(block, size);
}
void* memalign(std::size_t alignment, std::size_t size) noexcept {
  ++allocations;
  return __libc_memalign(alignment, size);
}
void* aligned_alloc(std::size_t alignment, std::size_t size) noexcept {
  return memalign(alignment, size);
}
int posix_memalign(void** block, std::size_t alignment, std::size_t size) noexcept {
  *block = memalign(alignment, size);
  return *block == nullptr ? ENOMEM : 0;
}
// NOLINTEND(bugprone-reserved-identifier)
}
#endif

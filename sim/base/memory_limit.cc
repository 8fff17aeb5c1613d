#include "sim/base/memory_limit.h"

#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>

#if defined(__has_feature)
#if __has_feature(address_sanitizer) || __has_feature(thread_sanitizer)
#define DODGESIM_SANITIZED
#endif
#endif
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
#define DODGESIM_SANITIZED
#endif

namespace dodgesim {

namespace {

constexpr int kMbBits = 20;

}  // namespace

void limit_memory([[maybe_unused]] std::int64_t memory_mb) {
#if !defined(DODGESIM_SANITIZED)
  rlimit limit{RLIM_INFINITY, RLIM_INFINITY};
  ::getrlimit(RLIMIT_AS, &limit);
  const auto bytes = static_cast<rlim_t>(memory_mb) << kMbBits;
  limit.rlim_cur = std::min(limit.rlim_cur, bytes);
  limit.rlim_max = std::min(limit.rlim_max, bytes);
  ::setrlimit(RLIMIT_AS, &limit);  // cannot fail: it only lowers
#endif
}

std::optional<std::int64_t> memory_limit_mb() {
  rlimit limit{RLIM_INFINITY, RLIM_INFINITY};
  ::getrlimit(RLIMIT_AS, &limit);
  if (limit.rlim_cur == RLIM_INFINITY) return std::nullopt;
  return static_cast<std::int64_t>(limit.rlim_cur >> kMbBits);
}

std::int64_t physical_memory_mb() {
  return static_cast<std::int64_t>(::sysconf(_SC_PHYS_PAGES)) * ::sysconf(_SC_PAGESIZE) >> kMbBits;
}

}  // namespace dodgesim

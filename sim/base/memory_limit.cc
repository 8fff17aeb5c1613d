#include "sim/base/memory_limit.h"

#include <sys/resource.h>
#include <unistd.h>

#if defined(__has_feature)
#if __has_feature(address_sanitizer) || __has_feature(thread_sanitizer)
#define DODGESIM_SANITIZED
#endif
#endif
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
#define DODGESIM_SANITIZED
#endif

namespace dodgesim {

void limit_memory([[maybe_unused]] std::int64_t memory_mb) {
#if !defined(DODGESIM_SANITIZED)
  const auto bytes = static_cast<rlim_t>(memory_mb) << 20;
  const rlimit limit = {bytes, bytes};
  ::setrlimit(RLIMIT_AS, &limit);
#endif
}

std::int64_t physical_memory_mb() {
  return static_cast<std::int64_t>(::sysconf(_SC_PHYS_PAGES)) * ::sysconf(_SC_PAGESIZE) >> 20;
}

}  // namespace dodgesim

#include "sim/base/progress.h"

#include <unistd.h>

#include <cmath>
#include <cstdio>
#include <utility>

#include "sim/base/formatted.h"

namespace dodgesim {

namespace {

constexpr std::chrono::milliseconds kShowEvery(200);

}  // namespace

Progress::Progress(std::int64_t total, std::string unit, bool visible)
    : total_(total),
      unit_(std::move(unit)),
      visible_(visible),
      begin_(WallClock::now()),
      shown_(begin_ - kShowEvery) {}

bool Progress::on_terminal() { return ::isatty(STDERR_FILENO) == 1; }

void Progress::show(std::int64_t finished) {
  if (!visible_) return;
  const auto now = WallClock::now();
  if (now - shown_ < kShowEvery) return;
  shown_ = now;
  const double passed_s = seconds_since(begin_);
  const double left_s =
      passed_s / static_cast<double>(finished) * static_cast<double>(total_ - finished);
  // \x1b[K clears what is left of a longer line.
  std::fprintf(stderr, "\r%lld of %lld %s, %s to go\x1b[K", static_cast<long long>(finished),
               static_cast<long long>(total_), unit_.c_str(), duration_text(left_s).c_str());
  std::fflush(stderr);
}

void Progress::finish() {
  if (visible_) std::fprintf(stderr, "\r\x1b[K");
  visible_ = false;
}

std::string duration_text(double duration_s) {
  const long s = std::lround(duration_s);
  if (s >= 3600) return formatted("%ld h %02ld min", s / 3600, s / 60 % 60);
  if (s >= 60) return formatted("%ld min %02ld s", s / 60, s % 60);
  return formatted("%ld s", s);
}

}  // namespace dodgesim

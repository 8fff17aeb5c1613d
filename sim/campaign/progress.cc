#include "sim/campaign/progress.h"

#include <cmath>
#include <cstdio>

namespace dodgesim {

Progress::Progress(int total, bool visible)
    : total_(total), visible_(visible), begin_(std::chrono::steady_clock::now()) {}

void Progress::show(int finished) {
  if (!visible_) return;
  const double passed_s =
      std::chrono::duration<double>(std::chrono::steady_clock::now() - begin_).count();
  const double left_s = passed_s / finished * (total_ - finished);
  // \x1b[K clears what is left of a longer line.
  std::fprintf(stderr, "\r%d of %d throws, %s to go\x1b[K", finished, total_,
               duration_text(left_s).c_str());
  std::fflush(stderr);
}

void Progress::finish() {
  if (visible_) std::fprintf(stderr, "\r\x1b[K");
}

std::string duration_text(double duration_s) {
  const long s = std::lround(duration_s);
  char text[48];
  if (s >= 3600) {
    std::snprintf(text, sizeof(text), "%ld h %02ld min", s / 3600, s / 60 % 60);
  } else if (s >= 60) {
    std::snprintf(text, sizeof(text), "%ld min %02ld s", s / 60, s % 60);
  } else {
    std::snprintf(text, sizeof(text), "%ld s", s);
  }
  return text;
}

}  // namespace dodgesim

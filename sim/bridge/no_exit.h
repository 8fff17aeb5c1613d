// Keeps the code of a pilot from ending the program as if all were well.
#pragma once

#include <unistd.h>

#include <cstdio>
#include <cstdlib>

namespace dodgesim {

// While there is one, exit() says so on standard error and ends the program with kExitCode; a
// process that a pilot makes of this one may end as it likes. For one thread, as all calls of
// pilots are. _exit() is not noticed, nor is exit() in a thread of the pilot's own while nobody
// calls it.
class NoExit {
 public:
  static constexpr int kExitCode = 3;  // a flight failed

  NoExit() {
    [[maybe_unused]] static const int registered = std::atexit(complain);
    if (depth_++ == 0) process_ = ::getpid();
  }
  ~NoExit() { --depth_; }
  NoExit(const NoExit&) = delete;
  NoExit& operator=(const NoExit&) = delete;

 private:
  static void complain() {
    if (depth_ == 0 || ::getpid() != process_) return;
    std::fflush(stdout);
    std::fputs("The pilot ended the program by exit().\n", stderr);
    std::_Exit(kExitCode);
  }

  static inline int depth_ = 0;
  static inline pid_t process_ = 0;
};

}  // namespace dodgesim

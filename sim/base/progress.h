// A progress line with the time to go, for a terminal.
#pragma once

#include <cstdint>
#include <string>

#include "sim/base/wall_clock.h"

namespace dodgesim {

class Progress {
 public:
  // `unit` is what is counted. Silent unless `visible`.
  Progress(std::int64_t total, std::string unit, bool visible = on_terminal());
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;
  ~Progress() { finish(); }  // so that an error message begins a line of its own

  void show(std::int64_t finished);  // of 1 and more; writes a few times a second at most
  void finish();                     // ends the line

  static bool on_terminal();  // whether standard error is one

 private:
  std::int64_t total_;
  std::string unit_;
  bool visible_;
  WallClock::time_point begin_;
  WallClock::time_point shown_;
};

// "1 h 05 min", "3 min 20 s", "12 s".
std::string duration_text(double duration_s);

}  // namespace dodgesim

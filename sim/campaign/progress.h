// A progress line with the time to go, for a terminal.
#pragma once

#include <chrono>
#include <string>

namespace dodgesim {

class Progress {
 public:
  // Silent unless `visible`.
  Progress(int total, bool visible);

  void show(int finished);
  void finish();  // ends the line

 private:
  int total_;
  bool visible_;
  std::chrono::steady_clock::time_point begin_;
};

// "1 h 05 min", "3 min 20 s", "12 s".
std::string duration_text(double duration_s);

}  // namespace dodgesim

// Events with their causes as a file.
//
// .npy  NumPy records t <i8 [us], x <u2, y <u2, p |i1 (+1 ON, -1 OFF), cause |u1.
// .txt  A line "t x y p cause" an event: t [us] as an integer, p 1 (ON) or 0 (OFF).
//
// Causes are those of sim/events/cause.h: 0 the static scene (moved by ego-motion), 1 + i object i,
// 253 leak, 254 shot noise, 255 a hot pixel.
#pragma once

#include <filesystem>
#include <span>
#include <string>

#include "sim/events/cause.h"
#include "sim/events/event.h"
#include "sim/files/output_file.h"

namespace dodgesim {

class LabelledEventFile {
 public:
  // All functions throw IoError when the file cannot be written. Throws ScenarioError for a name
  // that ends in neither .npy nor .txt.
  explicit LabelledEventFile(const std::filesystem::path& path);

  // Events in order of time, with a cause each.
  void add(std::span<const Event> events, std::span<const Cause> causes);

  // Completes the file. Without it nothing is left behind.
  void finish();

  std::uint64_t count() const { return count_; }

 private:
  std::string front() const;

  bool text_;
  OutputFile file_;
  std::string buffer_;
  std::uint64_t count_ = 0;
};

}  // namespace dodgesim

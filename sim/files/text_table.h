// A table of texts for people, as Markdown ("|" escaped) and as CSV.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "sim/statistics/interval.h"

namespace dodgesim {

struct TextTable {
  std::vector<std::string> head;
  std::vector<std::vector<std::string>> rows;  // each as long as the head

  std::string to_markdown() const;
  std::string to_csv() const;
};

// Digits behind the point: fixed_text(0.0731, 3) is "0.073".
std::string fixed_text(double value, int digits);

// "0.073 (0.065 to 0.081)"; "0.073" where the interval says nothing, without any finite end.
std::string with_interval(double value, const Interval& interval, int digits);

// "1 throw", "2 throws".
std::string count_text(std::int64_t count, const std::string& what);

}  // namespace dodgesim

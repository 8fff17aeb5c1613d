#include "sim/events/event_words.h"

#include <algorithm>
#include <array>
#include <utility>

namespace dodgesim {

// A radix sort by time alone, then the few of the same microsecond among themselves.
void EventWords::sort() {
  constexpr int kDigitBits = 11;
  constexpr std::uint64_t kDigitMask = (1u << kDigitBits) - 1;
  constexpr std::size_t kFew = 128;  // below, comparing is cheaper than counting
  if (words_.size() < kFew) {
    std::sort(words_.begin(), words_.end());
    return;
  }
  std::uint64_t latest = 0;
  for (const std::uint64_t word : words_) latest = std::max(latest, word >> kTimeShift);
  sorted_.resize(words_.size());
  for (int shift = kTimeShift; latest >> (shift - kTimeShift) != 0; shift += kDigitBits) {
    std::array<std::uint32_t, kDigitMask + 1> position{};
    for (const std::uint64_t word : words_) ++position[word >> shift & kDigitMask];
    std::uint32_t sum = 0;
    for (std::uint32_t& p : position) sum += std::exchange(p, sum);
    for (const std::uint64_t word : words_) sorted_[position[word >> shift & kDigitMask]++] = word;
    std::swap(words_, sorted_);
  }
  sort_ties();
}

void EventWords::sort_ties() {
  for (std::size_t first = 0; first < words_.size();) {
    std::size_t end = first + 1;
    while (end < words_.size() && words_[end] >> kTimeShift == words_[first] >> kTimeShift) ++end;
    const auto begin = words_.begin() + static_cast<std::ptrdiff_t>(first);
    if (end - first > 1) {
      std::sort(begin, words_.begin() + static_cast<std::ptrdiff_t>(end));
    }
    first = end;
  }
}

}  // namespace dodgesim

#include "sim/events/event_words.h"

#include <algorithm>
#include <array>
#include <utility>

namespace dodgesim {

namespace {

void insertion_sort(std::uint64_t* begin, std::uint64_t* end) {
  for (std::uint64_t* next = begin + 1; next < end; ++next) {
    const std::uint64_t word = *next;
    std::uint64_t* at = next;
    for (; at > begin && at[-1] > word; --at) *at = at[-1];
    *at = word;
  }
}

}  // namespace

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

// Most words are in order already.
void EventWords::sort_ties() {
  constexpr std::ptrdiff_t kFewTies = 16;
  if (words_.empty()) return;
  const auto time = [](std::uint64_t word) { return word >> kTimeShift; };
  std::uint64_t* const begin = words_.data();
  std::uint64_t* const end = begin + words_.size();
  std::uint64_t* at = begin + 1;
  while (at < end) {
    if (at[-1] <= at[0]) {
      ++at;
      continue;
    }
    std::uint64_t* first = at - 1;
    while (first > begin && time(first[-1]) == time(*at)) --first;
    while (at < end && time(*at) == time(*first)) ++at;
    if (at - first <= kFewTies) {
      insertion_sort(first, at);
    } else {
      std::sort(first, at);
    }
  }
}

}  // namespace dodgesim

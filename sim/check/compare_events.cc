#include "sim/check/compare_events.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

#include "sim/check/quantile.h"

namespace dodgesim {

namespace {

std::uint32_t pixel(const Event& event) {
  return static_cast<std::uint32_t>(event.y) << 16 | event.x;
}

// By pixel, in order of time within each.
std::vector<Event> by_pixel(std::span<const Event> events) {
  std::vector<Event> sorted(events.begin(), events.end());
  std::ranges::stable_sort(sorted,
                           [](const Event& a, const Event& b) { return pixel(a) < pixel(b); });
  return sorted;
}

// The events of the first pixel of the rest of a sorted stream, and of none if that is another.
std::span<const Event> take(std::span<const Event>& rest, std::uint32_t wanted) {
  std::size_t size = 0;
  while (size < rest.size() && pixel(rest[size]) == wanted) ++size;
  const auto taken = rest.first(size);
  rest = rest.subspan(size);
  return taken;
}

void pair_up(std::span<const Event> a, std::span<const Event> b, std::vector<double>& apart_us) {
  const auto add = [&](const Event& p, const Event& q) {
    apart_us.push_back(std::abs(static_cast<double>(p.t_us - q.t_us)));
  };
  std::size_t front = 0;
  const std::size_t shorter = std::min(a.size(), b.size());
  while (front < shorter && a[front].polarity == b[front].polarity) {
    add(a[front], b[front]);
    ++front;
  }
  if (a.size() == b.size() && front == shorter) return;
  for (std::size_t back = 1; front + back <= shorter; ++back) {
    const Event& p = a[a.size() - back];
    const Event& q = b[b.size() - back];
    if (p.polarity != q.polarity) return;
    add(p, q);
  }
}

}  // namespace

EventDifference compare(std::span<const Event> events, std::span<const Event> reference) {
  const std::vector<Event> sorted = by_pixel(events), sorted_reference = by_pixel(reference);
  std::span<const Event> a = sorted, b = sorted_reference;
  std::vector<double> apart_us;
  while (!a.empty() && !b.empty()) {
    const std::uint32_t wanted = std::min(pixel(a.front()), pixel(b.front()));
    const auto mine = take(a, wanted);
    const auto theirs = take(b, wanted);
    pair_up(mine, theirs, apart_us);
  }
  EventDifference difference;
  difference.events = static_cast<double>(events.size());
  difference.reference_events = static_cast<double>(reference.size());
  difference.count_ratio = difference.events / difference.reference_events;
  difference.matched = static_cast<double>(apart_us.size()) / difference.reference_events;
  difference.median_us = quantile(apart_us, 0.5);
  difference.percentile_90_us = quantile(apart_us, 0.9);
  return difference;
}

}  // namespace dodgesim

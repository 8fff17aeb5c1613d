// How two streams of events of the same scene differ.
#pragma once

#include <span>

#include "sim/events/event.h"

namespace dodgesim {

struct EventDifference {
  double events = 0, reference_events = 0;
  double count_ratio = 0;  // events / reference events
  double matched = 0;      // share of the reference's events that have a partner
  double median_us = 0;    // of the distances between the stamps of partners
  double percentile_90_us = 0;
};

// How far a sampling's events may be from a much finer one's: of their count, and the median of
// stamps.
constexpr double kSamplingCountLimit = 0.01, kSamplingStampLimitUs = 50;

// Partners are events of the same pixel. Where its two sequences of polarities are the same, they
// are paired in order; elsewhere as far as the sequences agree from the beginning, and from the
// end. Both streams in order of time.
EventDifference compare(std::span<const Event> events, std::span<const Event> reference);

}  // namespace dodgesim

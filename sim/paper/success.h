// Whether a passing object was in view within a range of distances, and detected there: the
// paper's Table 2.
#pragma once

#include <vector>

#include "sim/outcome/result.h"
#include "sim/paper/passage.h"

namespace dodgesim {

// Of distances from the reference camera to the object's centre: (from, to].
struct RangeBin {
  double from_m = 0, to_m = 0;

  bool contains(double range_m) const { return range_m > from_m && range_m <= to_m; }
};

enum class Visibility {
  kCentre,  // its centre is in the image of every camera
  kWhole,   // its outline lies wholly in the image of every camera
};

bool in_view(const ObjectView& view, Visibility visibility);

// In view for less than one window of events it cannot be detected, and does not count.
inline constexpr TimeUs kLeastVisibleUs = 10000;

// One object, while its distance lies in a bin.
struct TimeInView {
  TimeUs visible_us = 0;  // counted in milliseconds
  int detections = 0;     // of it (on_outline()), at an instant at which it was in view in the bin
  // Pieces of kLeastVisibleUs in view without a gap, one after the other, and where those begin
  // that hold no detection of it.
  int pieces = 0;
  std::vector<TimeUs> missed_us;

  int detected_pieces() const { return pieces - static_cast<int>(missed_us.size()); }
  bool counts() const { return visible_us >= kLeastVisibleUs; }
  bool detected() const { return detections > 0; }
};

TimeInView time_in_view(const Passage& passage, const std::vector<DetectionRow>& detections,
                        const RangeBin& bin, Visibility visibility);

}  // namespace dodgesim

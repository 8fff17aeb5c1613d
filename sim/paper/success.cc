#include "sim/paper/success.h"

#include <algorithm>

namespace dodgesim {

bool in_view(const ObjectView& view, Visibility visibility) {
  return visibility == Visibility::kWhole ? view.whole_in_view : view.centre_in_view;
}

TimeInView time_in_view(const Passage& passage, const std::vector<DetectionRow>& detections,
                        const RangeBin& bin, Visibility visibility) {
  constexpr TimeUs kStepUs = 1000;
  std::vector<TimeUs> detected_us;
  for (const DetectionRow& row : detections) {
    const std::optional<ObjectView> view = passage.at(row.t_us);
    if (view && bin.contains(view->range_m()) && in_view(*view, visibility) &&
        on_outline(*view, position_of(row))) {
      detected_us.push_back(row.t_us);
    }
  }
  TimeInView time;
  time.detections = static_cast<int>(detected_us.size());
  TimeUs piece_us = 0;  // of the piece that grows
  for (TimeUs t_us = passage.start_us(); t_us <= passage.end_us(); t_us += kStepUs) {
    const std::optional<ObjectView> view = passage.at(t_us);
    if (!view || !bin.contains(view->range_m()) || !in_view(*view, visibility)) {
      piece_us = 0;
      continue;
    }
    time.visible_us += kStepUs;
    piece_us += kStepUs;
    if (piece_us < kLeastVisibleUs) continue;
    const TimeUs end_us = t_us + kStepUs, begin_us = end_us - piece_us;
    const bool detected =
        std::ranges::any_of(detected_us, [&](TimeUs at) { return at >= begin_us && at < end_us; });
    ++time.pieces;
    if (!detected) time.missed_us.push_back(begin_us);
    piece_us = 0;
  }
  return time;
}

}  // namespace dodgesim

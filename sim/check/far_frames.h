// Whether frames that are far apart, as of a video, give the events of the light between them.
#pragma once

#include <cstdint>
#include <vector>

#include "sim/check/check.h"
#include "sim/check/compare_events.h"
#include "sim/events/spec.h"

namespace dodgesim {

struct FarFrames {
  TimeUs interval_us = 0;      // between two frames
  EventDifference difference;  // of light_between.h's steps from much finer ones
  bool too_slow = false;       // the pixels, for steps so fine: nothing can be told
  double early_us = 0;         // by how much the cut-off of a step may make a low-pass early
};

std::vector<FarFrames> measure_far_frames(const EventCameraSpec& camera, std::uint64_t seed);

Check judge(const std::vector<FarFrames>& intervals);

}  // namespace dodgesim

// What the sampling of the rendered scene costs in accuracy: the same random throws, with a vehicle
// that moves as it is told, seen by a camera that is sampled in several ways, against one that is
// sampled eight times finer and for which every picture is drawn.
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "sim/check/check.h"
#include "sim/flight/event_rig.h"

namespace dodgesim {

// A way to sample.
struct SamplingVariant {
  std::string name;
  SamplingSpec sampling = {};
  KeySpec keys = {};
  bool whole_pictures = false;  // objects' regions are taken as whole pictures
};

// What is given, the same with whole pictures, a coarser and a finer sampling, and what is given
// with one parameter changed.
std::vector<SamplingVariant> sampling_variants(const SamplingSpec& sampling = {},
                                               const KeySpec& keys = {});

// Eight times finer than the defaults, every picture drawn anew and as finely as can be.
SamplingVariant sampling_reference();

struct SamplingOptions {
  std::string models_dir;
  int throws = 50;
  std::uint64_t seed = 1;
  EventCameraSpec camera;  // its noise is left out
  Intrinsics intrinsics;
  RenderSpec render;
  std::string object = "ball";  // what is thrown: a file of the models' objects
  TimeUs film_us = 30000;       // of each throw; whole ticks
};

// Events of an object or of the static scene, over all throws.
struct SamplingAccuracy {
  double events = 0, reference_events = 0;
  double worst_count = 0;      // the largest |ratio - 1| of a throw with 300 events and more
  int judged_throws = 0;       // how many of these there are
  double median_us = 0;        // median over them of the median stamp difference
  double worst_median_us = 0;  // the largest of them
  double count_ratio() const { return events / reference_events; }
};

struct SamplingResult {
  std::string variant;
  SamplingAccuracy object, scene;
  double pictures = 0, regions = 0, keys = 0;  // a throw
  double simulated_per_s = 0;  // seconds of flight a second of drawing and emulation
};

// One for each variant. `report` hears of the progress: throws done.
std::vector<SamplingResult> study_sampling(const SamplingOptions& options,
                                           const std::vector<SamplingVariant>& variants,
                                           const std::function<void(int)>& report);

// A Markdown table of the results.
std::string sampling_table(const std::vector<SamplingResult>& results);

// The limits hold for the first variant.
Check judge(const std::vector<SamplingResult>& results);

}  // namespace dodgesim

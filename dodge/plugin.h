// A pilot in a shared library of its own, which the simulator loads: `dodgesim run --plugin
// FILE.so` and `pilot: plugin` in the scenario. dodge/example/ is one.
#pragma once

#include <cstdint>
#include <memory>
#include <string>

#include "dodge/config.h"
#include "dodge/pilot.h"

namespace dodge {

// Makes the pilot of one flight. `config` has the calibration (the upper camera first) and the keys
// of `dodger`; `parameters` is the text of the key `plugin_parameters`. Both are valid during
// the call only: copy what you need. If something is wrong with either, throw a std::exception with
// a sentence that says so.
//
// What the simulator does with a pilot:
// - Just before each update() it hands over all that has arrived: the IMU's samples, then state
//   estimates, range readings, the packets of camera 0, and those of camera 1.
// - It does not tell rates and delays, which are keys of the scenario. By default: IMU 1000 Hz,
//   state estimates 250 Hz, range 200 Hz, packets of 1 ms, a cycle every 4 ms
//   (`dodgesim explain sensors`, `dodgesim explain delays`).
// - A command that evades is followed at once, at up to controller.evading_speed_limit_mps (5 m/s);
//   others are smoothed. The heading cannot be commanded: the vehicle keeps that of its start.
// - The first command with `landing` counts for good, whatever comes later: a gentle touch-down
//   ends the flight and is no crash, and a throw that would have hit after it is not dodged.
// - It looks at a detection's t_us and centre_W: those within 0.5 m of the true object's centre
//   (more for objects larger than 30 cm) count (scenarios/README.md, first_detection_us). Of the
//   other fields it writes obstacle_id, size_m, depth_m and depth_sigma_m to detections.csv and
//   draws some. obstacles() may be empty: only `dodgesim detect` reads it.
// - A flight fails if a command or a detection speaks of an instant after now_us, or a detection of
//   0 or before, or of more than a second ago; if a number of theirs (but p_W and
//   distance_per_depth) is not finite or beyond a million; or if a detection's size_m or
//   depth_sigma_m is negative.
// - Every process flies many throws: what a plug-in changes of it (std::locale::global(), signals,
//   open files) meets those after it, too.
using MakePilot = std::unique_ptr<Pilot>(const Config& config, const std::string& parameters);

// Differs between a library and a simulator that were compiled with different headers of dodge/, or
// with options that change how these classes lie in memory (-march=native).
inline constexpr std::uint64_t kPluginInterface = [] {
  std::uint64_t number = 1;  // raise it when classes change and no size does
  for (const std::size_t size :
       {sizeof(Config), sizeof(CameraModel), sizeof(Event), sizeof(ImuSample), sizeof(RangeReading),
        sizeof(StateEstimate), sizeof(Goal), sizeof(VelocityCommand), sizeof(Detection),
        sizeof(Obstacle), sizeof(std::string), alignof(Config), alignof(StateEstimate),
        alignof(Detection)}) {
    number = number * 1009 + size;
  }
  return number;
}();

}  // namespace dodge

// Write this once in the library, outside of namespaces; `make` is a dodge::MakePilot.
#define DODGE_PLUGIN(make)                                                                   \
  extern "C" __attribute__((visibility("default"))) std::uint64_t dodge_plugin_interface() { \
    return dodge::kPluginInterface;                                                          \
  }                                                                                          \
  extern "C" __attribute__((visibility("default"))) dodge::Pilot* dodge_plugin_pilot(        \
      const dodge::Config& config, const std::string& parameters) {                          \
    return std::unique_ptr<dodge::Pilot>(make(config, parameters)).release();                \
  }

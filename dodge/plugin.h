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
// of `dodger`; `parameters` is the text of the key `plugin_parameters`. What is wrong with either
// is thrown as a std::exception with a sentence.
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

// Stands once in the library, outside of namespaces; `make` is a dodge::MakePilot.
#define DODGE_PLUGIN(make)                                                                   \
  extern "C" __attribute__((visibility("default"))) std::uint64_t dodge_plugin_interface() { \
    return dodge::kPluginInterface;                                                          \
  }                                                                                          \
  extern "C" __attribute__((visibility("default"))) dodge::Pilot* dodge_plugin_pilot(        \
      const dodge::Config& config, const std::string& parameters) {                          \
    return std::unique_ptr<dodge::Pilot>(make(config, parameters)).release();                \
  }

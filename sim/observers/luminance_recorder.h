// Writes what a camera of the vehicle sees at a steady rate, as linear luminance: as the event
// camera is shown it, at instants of its own.
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <vector>

#include "sim/config/scenario.h"
#include "sim/flight/flight_observer.h"
#include "sim/recordings/frame_writer.h"
#include "sim/render/keyed_view.h"
#include "sim/render/luminance_renderer.h"

namespace dodgesim {

class LuminanceRecorder : public FlightObserver {
 public:
  // `camera`: index into kCameraNames; rate_hz > 0: pictures are of the first tick of the
  // simulation at or after their instants, from 1 / rate_hz on. Throws IoError; on_tick(), too, and
  // ScenarioError if the vehicle has no such camera.
  LuminanceRecorder(const std::filesystem::path& frames, const std::filesystem::path& times,
                    const Scenario& scenario, int throw_index, int camera, double rate_hz);

  void on_tick(const World& world) override;
  void commit() { writer_.commit(); }
  std::int64_t count() const { return writer_.count(); }

 private:
  Intrinsics intrinsics_;
  RenderSpec render_;
  double flicker_phase_rad_;
  std::size_t camera_;
  double rate_hz_;
  KeyedView view_;                               // of the static scene
  std::unique_ptr<LuminanceRenderer> renderer_;  // of the flight's world
  std::vector<float> luminance_;
  FrameWriter writer_;
};

}  // namespace dodgesim

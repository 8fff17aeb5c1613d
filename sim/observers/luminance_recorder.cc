#include "sim/observers/luminance_recorder.h"

#include <algorithm>
#include <string>

#include "sim/base/error.h"
#include "sim/flight/setup.h"
#include "sim/render/flicker.h"

namespace dodgesim {

LuminanceRecorder::LuminanceRecorder(const std::filesystem::path& frames,
                                     const std::filesystem::path& times, const Scenario& scenario,
                                     int throw_index, int camera, double rate_hz)
    : intrinsics_(intrinsics(scenario.sensors.camera)),
      render_(scenario.sensors.render),
      flicker_phase_rad_(flicker_phase_rad(scenario.seed, static_cast<std::uint64_t>(throw_index))),
      camera_(static_cast<std::size_t>(camera)),
      rate_hz_(rate_hz),
      view_(intrinsics_, scenario.sensors.keys),
      luminance_(static_cast<std::size_t>(intrinsics_.width) *
                 static_cast<std::size_t>(intrinsics_.height)),
      writer_(frames, times, intrinsics_.width, intrinsics_.height) {}

void LuminanceRecorder::on_tick(const World& world) {
  const Snapshot& now = world.snapshot();
  const double next_s = static_cast<double>(writer_.count() + 1) / rate_hz_;
  if (seconds(now.t_us) < next_s - 1e-9) return;
  const std::vector<Eigen::Isometry3d>& X_BC = world.vehicle().X_BC;
  if (camera_ >= X_BC.size()) {
    throw ScenarioError(std::string("The vehicle has no camera ") + kCameraNames.at(camera_) + ".");
  }
  if (!renderer_) renderer_ = std::make_unique<LuminanceRenderer>(world, intrinsics_, render_);
  const Eigen::Isometry3d X_WC = now.vehicle.pose() * X_BC[camera_];
  const Rect whole = {0, 0, intrinsics_.width, intrinsics_.height};
  view_.show(*renderer_, X_WC, whole, luminance_.data());
  renderer_->draw_objects(now, X_WC, whole, true, luminance_.data(), nullptr);
  const auto factor =
      static_cast<float>(flicker_factor(render_.flicker, flicker_phase_rad_, now.t_us));
  std::ranges::for_each(luminance_, [factor](float& light) { light *= factor; });
  writer_.add(now.t_us, luminance_);
}

}  // namespace dodgesim

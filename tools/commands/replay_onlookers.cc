#include "tools/commands/replay_onlookers.h"

#include <iostream>

#include "sim/base/formatted.h"
#include "sim/base/numbers.h"
#include "sim/config/pilot.h"
#include "sim/flight/setup.h"
#include "sim/outcome/fate.h"
#include "sim/recordings/event_writer.h"
#include "tools/commands/command.h"
#include "tools/commands/stop_signal.h"

namespace dodgesim {

namespace {

constexpr TimeUs kUsPerMs = 1000;

int camera_index(const ReplayArguments& arguments) {
  return arguments.camera_name() == kCameraNames[0] ? 0 : 1;
}

std::unique_ptr<EventRecorder> make_event_recorder(const Scenario& scenario,
                                                   const ReplayArguments& arguments) {
  const CameraSpec& camera = scenario.sensors.camera;
  return std::make_unique<EventRecorder>(
      arguments.events, Recording{camera.width, camera.height, 0, kLongestFlightUs, true},
      camera_index(arguments));
}

// "dodged, at least 0.23 m between the surfaces"
std::string verdict_text(const ThrowResult& result) {
  const std::optional<double>& clearance_m = result.flown.clearance_m;
  std::string fate = to_text(fate_of(result));
  if (!clearance_m || result.flown.hit) return fate;
  return fate + formatted(", at least %.2f m between the surfaces", *clearance_m);
}

}  // namespace

void Stopper::on_tick(const World& /*world*/) { end_if_asked_to_stop(); }

FlightProgress::FlightProgress(TimeUs duration_us)
    : progress_(duration_us / kUsPerMs, "ms of flight") {}

void FlightProgress::on_tick(const World& world) {
  // Before, the cost of the first pictures would spoil the estimate of the time that is left.
  constexpr TimeUs kFirstUs = 50 * kUsPerMs;
  if (world.snapshot().t_us >= kFirstUs) progress_.show(world.snapshot().t_us / kUsPerMs);
}

Onlookers::Onlookers(const Scenario& scenario, const ReplayArguments& arguments,
                     std::optional<TimeUs> duration_us)
    : arguments_(arguments),
      tells_truth_(scenario.pilot != kPluginPilot),
      poster_(intrinsics(scenario.sensors.camera), scenario.sensors.render) {
  observers_.add(&stopper_);
  if (duration_us) observers_.add(&progress_.emplace(*duration_us));
  const Intrinsics camera = intrinsics(scenario.sensors.camera);
  const int cameras = cameras_in_use(scenario);
  if (!arguments.video.empty()) {
    film_ = std::make_unique<Film>(arguments.video, camera, cameras, arguments.slow);
    observers_.add(film_.get());
  }
  if (!arguments.stages.empty()) {
    stages_ = std::make_unique<StageFilm>(arguments.stages);
    observers_.add(stages_.get());
  }
  if (!arguments.mcap.empty()) {
    mcap_ =
        std::make_unique<McapRecorder>(arguments.mcap, camera, cameras, scenario.delays.pilot_us());
    observers_.add(mcap_.get());
  }
  if (!arguments.picture.empty()) {
    picture_.emplace(arguments.picture);
    observers_.add(&poster_);
  }
  if (!arguments.record.empty()) {
    log_ = std::make_unique<VehicleLog>(arguments.record, scenario);
    observers_.add(log_.get());
  }
  if (!arguments.frames.empty()) {
    frames_ = std::make_unique<LuminanceRecorder>(arguments.frames, arguments.timestamps, scenario,
                                                  arguments.throw_index, camera_index(arguments),
                                                  arguments.frames_hz);
    observers_.add(frames_.get());
  }
  if (!arguments.events.empty()) {
    events_ = make_event_recorder(scenario, arguments);
    observers_.add(events_.get());
    observers_.add(&truth_);
  }
}

void Onlookers::end_progress() {
  if (progress_) progress_->finish();
}

bool Onlookers::finish(const ThrowResult& result) {
  if (mcap_) {
    mcap_->finish(result);
    std::cout << "Recording for Foxglove or Lichtblick: " << arguments_.mcap << "\n";
  }
  if (result.flown.failed()) {
    const bool more = film_ || stages_ || events_ || log_ || frames_ || picture_;
    if (more) std::cerr << "Of a flight that fails --mcap alone shows something.\n";
    return !more;
  }
  if (events_) finish_events();
  const bool framed = !frames_ || finish_frames();
  if (log_) {
    log_->finish();
    std::cout << "Recorded as the vehicle would: " << arguments_.record << "\n";
  }
  if (film_) {
    film_->finish(verdict_text(result));
    std::cout << "Video: " << arguments_.video << "\n";
  }
  if (stages_) {
    std::cout << stages_->pictures() << " pictures of the pilot's stages: " << arguments_.stages
              << "\n";
  }
  return finish_picture() && framed;
}

bool Onlookers::finish_frames() {
  if (frames_->count() < 2) {
    std::cerr << "The flight is too short for two frames at --frames-hz "
              << to_text(arguments_.frames_hz) << ".\n";
    return false;
  }
  frames_->commit();
  std::cout << frames_->count() << " frames of the " << arguments_.camera_name()
            << " camera: " << arguments_.frames << "\n";
  return true;
}

void Onlookers::finish_events() {
  events_->commit();
  EventTruthSums sums;
  sums.add(truth_.rows());
  std::cout << events_->count() << " events of the " << arguments_.camera_name()
            << " camera: " << arguments_.events << "\n";
  if (tells_truth_) std::cout << truth_text(sums) << "\n";
}

bool Onlookers::finish_picture() {
  if (!picture_) return true;
  if (!poster_.save(*picture_)) {
    std::cerr << "There is no picture to make: the flight ended before anything was thrown.\n";
    return false;
  }
  std::cout << "Picture: " << arguments_.picture << "\n";
  return true;
}

}  // namespace dodgesim

// Who looks on while `dodgesim replay` flies a throw again: films, recordings, pictures.
#pragma once

#include <memory>
#include <optional>
#include <string>

#include "sim/base/progress.h"
#include "sim/config/scenario.h"
#include "sim/files/output_file.h"
#include "sim/observers/event_recorder.h"
#include "sim/observers/event_truth.h"
#include "sim/observers/film.h"
#include "sim/observers/luminance_recorder.h"
#include "sim/observers/mcap_recorder.h"
#include "sim/observers/observers.h"
#include "sim/observers/poster.h"
#include "sim/observers/stage_panels.h"
#include "sim/observers/vehicle_log.h"
#include "sim/outcome/result.h"

namespace dodgesim {

struct ReplayArguments {
  std::string directory;
  std::string models_dir;
  std::string plugin;
  int throw_index = 0;
  std::string video, stages, picture, mcap, events, record;  // where they go; empty: none
  std::string frames, timestamps;                            // both or none
  double frames_hz = 1000;
  double slow = 10;    // of the video
  std::string camera;  // empty: top

  std::string camera_name() const { return camera.empty() ? kCameraNames[0] : camera; }
};

// Ends the flight when the user asks for it.
class Stopper : public FlightObserver {
 public:
  void on_tick(const World& world) override;
};

// Says on a terminal how far the flight is.
class FlightProgress : public FlightObserver {
 public:
  explicit FlightProgress(TimeUs duration_us);
  void on_tick(const World& world) override;
  void finish() { progress_.finish(); }

 private:
  Progress progress_;
};

// Everything that looks on, as the arguments ask for.
class Onlookers {
 public:
  // `duration_us`: how long the flight is, if known.
  Onlookers(const Scenario& scenario, const ReplayArguments& arguments,
            std::optional<TimeUs> duration_us);

  FlightObserver* observer() { return &observers_; }

  // Before anything else is written to the terminal.
  void end_progress();

  // Completes the files and says what they are; false if something cannot be shown. Of a flight
  // that failed there is only the recording for Foxglove, which shows how.
  bool finish(const ThrowResult& result);

 private:
  void finish_events();
  bool finish_frames();
  bool finish_picture();

  const ReplayArguments& arguments_;
  bool tells_truth_;  // of its windows, which of a plug-in nobody knows
  Observers observers_;
  Stopper stopper_;
  std::optional<FlightProgress> progress_;
  std::unique_ptr<Film> film_;
  std::unique_ptr<StageFilm> stages_;
  std::unique_ptr<McapRecorder> mcap_;
  std::unique_ptr<VehicleLog> log_;
  std::unique_ptr<LuminanceRecorder> frames_;
  Poster poster_;
  std::optional<OutputFile> picture_;  // the poster's
  EventTruth truth_;
  std::unique_ptr<EventRecorder> events_;
};

}  // namespace dodgesim

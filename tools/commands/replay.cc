// dodgesim replay: flies one throw of a campaign again, bit-identically.
#include <algorithm>
#include <fstream>
#include <iostream>
#include <memory>
#include <vector>

#include "sim/base/error.h"
#include "sim/campaign/csv.h"
#include "sim/config/expand.h"
#include "sim/event_truth.h"
#include "sim/files/labelled_event_file.h"
#include "sim/film.h"
#include "sim/loop.h"
#include "sim/poster.h"
#include "sim/try_models.h"
#include "tools/commands/command.h"

namespace dodgesim {

namespace {

struct Arguments {
  std::string directory;
  std::string models_dir;
  int throw_index = 0;
  std::string video;    // empty: none
  std::string stages;   // empty: none
  std::string picture;  // empty: none
  std::string events;   // empty: none
  std::string camera = "top";
};

// Hands everything on to several observers.
class Observers : public FlightObserver {
 public:
  void add(FlightObserver* observer) { observers_.push_back(observer); }
  bool wants_causes() const override {
    return std::any_of(observers_.begin(), observers_.end(),
                       [](const FlightObserver* o) { return o->wants_causes(); });
  }
  void on_start(dodge::Pilot& pilot) override {
    for (FlightObserver* o : observers_) o->on_start(pilot);
  }
  void on_tick(const World& world) override {
    for (FlightObserver* o : observers_) o->on_tick(world);
  }
  void on_imu(const ImuReading& reading) override {
    for (FlightObserver* o : observers_) o->on_imu(reading);
  }
  void on_state(const StateReading& reading) override {
    for (FlightObserver* o : observers_) o->on_state(reading);
  }
  void on_events(int camera, const Packet& packet) override {
    for (FlightObserver* o : observers_) o->on_events(camera, packet);
  }
  void on_cycle(TimeUs now_us, const dodge::Pilot& pilot) override {
    for (FlightObserver* o : observers_) o->on_cycle(now_us, pilot);
  }
  void on_command(TimeUs now_us, bool evading) override {
    for (FlightObserver* o : observers_) o->on_command(now_us, evading);
  }

 private:
  std::vector<FlightObserver*> observers_;
};

// Writes a camera's events with their causes.
class EventRecorder : public FlightObserver {
 public:
  EventRecorder(const std::string& path, int camera) : file_(path), camera_(camera) {}
  bool wants_causes() const override { return true; }
  void on_events(int camera, const Packet& packet) override {
    if (camera == camera_) file_.add(packet.events, packet.causes);
  }
  void finish() { file_.finish(); }
  std::uint64_t count() const { return file_.count(); }

 private:
  LabelledEventFile file_;
  int camera_;
};

// Line of throws.csv for this throw, with its line end.
std::string recorded_row(const std::string& path, int throw_index) {
  std::ifstream file(path);
  if (!file) throw IoError(path + " could not be opened; is this the directory of a campaign?");
  std::string line;
  for (int i = 0; i <= throw_index + 1; ++i) {
    if (!std::getline(file, line)) {
      throw ScenarioError(path + " has no throw " + std::to_string(throw_index) + ".");
    }
  }
  return line + "\n";
}

int replay(const Arguments& arguments) {
  const std::string& directory = arguments.directory;
  const Scenario campaign =
      load_scenario(directory + "/scenario.resolved.yaml", arguments.models_dir);
  if (arguments.throw_index >= throw_count(campaign)) {
    throw ScenarioError(directory + " has no throw " + std::to_string(arguments.throw_index) + ".");
  }
  try_models(campaign);
  const Scenario scenario = case_of(campaign, arguments.throw_index).scenario;
  const std::string recorded = recorded_row(directory + "/throws.csv", arguments.throw_index);

  Observers observers;
  std::unique_ptr<Film> film;
  if (!arguments.video.empty()) {
    film = std::make_unique<Film>(arguments.video, intrinsics(scenario.sensors.camera));
    observers.add(film.get());
  }
  std::unique_ptr<StageFilm> stages;
  if (!arguments.stages.empty()) {
    stages = std::make_unique<StageFilm>(arguments.stages);
    observers.add(stages.get());
  }
  Poster poster(intrinsics(scenario.sensors.camera));
  if (!arguments.picture.empty()) observers.add(&poster);
  EventTruth truth;
  std::unique_ptr<EventRecorder> recorder;
  if (!arguments.events.empty()) {
    recorder = std::make_unique<EventRecorder>(arguments.events, arguments.camera == "top" ? 0 : 1);
    observers.add(recorder.get());
    observers.add(&truth);
  }
  const ThrowResult result = fly_throw(campaign, arguments.throw_index, &observers);
  if (!arguments.picture.empty()) poster.save(arguments.picture);
  if (recorder) {
    recorder->finish();
    EventTruthSums sums;
    sums.add(truth.rows());
    std::cout << recorder->count() << " events of the " << arguments.camera
              << " camera: " << arguments.events << "\n"
              << truth_text(sums) << "\n";
  }
  if (film) {
    film->close();
    std::cout << "Video: " << arguments.video << "\n";
  }
  if (stages) {
    std::cout << stages->pictures() << " pictures of the pilot's stages: " << arguments.stages
              << "\n";
  }
  const std::string flown = csv_row(result);
  if (flown == recorded) {
    std::cout << "Throw " << arguments.throw_index << " flew as recorded, bit for bit.\n";
    return kOk;
  }
  std::cerr << "Throw " << arguments.throw_index
            << " did not fly as recorded: was it another commit or another kind of machine?\n"
            << "recorded: " << recorded << "flown:    " << flown;
  return kBelowBar;
}

}  // namespace

void add_replay_command(CLI::App& program, int& exit_code) {
  auto arguments = std::make_shared<Arguments>();
  CLI::App* command = program.add_subcommand("replay", "Fly one throw of a campaign again");
  command->add_option("directory", arguments->directory, "What `dodgesim run --out DIR` wrote")
      ->required()
      ->type_name("DIR");
  command->add_option("--throw", arguments->throw_index, "Number of the throw, from 0")
      ->required()
      ->check(CLI::NonNegativeNumber);
  command
      ->add_option("--video", arguments->video,
                   "Write a video: the scene and both event streams, ten times slower")
      ->type_name("FILE.mp4");
  command
      ->add_option("--stages", arguments->stages,
                   "Write the pilot's stages, a PNG for each of its cycles")
      ->type_name("DIR2");
  command
      ->add_option("--picture", arguments->picture,
                   "Write one picture: both flight paths and what the pilot first noticed")
      ->type_name("FILE.png");
  command
      ->add_option("--events", arguments->events,
                   "Write a camera's events with their causes (t, x, y, p, cause), and print how\n"
                   "well the pilot finds an object's events. Causes: 0 the static scene, moved by\n"
                   "ego-motion; 1 + i object i; 253 leak; 254 shot noise; 255 a hot pixel")
      ->type_name("FILE.npy|.txt");
  command->add_option("--camera", arguments->camera, "Whose events: top or bottom")
      ->check(CLI::IsMember({"top", "bottom"}))
      ->capture_default_str();
  add_models_option(*command, arguments->models_dir);
  command->callback([arguments, &exit_code] { exit_code = replay(*arguments); });
}

}  // namespace dodgesim

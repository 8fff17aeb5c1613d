// The flight core alone, as Table 3 of Falanga et al. 2020 times it: one camera, one thread, on
// events of flights that were recorded before.
#include <algorithm>
#include <memory>
#include <opencv2/core.hpp>

#include "dodge/dodger.h"
#include "sim/base/error.h"
#include "sim/bench/bench_case.h"
#include "sim/bench/stage_curves.h"
#include "sim/bridge/to_dodge.h"
#include "sim/camera/looking_forward.h"
#include "sim/flight/plan.h"
#include "sim/loop.h"

namespace dodgesim {

namespace {

// What a flight's sensors said between two cycles of the pilot.
struct Cycle {
  TimeUs now_us = 0;
  std::vector<dodge::Event> events;  // of the first camera
  std::vector<dodge::ImuSample> imu;
  std::vector<dodge::StateEstimate> states;
};

using PilotRecording = std::vector<Cycle>;

class Recorder : public FlightObserver {
 public:
  void on_imu(const ImuReading& reading) override { next_.imu.push_back(to_dodge(reading)); }
  void on_state(const StateReading& reading) override { next_.states.push_back(to_dodge(reading)); }
  void on_events(int camera, const Packet& packet) override {
    if (camera != 0) return;
    for (const Event& event : packet.events) next_.events.push_back(to_dodge(event));
  }
  void on_cycle(TimeUs now_us, const dodge::Pilot&) override {
    next_.now_us = now_us;
    recording_.push_back(std::move(next_));
    next_ = {};
  }

  PilotRecording take() { return std::move(recording_); }

 private:
  Cycle next_;
  PilotRecording recording_;
};

// Windows with about so many events, and how long they are to have that many in flight.
struct Load {
  const char* name;
  std::size_t least, most;
  TimeUs window_us;
};
constexpr Load kLoads[] = {
    {"typical", 2000, 6000, 10000}, {"6000", 5500, 6500, 10000}, {"20000", 18000, 22000, 30000}};

// A stage of Table 3.
struct Stage {
  const char* name;
  double dodge::StageTimes::*time_us;
  const char* meaning;
};
constexpr Stage kStages[] = {
    {"ego_motion", &dodge::StageTimes::ego_motion_us, "compensation and time image"},
    {"threshold", &dodge::StageTimes::threshold_us, "normalisation, averaging and cut"},
    {"morphology", &dodge::StageTimes::morphology_us, "opening and closing"},
    {"clustering", &dodge::StageTimes::clustering_us, "flow, groups and DBSCAN"}};

double detection_us(const dodge::StageTimes& times) {
  double sum = 0;
  for (const Stage& stage : kStages) sum += times.*stage.time_us;
  return sum;
}

struct MeanAndSd {
  double mean, sd;
};

MeanAndSd mean_and_sd(const std::vector<double>& sample) {
  cv::Scalar mean, sd;
  cv::meanStdDev(sample, mean, sd);
  return {mean[0], sd[0]};
}

// Where the cameras of the nominal vehicle are does not matter to a single one.
dodge::Config one_camera(TimeUs window_us) {
  dodge::Config config;
  config.position.depth = "mono";
  config.window.window_us = window_us;
  config.cameras.resize(1);
  config.cameras[0].X_BC.linear() = looking_forward();
  return config;
}

// Plays the recordings to the flight core.
struct Player {
  std::vector<PilotRecording> recordings;

  // Calls `use` with the flight core and the events in its window after each of its updates.
  template <class Use>
  void play(TimeUs window_us, bool capture, const Use& use) const {
    for (const PilotRecording& recording : recordings) {
      dodge::Dodger dodger(one_camera(window_us));
      dodger.set_capture(capture);
      std::vector<TimeUs> stamps;  // of the events that the window may hold
      for (const Cycle& cycle : recording) {
        dodger.add_events(0, cycle.events);
        for (const auto& sample : cycle.imu) dodger.add_imu(sample);
        for (const auto& state : cycle.states) dodger.add_state(state);
        dodger.update(cycle.now_us);
        for (const auto& event : cycle.events) stamps.push_back(event.t_us);
        if (stamps.empty()) continue;
        const TimeUs begin_us = stamps.back() - window_us;
        stamps.erase(stamps.begin(), std::ranges::upper_bound(stamps, begin_us));
        use(dodger, stamps.size());
      }
    }
  }

  // The stages' times in the windows that count.
  std::vector<dodge::StageTimes> times_under(const Load& load) const {
    std::vector<dodge::StageTimes> times;
    play(load.window_us, false, [&](const dodge::Dodger& dodger, std::size_t events) {
      if (events >= load.least && events <= load.most) times.push_back(dodger.stage_times());
    });
    return times;
  }

  // Every window of the paper's length, with the least times of several passes: what else runs on
  // the machine only adds. The stages' images are made in a pass of their own.
  std::vector<WindowTimes> windows() const {
    std::vector<WindowTimes> windows;
    constexpr TimeUs kWindowUs = 10000;
    constexpr int kPasses = 3;
    play(kWindowUs, true, [&](const dodge::Dodger& dodger, std::size_t events) {
      const dodge::StageImages& images = dodger.stage_images(0);
      cv::Mat moving;
      images.count.copyTo(moving, images.obstacle_mask);
      windows.push_back(
          {static_cast<double>(events), static_cast<double>(cv::countNonZero(moving)), 0, 0});
    });
    for (int pass = 0; pass < kPasses; ++pass) {
      std::size_t i = 0;
      play(kWindowUs, false, [&](const dodge::Dodger& dodger, std::size_t) {
        WindowTimes& window = windows.at(i++);
        const dodge::StageTimes& times = dodger.stage_times();
        const auto keep = [pass](double& least, double time) {
          least = pass == 0 ? time : std::min(least, time);
        };
        keep(window.ego_motion_us, times.ego_motion_us);
        keep(window.clustering_us, times.clustering_us);
      });
    }
    return windows;
  }

  // In the order of add_quantities().
  std::vector<double> run(const Load& load) const {
    const std::vector<dodge::StageTimes> times = times_under(load);
    if (times.empty()) {
      throw SimulationError("No window of the bench's flights has as many events as the case " +
                            std::string(load.name) + " asks for.");
    }
    const auto of = [&times](const auto& time_us) {
      std::vector<double> sample_ms;
      sample_ms.reserve(times.size());
      for (const dodge::StageTimes& t : times) sample_ms.push_back(1e-3 * time_us(t));
      return mean_and_sd(sample_ms);
    };
    const MeanAndSd detection = of(detection_us);
    std::vector<double> values;
    for (const Stage& stage : kStages) {
      const MeanAndSd one = of([&stage](const dodge::StageTimes& t) { return t.*stage.time_us; });
      values.insert(values.end(), {one.mean, one.sd, one.mean / detection.mean});
    }
    const MeanAndSd rest = of([](const dodge::StageTimes& t) { return t.rest_us; });
    values.insert(values.end(),
                  {detection.mean, detection.sd, rest.mean, static_cast<double>(times.size())});
    return values;
  }
};

std::vector<PilotRecording> record_flights(const BenchOptions& options) {
  struct Source {
    const char* file;
    int throws;
  };
  constexpr Source kSources[] = {{"demo", 3}, {"goal_flight", 1}};
  std::vector<PilotRecording> recordings;
  for (const Source& source : kSources) {
    const Scenario scenario =
        load_scenario(options.scenarios_dir + "/" + source.file + ".yaml", options.models_dir);
    for (int i = 0; i < source.throws; ++i) {
      Recorder recorder;
      fly(scenario, plan_throw(scenario, i), &recorder);
      recordings.push_back(recorder.take());
    }
  }
  return recordings;
}

void add_quantities(const Load& load, std::vector<Quantity>& quantities) {
  const std::string name = std::string("pilot.") + load.name;
  const std::string windows =
      "windows of " + std::to_string(load.least) + " to " + std::to_string(load.most) + " events";
  for (const Stage& stage : kStages) {
    const std::string stage_name = name + "." + stage.name;
    quantities.insert(quantities.end(), {{stage_name, "ms", stage.meaning + (", " + windows)},
                                         {stage_name + "_sd", "ms", "standard deviation"},
                                         {stage_name + "_share", "1", "of the four stages"}});
  }
  quantities.insert(quantities.end(),
                    {{name + ".detection", "ms", "the four stages together, mean"},
                     {name + ".detection_sd", "ms", "standard deviation of the four together"},
                     {name + ".rest", "ms", "depth, tracking and avoidance"},
                     {name + ".windows", "windows", "that this was measured on"}});
}

}  // namespace

std::vector<BenchCase> pilot_cases() {
  BenchCase bench;
  bench.plots = true;
  for (const Load& load : kLoads) add_quantities(load, bench.quantities);
  bench.quantities.push_back({"pilot.curve.ego_motion", "ns/event", "least squares over windows"});
  bench.quantities.push_back({"pilot.curve.clustering", "ns/pixel", "likewise, of moving objects"});
  bench.prepare = [](const BenchOptions& options) -> BenchRun {
    auto player = std::make_shared<Player>(Player{record_flights(options)});
    return [player, plots_dir = options.plots_dir] {
      std::vector<double> values;
      for (const Load& load : kLoads) {
        const std::vector<double> more = player->run(load);
        values.insert(values.end(), more.begin(), more.end());
      }
      const std::vector<WindowTimes> windows = player->windows();
      values.push_back(1e3 * ego_motion_us_per_event(windows));
      values.push_back(1e3 * clustering_us_per_pixel(windows));
      if (!plots_dir.empty()) write_stage_curves(plots_dir, windows);
      return values;
    };
  };
  return {bench};
}

}  // namespace dodgesim

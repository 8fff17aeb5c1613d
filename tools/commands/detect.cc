// dodgesim detect: what a pilot finds in a recording.
#include <cstdio>
#include <memory>
#include <numbers>
#include <optional>
#include <utility>

#include "dodge/dodger.h"
#include "sim/base/error.h"
#include "sim/campaign/campaign_files.h"
#include "sim/config/camera_calibration.h"
#include "sim/config/pilot.h"
#include "sim/files/mp4_file.h"
#include "sim/observers/stage_panels.h"
#include "sim/playback/detection_files.h"
#include "sim/playback/playback.h"
#include "tools/commands/command.h"
#include "tools/commands/detect_inputs.h"
#include "tools/commands/detect_report.h"
#include "tools/commands/detect_scenario.h"
#include "tools/commands/stop_signal.h"

namespace dodgesim {

namespace {

constexpr const char* kDetectFooter =
    R"(The pilot gets what was recorded as late as in flight (`dodgesim explain delays`), in cycles.
What it commands moves nobody, and its goal is to stay where it is.

EVENTS: .h5 (DSEC, RVT; or t, x, y, p at the root, as xs, ys, ts, ps, as records CD/events or as a
  table events); .npy of records with the integers t [us], x, y and p; .txt as `emulate` and `replay
  --events` write it, or of the rpg data sets and E2VID; .csv whose first line names the columns
  t_us, x, y and p; .raw of Prophesee (EVT 2.0 and 3.0). If t has a fraction in one of the first
  16,384 events of .txt or .h5, it is in seconds. Of p, 0 and -1 are OFF, 1 is ON. The events must
  be in order of time, but for 10 ms. The pilot drops those that come later; up to 16 in a row with
  stamps far ahead of the next are passed over, and so are up to 32 at the end that are more than
  ten minutes ahead.
CALIBRATION.yaml: width, height; intrinsics: {fx, fy, cx, cy}; distortion: {model:
  radtan_k1_k2_p1_p2_k3, coeffs: [...]}; p_BC_m and R_BC (rows), the camera's place on the body,
  which by default looks forward; imu_axes, where x, y, z of the IMU point, by default as
  the camera's (of one that looks forward: right down forward); p_BR_m, the range sensor's place.
  Other keys are passed over, but for what looks like a slip of the pen or belongs elsewhere. Size
  and lens may instead have the keys of ROS's and OpenCV's calibrators (plumb_bob).
  Or Kalibr's camchain.yaml or DSEC's cam_to_cam.yaml (pinhole, radtan): the first camera in it
  or, with FILE.yaml:cam1, cam1. It looks forward, and the body's origin is the IMU of T_cam_imu
  (or T_imu_cam), its axes are the camera's forward, left and up; timeshift_cam_imu is taken from
  the IMU's instants.
  Two cameras, the second below the first, are rectified by their calibrations (their images must
  be of one size); in a chain by T_cam_imu or T_cn_cnm1. Calibrations stand behind the events.
IMU.csv: t_us, wx, wy, wz [rad/s]. STATE.csv: t_us, x, y, z, qw, qx, qy, qz (body to world), vx, vy,
  vz [m, m/s]. RANGE.csv: t_us, range_m. A line with these names first; other columns are passed
  over, as are empty lines and those that begin with #. No line may have more cells than there are
  names. All t_us are of the clock of the events; those of logs may be negative.
Without IMU.csv the camera turns as STATE.csv says or, without that, not at all. Without STATE.csv
the vehicle turns as its IMU says, from its first reading on, and stays in its place. Before the
first state nothing can be measured. With one camera, depth comes from a known size
(dodger.position.known_size_m).

It says how much sharper the rates make the events while the camera turns, and with which other
axes or clock they would fit better; and of two cameras, if their events seem to be swapped.

DIR gets cycles.csv (what each cycle found and commands), clusters.csv (what moves in the images),
detections.csv and obstacles.csv (what was measured and is tracked, in the world).

Examples:
  dodgesim replay out/demo --throw 3 --record rec
  dodgesim detect rec/top.h5 rec/bottom.h5 --calibration rec/top.yaml rec/bottom.yaml \
    --scenario rec/scenario.yaml --imu rec/imu.csv --state rec/state.csv --range rec/range.csv \
    --out out/detect --video out/detect.mp4
  dodgesim detect walk.csv --calibration davis.yaml --imu gyro.csv --out out/walk \
    --set dodger.time_image.threshold_b=0.2)";

// The rates of a log, held against the events of the first camera.
struct CheckedRates {
  const char* log;
  const char* axes;  // as report_rates() names them
  RateCheck check;
  std::optional<RateCheck> in_degrees;  // the rates, taken for degrees a second

  void add(std::span<const Event> events) {
    check.add(events);
    if (in_degrees) in_degrees->add(events);
  }
  void report() const {
    if (!in_degrees || !report_degrees(log, in_degrees->fit())) {
      report_rates(log, axes, check.fit());
    }
  }
};

std::vector<ImuReading> taken_for_degrees(std::vector<ImuReading> rates) {
  for (ImuReading& rate : rates) rate.w_B_radps *= std::numbers::pi / 180;
  return rates;
}

std::vector<CheckedRates> rates_to_check(const DetectArguments& arguments,
                                         const CameraCalibration& calibration,
                                         const RecordedSensors& sensors) {
  std::vector<CheckedRates> rates;
  if (!arguments.imu.empty()) {
    const char* const axes = calibration.name.empty() ? "imu_axes" : "its axes";  // in a chain
    rates.push_back(
        {"IMU",
         axes,
         {calibration.camera, sensors.imu, calibration.R_BG},
         RateCheck(calibration.camera, taken_for_degrees(sensors.imu), calibration.R_BG)});
  }
  if (!arguments.state.empty()) {
    std::vector<ImuReading> turning;
    for (const StateReading& state : sensors.states) turning.push_back({state.t_us, state.w_B});
    rates.push_back({"State",
                     "its body's axes",
                     {calibration.camera, turning, Eigen::Matrix3d::Identity()},
                     {}});
  }
  return rates;
}

std::unique_ptr<dodge::Pilot> make_pilot(const Scenario& scenario, const dodge::Config& config) {
  if (scenario.pilot != kPluginPilot) return std::make_unique<dodge::Dodger>(config);
  return make_plugin_pilot(scenario.plugin, config, scenario.plugin_parameters);
}

// A film of the pilot's stages, a picture a cycle.
class StageVideo {
 public:
  StageVideo(const DetectArguments& arguments, TimeUs period_us)
      : path_(arguments.video), rate_hz_(1 / (seconds(period_us) * arguments.slow)) {}

  void add(const dodge::Dodger& pilot, TimeUs now_us) {
    const cv::Mat3b picture = stage_picture(pilot, now_us);
    if (!file_) {
      file_ = std::make_unique<Mp4File>(path_, picture.cols, picture.rows, rate_hz_);
    }
    file_->write(picture.data);
  }

  void close() { file_->close(); }

 private:
  std::string path_;
  double rate_hz_;
  std::unique_ptr<Mp4File> file_;
};

// A pilot that may be filmed, if that is asked for.
std::optional<StageVideo> make_video(const DetectArguments& arguments, const Scenario& scenario,
                                     dodge::Dodger* dodger) {
  if (arguments.video.empty()) return std::nullopt;
  if (dodger == nullptr) {
    throw ScenarioError("--video shows the stages of our own pilots; a plug-in has none.");
  }
  dodger->set_capture(true);
  return StageVideo(arguments, scenario.delays.period_us());
}

void detect(const DetectArguments& arguments) {
  watch_stop_signals();
  expect_no_campaign(arguments.out);
  expect_inputs_stay(arguments);
  check_files(arguments);
  const Scenario scenario =
      detect_scenario(arguments.scenario, parse_settings("--set", arguments.set), arguments.plugin);
  const std::vector<CameraCalibration> calibrations =
      load_calibrations(arguments, scenario.dodger.position.stereo_depth());
  const dodge::Config config = pilot_config(scenario, calibrations, arguments.calibrations);
  RecordedSensors sensors = load_sensors(arguments, calibrations);
  std::vector<Coverage> logs;
  if (!arguments.imu.empty()) logs.emplace_back("IMU", sensors.imu);
  logs.emplace_back("State", sensors.states, "nothing can be measured");
  logs.emplace_back("Range", sensors.ranges);
  if (!arguments.range.empty()) report_ranges(sensors.ranges, config.range_sensor);
  std::vector<CheckedRates> rates = rates_to_check(arguments, calibrations.front(), sensors);
  Playback playback(scenario.delays, make_pilot(scenario, config), std::move(sensors));
  auto* dodger = dynamic_cast<dodge::Dodger*>(&playback.pilot());
  std::optional<StageVideo> video = make_video(arguments, scenario, dodger);
  DetectionFiles files(arguments.out);
  Sums sums;
  CameraOrder order;
  PlaybackProgress progress(arguments.events);
  while (playback.next()) {
    progress.show(playback);
    end_if_asked_to_stop();
    sums.add(files.add(playback.now_us(), playback.pilot(), playback.command()), playback);
    for (CheckedRates& checked : rates) checked.add(playback.new_events(0));
    if (dodger != nullptr) order.add(dodger->clusters(0), dodger->clusters(1));
    if (video) video->add(*dodger, playback.now_us());
  }
  if (video) video->close();
  files.finish();
  progress.finish();
  sums.report(playback, static_cast<int>(arguments.events.size()), scenario.delays.period_us());
  for (const Coverage& log : logs) {
    log.report(playback.first_event_us(), playback.last_event_us(), scenario.delays.period_us());
  }
  for (const CheckedRates& checked : rates) checked.report();
  report_order(order);
  std::printf("%s: cycles.csv, clusters.csv, detections.csv, obstacles.csv\n",
              arguments.out.c_str());
  if (video) std::printf("Video: %s\n", arguments.video.c_str());
}

}  // namespace

void add_detect_command(CLI::App& program, int& exit_code) {
  auto arguments = std::make_shared<DetectArguments>();
  CLI::App* command =
      program.add_subcommand("detect", "Run a pilot on recorded events, and write what it finds");
  command
      ->add_option("events", arguments->events,
                   "The events of one camera, or of the upper and the lower one")
      ->required()
      ->expected(1, 2)
      ->type_name("EVENTS");
  command->add_option("--calibration", arguments->calibrations, "The cameras, in the same order")
      ->required()
      ->expected(1, 2)
      ->type_name("CALIBRATION.yaml");
  command->add_option("--imu", arguments->imu, "Angular rates")->type_name("IMU.csv");
  command->add_option("--state", arguments->state, "State estimates")->type_name("STATE.csv");
  command->add_option("--range", arguments->range, "Readings of the range sensor")
      ->type_name("RANGE.csv");
  command
      ->add_option("--scenario", arguments->scenario,
                   "Whose keys pilot, plugin_parameters, dodger and delays are taken; without it\n"
                   "the defaults, with the pilot falanga2020")
      ->type_name("SCENARIO.yaml");
  add_set_option(*command, arguments->set);
  add_plugin_option(*command, arguments->plugin);
  command->add_option("--out", arguments->out, "Folder for the results")
      ->required()
      ->type_name("DIR");
  CLI::Option* video =
      command
          ->add_option("--video", arguments->video,
                       "Write a video (H.264) of the pilot's stages, a picture a cycle")
          ->check(file_ending(".mp4"))
          ->type_name("FILE.mp4");
  command->add_option("--slow", arguments->slow, "How many times slower than real the video is")
      ->check(number_between(1, 1000))
      ->needs(video)
      ->capture_default_str();
  command->footer(kDetectFooter);
  command->callback([arguments, &exit_code] {
    detect(*arguments);
    exit_code = kOk;
  });
}

}  // namespace dodgesim

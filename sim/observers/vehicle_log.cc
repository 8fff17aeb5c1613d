#include "sim/observers/vehicle_log.h"

#include <algorithm>
#include <array>
#include <list>
#include <optional>

#include "sim/base/error.h"
#include "sim/base/vector3.h"
#include "sim/config/camera_calibration.h"
#include "sim/config/pilot.h"
#include "sim/files/csv.h"
#include "sim/flight/setup.h"
#include "sim/observers/event_recorder.h"
#include "sim/recordings/sensor_log.h"

namespace dodgesim {

namespace {

struct TrueBody {
  std::array<double, 3> p_W{};
  std::array<double, 4> q_wxyz{};  // body to world
  std::array<double, 3> v_W{}, w_W{};

  template <class Visitor>
  void visit(Visitor& v) {
    v("p_W", p_W);
    v("q_wxyz", q_wxyz);
    v("v_W", v_W);
    v("w_W", w_W);
  }
};

TrueBody true_body(const BodyState& body) {
  const Eigen::Quaterniond& q = body.q_W;
  return {to_array(body.p_W), {q.w(), q.x(), q.y(), q.z()}, to_array(body.v_W), to_array(body.w_W)};
}

}  // namespace

void expect_recording_or_nothing(const std::filesystem::path& directory,
                                 const std::string& option) {
  constexpr std::array kAlways = {"imu.csv", "state.csv", "range.csv", "scenario.yaml",
                                  "truth.csv"};
  const auto is_there = [&](const char* name) { return std::filesystem::exists(directory / name); };
  if (is_there("top.h5") || std::ranges::all_of(kAlways, is_there)) return;
  std::vector<const char*> names = {"top.yaml", "bottom.yaml", "bottom.h5"};
  names.insert(names.end(), kAlways.begin(), kAlways.end());
  for (const char* name : names) {
    if (!is_there(name)) continue;
    throw ScenarioError(option + " " + directory.string() + " would overwrite " +
                        (directory / name).string() +
                        ", which is of no recording; choose another directory.");
  }
}

VehicleLog::VehicleLog(const std::filesystem::path& directory, const Scenario& scenario)
    : directory_(directory),
      made_(directory),
      scenario_(scenario),
      imu_(directory / "imu.csv"),
      states_(directory / "state.csv"),
      ranges_(directory / "range.csv"),
      truth_(directory / "truth.csv") {
  imu_.write(imu_header());
  states_.write(state_header());
  ranges_.write(range_header());
}

void VehicleLog::on_tick(const World& world) {
  if (cameras_.empty() && perceives(scenario_.pilot)) open_cameras(world.vehicle());
  now_ = world.snapshot();
}

void VehicleLog::open_cameras(const VehicleParameters& vehicle) {
  const dodge::Config config = core_config(scenario_, vehicle);
  for (std::size_t i = 0; i < config.position.cameras(); ++i) {
    const dodge::CameraModel& camera = config.cameras.at(i);
    const std::string path = (directory_ / kCameraNames.at(i)).string();
    cameras_.push_back(
        make_event_writer(path + ".h5", {camera.width, camera.height, 0, kLongestFlightUs, true}));
    calibrations_.push_back(to_yaml(camera, config.p_BR));
  }
}

void VehicleLog::on_imu(const ImuReading& reading) {
  imu_.write(log_line(reading));
  write_truth();
}

void VehicleLog::on_state(const StateReading& reading) { states_.write(log_line(reading)); }

void VehicleLog::on_range(const RangeReading& reading) { ranges_.write(log_line(reading)); }

void VehicleLog::on_events(int camera, const Packet& packet) {
  cameras_.at(static_cast<std::size_t>(camera))->add(packet.events, packet.causes);
}

void VehicleLog::write_truth() {
  CsvLine line;
  line("t_us", now_.t_us);
  TrueBody vehicle = true_body(now_.vehicle);
  line("vehicle", vehicle);
  for (std::size_t i = 0; i < now_.objects.size(); ++i) {
    std::optional<TrueBody> object;
    if (now_.launched[i]) object = true_body(now_.objects[i]);
    line("object_" + std::to_string(i), object);
  }
  if (!truth_begun_) truth_.write(line.header());
  truth_begun_ = true;
  truth_.write(line.row());
}

// What the disk has no place for is known before a file of an earlier recording gives way.
void VehicleLog::finish() {
  std::list<OutputFile> texts;
  texts.emplace_back(directory_ / "scenario.yaml").write(to_yaml(scenario_));
  for (std::size_t i = 0; i < cameras_.size(); ++i) {
    texts.emplace_back(directory_ / (std::string(kCameraNames.at(i)) + ".yaml"))
        .write(calibrations_[i]);
  }
  std::vector<OutputFile*> files = {&imu_, &states_, &ranges_, &truth_};
  for (OutputFile& text : texts) files.push_back(&text);
  for (const auto& camera : cameras_) camera->finish();
  for (OutputFile* file : files) file->finish();

  for (const auto& camera : cameras_) camera->commit();
  for (OutputFile* file : files) file->commit();
  for (std::size_t i = cameras_.size(); i < kCameraNames.size(); ++i) {
    for (const char* end : {".h5", ".yaml"}) {  // of an earlier recording
      remove_file(directory_ / (std::string(kCameraNames.at(i)) + end));
    }
  }
}

}  // namespace dodgesim

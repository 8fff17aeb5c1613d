// dodgesim detect, on flights that replay --record has recorded and on real cameras.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <vector>

#include "sim/files/csv_table.h"
#include "tests/cli/command_test.h"
#include "tests/dodge/recording.h"

namespace dodgesim::testing {
namespace {

namespace fs = std::filesystem;
using ::testing::AllOf;
using ::testing::ContainsRegex;
using ::testing::HasSubstr;
using ::testing::Not;

class DetectTest : public CommandTest {
 protected:
  // Flies the scenario's only throw and records it.
  void record(const std::string& scenario) const {
    write("s.yaml", scenario);
    const Outcome flown =
        dodgesim("run " + path("s.yaml") + " --set fly_oracle=false --out " + path("campaign"));
    ASSERT_EQ(flown.exit_code, 0) << flown.output;
    const Outcome replay =
        dodgesim("replay " + path("campaign") + " --throw 0 --record " + path("rec"));
    ASSERT_EQ(replay.exit_code, 0) << replay.output;
    EXPECT_THAT(replay.output, HasSubstr("Recorded as the vehicle would: " + path("rec")));
  }

  Outcome detect(const std::string& options) const {
    return dodgesim("detect " + options + " --out " + path("found"));
  }

  CsvTable table(const std::string& name) const { return CsvTable(root_ / name); }

  // How far each detection is from the ball's centre, in ascending order.
  std::vector<double> errors_of_detections() const {
    const CsvTable found = table("found/detections.csv"), truth = table("rec/truth.csv");
    std::vector<double> errors_m;
    std::size_t row = 0;
    for (std::size_t i = 0; i < found.rows(); ++i) {
      while (row + 1 < truth.rows() && truth.number(row, "t_us") < found.number(i, "t_us")) ++row;
      double squared = 0;
      for (const char* axis : {"_0", "_1", "_2"}) {
        const double off = found.number(i, std::string("p_W") + axis) -
                           truth.number(row, std::string("object_0_p_W") + axis);
        squared += off * off;
      }
      errors_m.push_back(std::sqrt(squared));
    }
    std::sort(errors_m.begin(), errors_m.end());
    return errors_m;
  }

  // The pilot finds in the recording what it found in flight, to the last bit.
  void expect_found_as_flown() const {
    const CsvTable flown = table("campaign/detections.csv"), found = table("found/detections.csv");
    ASSERT_GT(flown.rows(), 3u);
    ASSERT_GE(found.rows(), flown.rows());  // those of the last cycle never left it in flight
    ASSERT_LE(found.rows(), flown.rows() + 2);
    for (std::size_t row = 0; row < flown.rows(); ++row) {
      for (const char* column : {"t_us", "obstacle_id", "p_W_0", "p_W_1", "p_W_2", "size_m",
                                 "depth_m", "depth_sigma_m"}) {
        EXPECT_EQ(found.at(row, column), flown.at(row, column)) << row << " " << column;
      }
    }
  }
};

// Small pictures, which are drawn in less time.
constexpr const char* kThrow =
    "seed: 5\nthrow: {distance_m: 2.5, speed_mps: 5, launch_s: 0.1, launch_height_m: 2}\n"
    "after_s: 0.1\nsensors: {camera: {width: 240, height: 180}}\n";
constexpr const char* kDodges = "dodger: {time_image: {threshold_b: 0.09}}\n";
constexpr const char* kStays =
    "dodger: {time_image: {threshold_b: 0.09}, repulsive: {k_r0: 0.01}}\n";

TEST_F(DetectTest, FindsInARecordedFlightWhatThePilotFoundInIt) {
  record(std::string(kThrow) + kDodges);
  const std::string stereo = path("rec/top.h5") + " " + path("rec/bottom.h5") + " --calibration " +
                             path("rec/top.yaml") + " " + path("rec/bottom.yaml") + " --imu " +
                             path("rec/imu.csv");
  const std::string all = stereo + " --state " + path("rec/state.csv") + " --range " +
                          path("rec/range.csv") + " --scenario " + path("rec/scenario.yaml");
  const Outcome outcome = detect(all);
  EXPECT_EQ(outcome.exit_code, 0) << outcome.output;
  EXPECT_THAT(outcome.output, ContainsRegex("top camera: [0-9]+ events\nbottom camera: "));
  EXPECT_THAT(outcome.output, ContainsRegex("IMU: [0-9]+ readings, covers 0.[5-9].* gap 1.0 ms"));
  EXPECT_THAT(outcome.output, Not(HasSubstr("swapped")));
  expect_found_as_flown();
  const CsvTable cycles = table("found/cycles.csv");
  std::size_t evading = 0;
  for (std::size_t row = 0; row < cycles.rows(); ++row) evading += cycles.boolean(row, "evading");
  EXPECT_GT(evading, 3u);
  EXPECT_GT(table("found/clusters.csv").rows(), 10u);
  EXPECT_GT(table("found/obstacles.csv").rows(), 3u);

  const Outcome swapped = detect(path("rec/bottom.h5") + " " + path("rec/top.h5") +
                                 " --calibration " + path("rec/top.yaml") + " " +
                                 path("rec/bottom.yaml") + " --imu " + path("rec/imu.csv"));
  EXPECT_EQ(swapped.exit_code, 0) << swapped.output;
  EXPECT_THAT(swapped.output, HasSubstr("are their events swapped?"));

  // A replay that fails, here before its flight, leaves an earlier recording as it was.
  const std::string log = contents("rec/imu.csv");
  const Outcome nowhere = dodgesim("replay " + path("campaign") + " --throw 0 --record " +
                                   path("rec") + " --picture " + path("nowhere/p.png"));
  EXPECT_EQ(nowhere.exit_code, 4);
  EXPECT_THAT(nowhere.output, HasSubstr("nowhere/p.png"));
  EXPECT_EQ(contents("rec/imu.csv"), log);
  for (const char* file : {"rec/top.h5", "rec/bottom.h5", "rec/scenario.yaml", "rec/top.yaml"}) {
    EXPECT_TRUE(fs::exists(root_ / file)) << file;
  }

  // Other keys, other detections.
  EXPECT_EQ(detect(all + " --set dodger.position.max_range_m=0.7").exit_code, 0);
  EXPECT_LT(table("found/detections.csv").rows(), table("campaign/detections.csv").rows());
  // Neither writes into a campaign.
  const Outcome into = dodgesim("detect " + all + " --out " + path("campaign"));
  EXPECT_EQ(into.exit_code, 2);
  EXPECT_THAT(into.output, HasSubstr("campaign"));
  EXPECT_EQ(
      dodgesim("replay " + path("campaign") + " --throw 0 --record " + path("campaign")).exit_code,
      2);
  // Nor over what is no recording.
  fs::create_directory(root_ / "mine");
  write("mine/scenario.yaml", "seed: 1\n");
  const Outcome mine =
      dodgesim("replay " + path("campaign") + " --throw 0 --record " + path("mine"));
  EXPECT_EQ(mine.exit_code, 2);
  EXPECT_THAT(mine.output, HasSubstr("would overwrite " + path("mine/scenario.yaml")));
  EXPECT_EQ(contents("mine/scenario.yaml"), "seed: 1\n");
}

// The lower camera is turned by 3 degrees, of which its calibration knows. Without, there is hardly
// anything at a depth that could be.
TEST_F(DetectTest, RectifiesTheCamerasOfARig) {
  record(std::string(kThrow) + kStays + "vehicle_overrides: {lower_camera_turn_deg: [3, 0, 0]}\n");
  const std::string lower = contents("rec/bottom.yaml");
  const std::size_t begin = lower.find("R_BC: "), end = lower.find('\n', begin);
  // It looks 3 degrees higher.
  const double s = std::sin(M_PI / 60), c = std::cos(M_PI / 60);
  const std::string turned = "R_BC: [[0, " + std::to_string(s) + ", " + std::to_string(c) +
                             "], [-1, 0, 0], [0, " + std::to_string(-c) + ", " + std::to_string(s) +
                             "]]";
  write("true.yaml", lower.substr(0, begin) + turned + lower.substr(end));
  const auto median_error_m = [&](const std::string& calibration, Outcome& outcome) {
    outcome =
        detect(path("rec/top.h5") + " " + path("rec/bottom.h5") + " --calibration " +
               path("rec/top.yaml") + " " + calibration + " --imu " + path("rec/imu.csv") +
               " --state " + path("rec/state.csv") + " --scenario " + path("rec/scenario.yaml"));
    EXPECT_EQ(outcome.exit_code, 0) << outcome.output;
    const std::vector<double> errors_m = errors_of_detections();
    return errors_m.size() < 4 ? 1.0 : errors_m[errors_m.size() / 2];
  };
  Outcome outcome;
  EXPECT_LT(median_error_m(path("true.yaml"), outcome), 0.1);
  EXPECT_THAT(outcome.output,
              HasSubstr("rectified by their calibrations: turned by 0.00 and 3.00 degrees"));
  EXPECT_GT(median_error_m(path("rec/bottom.yaml"), outcome), 0.3);
  EXPECT_THAT(outcome.output, Not(HasSubstr("rectified")));
}

// W of the detections has the place where the vehicle began to fly for an origin; its escape, of
// which a pilot without a state estimate knows nothing, turns the direction of a ball that is
// nearer than a metre. Depth errs as soon as something of the room is taken for a part of the ball.
TEST_F(DetectTest, FindsWithOneCameraAndItsImuInWhichDirectionTheBallIs) {
  record(
      "seed: 5\nthrow: {distance_m: 2.5, speed_mps: 5, launch_s: 0.1, launch_height_m: 2.4, "
      "bearing_deg: 15}\nafter_s: 0.1\ndodger: {position: {depth: mono}}\n");
  EXPECT_FALSE(fs::exists(path("rec/bottom.h5")));
  const Outcome bottom = dodgesim("replay " + path("campaign") + " --throw 0 --camera bottom " +
                                  "--events " + path("bottom.npy"));
  EXPECT_EQ(bottom.exit_code, 2);
  EXPECT_THAT(bottom.output, HasSubstr("there are no events of the camera bottom"));
  const Outcome outcome = detect(path("rec/top.h5") + " --calibration " + path("rec/top.yaml") +
                                 " --imu " + path("rec/imu.csv"));
  EXPECT_EQ(outcome.exit_code, 0) << outcome.output;
  EXPECT_THAT(outcome.output, HasSubstr("depth comes from a known size, 0.2 m"));
  const CsvTable found = table("found/detections.csv"), truth = table("rec/truth.csv");
  const auto vector = [](const CsvTable& table, std::size_t row, const std::string& name) {
    return Eigen::Vector3d(table.number(row, name + "_0"), table.number(row, name + "_1"),
                           table.number(row, name + "_2"));
  };
  const Eigen::Vector3d p_BC(0.12, 0, 0.075);  // the upper camera
  std::vector<double> errors_deg;
  std::size_t row = 0;
  for (std::size_t i = 0; i < found.rows(); ++i) {
    while (row + 1 < truth.rows() && truth.number(row, "t_us") < found.number(i, "t_us")) ++row;
    if (truth.at(row, "object_0_p_W_0").empty()) continue;
    const Eigen::Vector3d ball =
        vector(truth, row, "object_0_p_W") - vector(truth, row, "vehicle_p_W") - p_BC;
    if (ball.norm() < 1) continue;
    const Eigen::Vector3d seen = vector(found, i, "p_W") - p_BC;
    errors_deg.push_back(std::acos(ball.normalized().dot(seen.normalized())) * 180 / M_PI);
  }
  ASSERT_GT(errors_deg.size(), 4u);
  std::sort(errors_deg.begin(), errors_deg.end());
  EXPECT_LT(errors_deg[errors_deg.size() / 2], 3);
}

TEST_F(DetectTest, WritesAVideoOfThePilotsStages) {
  write("e.csv", "t_us,x,y,p\n100,5,5,1\n9000,6,6,0\n");
  write("c.yaml", "{width: 64, height: 48}");
  const Outcome outcome =
      detect(path("e.csv") + " --calibration " + path("c.yaml") + " --video " + path("v.mp4"));
  EXPECT_EQ(outcome.exit_code, 0) << outcome.output;
  EXPECT_GT(fs::file_size(path("v.mp4")), 1000u);
  EXPECT_THAT(outcome.output, AllOf(HasSubstr("has no intrinsics: 80 degrees over 64 columns"),
                                    HasSubstr("the camera is taken not to turn")));

  // One that fails after its first pictures leaves the earlier video as it was.
  const std::string video = contents("v.mp4");
  std::string events = "t_us,x,y,p\n";
  for (int i = 0; i < 20000; ++i) events += std::to_string(i) + ",5,5,1\n";
  write("e.csv", events + "20000,700,6,0\n");
  EXPECT_EQ(detect(path("e.csv") + " --calibration " + path("c.yaml") + " --video " + path("v.mp4"))
                .exit_code,
            2);
  EXPECT_EQ(contents("v.mp4"), video);
  EXPECT_FALSE(fs::exists(root_ / "v.mp4.partial"));
}

TEST_F(DetectTest, SaysWhatIsWrongAndWritesNothing) {
  write("e.csv", "t_us,x,y,p\n100,5,5,1\n9000,700,6,0\n");
  write("c.yaml", "{width: 64, height: 48}");
  const std::string events = path("e.csv") + " --calibration " + path("c.yaml");
  const Outcome outside = detect(events);
  EXPECT_EQ(outside.exit_code, 2);
  EXPECT_THAT(outside.output, HasSubstr("e.csv:3: x is 700, but must be from 0 to 63."));
  EXPECT_FALSE(fs::exists(path("found")));
  fs::create_directory(path("found"));
  EXPECT_EQ(detect(events).exit_code, 2);
  EXPECT_TRUE(fs::is_empty(path("found")));
  EXPECT_EQ(detect(path("none.csv") + " --calibration " + path("c.yaml")).exit_code, 4);
  EXPECT_EQ(detect(events + " --imu " + path("none.csv")).exit_code, 4);
  EXPECT_THAT(detect(events + " " + path("c.yaml")).output,
              HasSubstr("Given are 1 file of events, but 2 calibrations"));
  write("lens.yaml",
        "{width: 64, height: 48, "
        "distortion: {model: radtan_k1_k2_p1_p2_k3, coeffs: [-50, 0, 0, 0, 0]}}");
  EXPECT_THAT(detect(path("e.csv") + " --calibration " + path("lens.yaml")).output,
              HasSubstr("lens.yaml: Camera 0 has a distortion that has no inverse"));
  EXPECT_THAT(detect(events + " --set pilot=oracle").output, HasSubstr("sees nothing"));
  EXPECT_THAT(detect(events + " --set dodger.windo=3").output, HasSubstr("dodger.window"));
}

TEST_F(DetectTest, TakesWhatOthersRecord) {
  std::string events = "\xef\xbb\xbft_us, x, y, p\r\n# one stamp is damaged\r\n";
  for (int i = 0; i < 100; ++i) {
    events += std::to_string(i == 50 ? 90'000'000 : 200 * i) + ", 5, 5, 1\r\n";
  }
  write("e.csv", events + "\r\n");
  write("i.csv", "# by hand\nt_us,wx,wy,wz\n0, 0, 0, 0\n\n30000,0,0,0");
  write("c.yaml",
        "cam0:\n  camera_model: pinhole\n  intrinsics: [60, 60, 32, 24]\n  resolution: [64, 48]\n"
        "  distortion_model: radtan\n  distortion_coeffs: [0.01, 0, 0, 0]\n"
        "  T_cam_imu: [[0, 1, 0, 0], [-1, 0, 0, 0], [0, 0, 1, 0], [0, 0, 0, 1]]\n"
        "  timeshift_cam_imu: 0.002\ncam1: {resolution: [1, 1]}\n");
  const Outcome outcome = detect(path("e.csv") + " --calibration " + path("c.yaml") + " --imu " +
                                 path("i.csv") + " --set repeats=3");
  EXPECT_EQ(outcome.exit_code, 0) << outcome.output;
  EXPECT_THAT(outcome.output,
              AllOf(HasSubstr("99 events\n1 more passed over"), HasSubstr("0.020 s, "),
                    HasSubstr("c.yaml: cam0 is taken; FILE:cam1 would be another."),
                    HasSubstr("moved by -2.000 ms"), HasSubstr("repeats=3 has no effect")));
}

TEST_F(DetectTest, SaysHowManyEventsComeAfterTheClockWasSetBack) {
  std::string events = "t_us,x,y,p\n";
  for (int i = 0; i < 40; ++i) events += std::to_string(5'000'000 + i) + ",5,5,1\n";
  for (int i = 0; i < 90; ++i) events += std::to_string(200 * i) + ",5,5,1\n";
  write("e.csv", events);
  write("c.yaml", "{width: 64, height: 48}");
  EXPECT_THAT(detect(path("e.csv") + " --calibration " + path("c.yaml")).output,
              HasSubstr("130 events, 90 of which stand more than 10 ms too late in their file"));
}

// A camera that turns to the right and back before upright stripes, and an IMU that says so, or the
// opposite.
TEST_F(DetectTest, SaysWhetherTheRatesFitTheEvents) {
  write("c.yaml", "{width: 64, height: 48, intrinsics: {fx: 40, fy: 40, cx: 31.5, cy: 23.5}}");
  std::string events = "t_us,x,y,p\n", right = "t_us,wx,wy,wz\n", left = right;
  for (int ms = 0; ms < 1500; ++ms) {
    const double t_s = 1e-3 * ms, azimuth = 0.5 * std::sin(12 * t_s), rate = 6 * std::cos(12 * t_s);
    const std::string stamp = std::to_string(1000 * ms) + ",";
    right += stamp + "0," + std::to_string(rate) + ",0\n";
    left += stamp + "0," + std::to_string(-rate) + ",0\n";
    for (int stripe = 0; stripe < 9; ++stripe) {
      const double x = 31.5 + 40 * std::tan(0.2 * (stripe - 4) - azimuth);
      if (x < 0 || x > 63) continue;
      for (int y = stripe + ms % 3; y < 48; y += 9) {
        events += stamp + std::to_string(std::lround(x)) + "," + std::to_string(y) + ",1\n";
      }
    }
  }
  write("e.csv", events);
  write("right.csv", right);
  write("left.csv", left);
  const std::string film = path("e.csv") + " --calibration " + path("c.yaml") + " --imu ";
  const std::string fits = detect(film + path("right.csv")).output;
  EXPECT_THAT(fits, ContainsRegex("IMU: turned back by its rates, events are [1-9][0-9.]+ times"));
  EXPECT_THAT(fits, Not(HasSubstr("they would be")));
  EXPECT_THAT(
      detect(film + path("left.csv")).output,
      ContainsRegex("events are [01]\\.[0-9]+ times .*\nIMU: with imu_axes [a-z]+ up [a-z]+ they "
                    "would be [1-9][0-9.]+ times as sharp \\(7 others alike\\)"));
  // Too short, and at rest.
  write("short.csv", events.substr(0, events.find("\n120000,")));
  EXPECT_THAT(
      detect(path("short.csv") + " --calibration " + path("c.yaml") + " --imu " + path("left.csv"))
          .output,
      ContainsRegex("as they are \\([1-9] windows?, too few to tell whether others would"));
  write("rest.csv", "t_us,wx,wy,wz\n0,0,0,0\n1500000,0,0,0\n");
  EXPECT_THAT(detect(film + path("rest.csv")).output,
              HasSubstr("IMU: the camera turns too little, or sees too little, to tell"));
  // A chain has no imu_axes.
  const std::string chain =
      "cam0: {camera_model: pinhole, distortion_model: radtan, distortion_coeffs: [0, 0, 0, 0], "
      "intrinsics: [40, 40, 31.5, 23.5], resolution: [64, 48]";
  write("chain.yaml", chain + "}");
  EXPECT_THAT(
      detect(path("e.csv") + " --calibration " + path("chain.yaml") + " --imu " + path("left.csv"))
          .output,
      ContainsRegex("IMU: with its axes [a-z]+ up [a-z]+ they would"));
  // What Kalibr says of an IMU whose x points to the camera's -y, with a clock that is 50 ms ahead.
  write("turned.yaml",
        chain +
            ", T_cam_imu: [[0, 1, 0, 0], [-1, 0, 0, 0], [0, 0, 1, 0], [0, 0, 0, 1]], "
            "timeshift_cam_imu: 0.05}");
  std::string turned = "t_us,wx,wy,wz\n";
  for (int ms = 0; ms < 1500; ++ms) {
    turned += std::to_string(1000 * (ms + 50)) + "," +
              std::to_string(-6 * std::cos(12 * 1e-3 * ms)) + ",0,0\n";
  }
  write("turned.csv", turned);
  const std::string of_kalibr = detect(path("e.csv") + " --calibration " + path("turned.yaml") +
                                       " --imu " + path("turned.csv"))
                                    .output;
  const auto sharpness = [](const std::string& output) {
    const std::size_t at = output.find("IMU: turned back by its rates");
    return at == output.npos ? "" : output.substr(at, output.find('\n', at) - at);
  };
  EXPECT_EQ(sharpness(of_kalibr), sharpness(fits)) << of_kalibr;
}

// Real event cameras; skips where the recordings are absent.
TEST_F(DetectTest, TakesNoStaticSceneAndNoNoiseForAnObstacle) {
  const auto file = [](const std::string& name) { return dodge::recording::path(name); };
  const std::string shapes = file("mueggler_shapes_rotation.events.csv");
  if (!fs::exists(shapes)) GTEST_SKIP() << "The recordings are absent.";
  const std::string turning =
      shapes + " --calibration " + file("mueggler_shapes_rotation.calib.yaml");
  // Without the rates, the wall of shapes moves; with those of the calibration's file it rests.
  EXPECT_EQ(detect(turning).exit_code, 0);
  EXPECT_GT(table("found/clusters.csv").rows(), 20u);
  write("gyro.csv",
        "t_us,wx,wy,wz\n1,1.89,-0.04,1.64\n15000,1.97,-0.11,1.15\n25000,2.03,-0.26,"
        "0.92\n35000,2.24,-0.01,0.26\n60000,2.24,0.01,0.16\n110000,2.14,0.01,0.06\n");
  EXPECT_EQ(detect(turning + " --imu " + path("gyro.csv")).exit_code, 0);
  EXPECT_EQ(table("found/clusters.csv").rows(), 0u);

  EXPECT_EQ(detect(file("codecs_dvxplorer_noise.events.csv") + " --calibration " +
                   file("codecs_dvxplorer_noise.calib.yaml"))
                .exit_code,
            0);
  EXPECT_EQ(table("found/clusters.csv").rows(), 0u);
}

}  // namespace
}  // namespace dodgesim::testing

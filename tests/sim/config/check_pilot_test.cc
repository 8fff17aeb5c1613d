// Settings with which a pilot could never see, evade or land.
#include "sim/config/check_pilot.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/sim/config/bad_scenario.h"

namespace dodgesim {
namespace {

class UselessPilotTest : public ::testing::TestWithParam<BadScenario> {};

TEST_P(UselessPilotTest, IsRefusedWithPlaceKeyAndReason) {
  EXPECT_THAT(error_of(GetParam().yaml), ::testing::StartsWith(GetParam().message));
}

const BadScenario kUselessPilots[] = {
    {"RangeSensorTooSlowForTheMonitor", "sensors: {range: {rate_hz: 10}}\n",
     "bad.yaml:1:28: sensors.range.rate_hz is 10, too slow for dodger.height_monitor.max_gap_us, "
     "which is 50000: the pilot would never land; raise it, or set "
     "dodger.height_monitor.enabled: false."},
    {"EventsLaterThanTheWindow", "delays: {transport_us: 20000}\n",
     "bad.yaml:1:24: delays.transport_us is 20000, but must be less than dodger.window.window_us "
     "and event_timeout_us together, which are 20000: the pilot would never see an event"},
    {"LowerCameraLaterThanTheWindow", "delays: {lower_camera_us: 12000}\n",
     "bad.yaml:1:27: delays.lower_camera_us is 12000, but must be less than "
     "dodger.window.window_us and camera_lag_us together, which are 12000: the pilot would never "
     "see with both cameras at once; raise the lag."},
    {"LowerCameraTooLateWithItsTransport",
     "delays: {lower_camera_us: 10000, transport_us: 15000}\n",
     "bad.yaml:1:27: delays.lower_camera_us and delays.transport_us together are 25000, but must "
     "be "
     "less than dodger.window.window_us and event_timeout_us together, which are 20000: the pilot "
     "would never see an event of the lower camera."},
    {"EventsInPacketsLaterThanTheWindow", "delays: {transport_us: 19500}\n",
     "bad.yaml:1:24: delays.transport_us is 19500 (20000 in whole packets and cycles), but must be "
     "less than dodger.window.window_us and event_timeout_us together, which are 20000: "},
    {"CyclesOfPacketsLaterThanTheWindow", "delays: {cycle_us: 20000, packet_us: 20000}\n",
     "bad.yaml: delays.transport_us is 1000 (20000 in whole packets and cycles), but must be "},
    {"LowerCameraInPacketsLaterThanTheLag", "delays: {lower_camera_us: 11500}\n",
     "bad.yaml:1:27: delays.lower_camera_us is 11500 (12000 in whole packets and cycles), but must "
     "be less than dodger.window.window_us and camera_lag_us together, which are 12000: "},
    {"PacketsLongerThanTheWindow", "delays: {packet_us: 20000}\n",
     "bad.yaml:1:21: delays.packet_us is 20000, but must not exceed dodger.window.window_us, which "
     "is 10000: of each packet the pilot would see the end alone."},
    {"StampsCoarserThanTheWindow", "sensors: {events: {stamp_resolution_us: 10000}}\n",
     "bad.yaml:1:41: sensors.events.stamp_resolution_us is 10000, but must be less than "
     "dodger.window.window_us, which is 10000: all events of a window would have one time, and "
     "nothing would move."},
    {"ForgottenBeforeTheNextLook", "dodger: {repulsive: {k_tau: 3.95, k_r0: 4}}\n",
     "bad.yaml:1:21: dodger.repulsive has an obstacle forgotten 0.00126 s after its last "},
    {"LooksTooSeldomToRemember", "delays: {compute_us: 900000}\n",
     "bad.yaml: dodger.repulsive has an obstacle forgotten 0.829 s after its last detection, when "
     "k_r0 has decayed to k_tau with lambda_decay_1ps, but the next look comes after 900000 us "
     "(delays.cycle_us, or delays.compute_us if that is "
     "longer): "
     "the pilot would never evade."},
    {"KnownSizeThatIsNotCredible", "dodger: {position: {depth: mono, known_size_m: 0.02}}\n",
     "bad.yaml:1:9: dodger does not fit together: The parameter position.min_size_m is 0.03 but "
     "must be less than position.known_size_m, which "
     "is 0.02."},
    {"ClusterOfMoreThanThereAre", "dodger: {cluster: {min_points: 65}}\n",
     "bad.yaml:1:32: dodger.cluster.min_points is 65 but must not exceed cluster.max_groups, which "
     "is 64."},
    {"HitThatIsNeverProbable", "pilot: dodgesim\ndodger: {escape: {control_sigma_m: 1}}\n",
     "bad.yaml:2:9: dodger does not fit together: The parameter escape.min_probability is 0.3 but "
     "must be less than 0.19"},
    {"BrakesThatTakeForEver", "dodger: {velocity_limit: {calm_acceleration_mps2: 1e-12}}\n",
     "bad.yaml:1:51: dodger.velocity_limit.calm_acceleration_mps2 is 1e-12 but must be 0 (at once) "
     "or at least "
     "0.1."},
    {"LandingWithoutReadings",
     "sensors: {range: {rate_hz: 8}}\ndodger: {height_monitor: {max_gap_us: 200000}}\n",
     "bad.yaml:1:28: sensors.range.rate_hz is 8, too slow for dodger.landing.fresh_us, which is "
     "100000: a pilot that lands would not know its height; "},
    {"RangesThatThePilotDoesNotBelieve", "sensors: {range: {max_range_m: 0.4}}\n",
     "bad.yaml:1:32: sensors.range.max_range_m is 0.4, but must exceed "
     "dodger.range_sensor.min_range_m, which is 0.5: the pilot would believe no reading, and never "
     "land."},
    {"RangesBeyondThoseThatThePilotBelieves",
     "sensors: {range: {min_range_m: 61, max_range_m: 100}}\n",
     "bad.yaml:1:32: sensors.range.min_range_m is 61, but must be less than "
     "dodger.range_sensor.max_range_m, which is 60: the pilot would believe no reading, and never "
     "land."},
    {"NumbersThatAreHardlyAny", "sensors: {range: {resolution_m: 1e-309}}\n",
     "bad.yaml:1:33: sensors.range.resolution_m is 1e-309, but must be 0 or at least 1e-300."},
};

INSTANTIATE_TEST_SUITE_P(All, UselessPilotTest, ::testing::ValuesIn(kUselessPilots),
                         [](const auto& info) { return info.param.name; });

}  // namespace
}  // namespace dodgesim

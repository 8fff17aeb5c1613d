// A scenario: everything that decides the result of a campaign, read from one YAML file. Every
// struct lists its parameters once, in visit(), which serves reading, checking, writing and
// documenting.
#pragma once

#include <Eigen/Dense>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "dodge/presets.h"
#include "sim/bridge/delay_spec.h"
#include "sim/bridge/oracle_spec.h"
#include "sim/bridge/plugin.h"
#include "sim/config/distribution.h"
#include "sim/config/parameter_docs.h"
#include "sim/config/pilot.h"
#include "sim/config/scenario_tree.h"
#include "sim/config/varied_key.h"
#include "sim/control/flight_controller.h"
#include "sim/control/velocity_controller.h"
#include "sim/events/spec.h"
#include "sim/motors/motors.h"
#include "sim/render/spec.h"
#include "sim/sensors/imu.h"
#include "sim/sensors/range_sensor.h"
#include "sim/sensors/state_estimator.h"
#include "sim/world/vehicle_overrides.h"

namespace dodgesim {

struct CameraSpec {
  int width = 320;   // [px]
  int height = 240;  // [px]
  double horizontal_fov_deg = 80;

  template <class Visitor>
  void visit(Visitor& v) {
    v("width", width, 16, 2048, "Columns of each event camera (320 as the paper's SEES1).");
    v("height", height, 16, 2048, "Rows of each event camera (240 as the paper's SEES1).");
    v("horizontal_fov_deg", horizontal_fov_deg, 10, 150,
      "Horizontal field of view; 80 degrees (about that of the SEES1) over 320 columns is a focal "
      "length of 190.7 px.");
  }
};

struct SensorsSpec {
  CameraSpec camera;
  EventCameraSpec events;
  SamplingSpec sampling;
  RenderSpec render;
  KeySpec keys;
  ImuSpec imu;
  StateEstimateSpec state_estimate;
  RangeSpec range;

  template <class Visitor>
  void visit(Visitor& v) {
    v("camera", camera, "Image size and field of view of both event cameras.");
    v("events", events, "The event cameras' pixels.");
    v("sampling", sampling, "How often the luminance is drawn from which events are made.");
    v("render", render, "How the luminance is drawn.");
    v("keys", keys, "When the room is drawn anew, and how finely.");
    v("imu", imu,
      "Gyroscope and accelerometer. The flight controller's own gyroscope has the same errors, "
      "drawn "
      "for itself, at 4 kHz whatever rate_hz is.");
    v("state_estimate", state_estimate, "Pose and velocity as the vehicle's estimator gives them.");
    v("range", range,
      "The range sensor that looks down, along one ray, at the room and thrown objects.");
  }
};

struct MissionSpec {
  std::string type = "hover";
  Eigen::Vector3d start_m{0, 0, 2};
  double heading_deg = 0;
  std::optional<Eigen::Vector3d> goal_m;
  std::vector<Eigen::Vector3d> waypoints_m;
  double waypoint_radius_m = 0.3;
  double speed_mps = 1.5;

  template <class Visitor>
  void visit(Visitor& v) {
    v("type", type, {"hover", "goal", "waypoints"},
      "Stay at start_m, or fly from there to goal_m or along waypoints_m.");
    v("start_m", start_m, -100, 100,
      "Where the vehicle starts, in world coordinates (z up). The ground of the room field is "
      "seen, by cameras and range sensor, as far as 60 m from the origin.");
    v("heading_deg", heading_deg, -180, 180,
      "Heading of the vehicle and its cameras: 0 along world x, positive to the left.");
    v("goal_m", goal_m, -100, 100, "Where to fly; required for the type goal.");
    v("waypoints_m", waypoints_m, -100, 100,
      "Where to fly one after the other, to hover at the last; required for the type waypoints.");
    v("waypoint_radius_m", waypoint_radius_m, 0.05, 10,
      "How near its estimated position must come to a waypoint for the vehicle to go on.");
    v("speed_mps", speed_mps, 0.1, 10,
      "Cruise speed towards the goal or a waypoint (1.5 in the paper), at most "
      "dodger.velocity_limit.max_speed_mps. The vehicle brakes within dodger.attractive.e_0_m "
      "of its goal: with less than speed_mps^2/25 (0.36 m for 3 m/s, 1 m for 5 m/s) it swings "
      "through its goal forever. With the default of 0.2 m the nominal vehicle is at rest a second "
      "after it has arrived at 1.5 m/s; at 2 m/s it rocks about its goal for three or four, tilted "
      "by up to 65 degrees; one whose rotors hardly lift it needs more.");
  }
};

struct ThrowSpec {
  static constexpr int kMost = 16;  // objects in a flight

  NameChoice object = {{"ball"}};
  Distribution size_m = Distribution::constant(0.2);
  Distribution speed_mps = Distribution::constant(6);
  Distribution distance_m = Distribution::constant(3);
  Distribution bearing_deg = Distribution::constant(0);
  Components aim_offset_m = {2, {Distribution::constant(0)}};
  Components spin_radps = {3, {Distribution::constant(0)}};
  Distribution launch_height_m = Distribution::constant(1.5);
  Distribution launch_s = Distribution::constant(1);
  int count = 1;
  double interval_s = 0;

  template <class Visitor>
  void visit(Visitor& v) {
    v.model("object", object, "objects", "What is thrown.");
    v("size_m", size_m, 0.01, 1, "Its longest extension; a ball's diameter.");
    v("speed_mps", speed_mps, 0.5, 30,
      "The object's own mean speed over the ground: it reaches the aim point distance_m / "
      "speed_mps after its launch. On a vehicle that flies towards it, it closes faster by the "
      "vehicle's speed. A ball that meets the room on its way, such as a slow lob the ceiling, "
      "flies on from there and mostly misses; if it still hits, it counts (none_after_room). "
      "No throw may leave the hand faster than 100 m/s.");
    v("distance_m", distance_m, 0.5, 20,
      "Distance over the ground from the launch to the aim point, where the vehicle will be on "
      "arrival. Nothing of the room may stand between launch and vehicle, or the throw is an "
      "error, not a miss.");
    v("bearing_deg", bearing_deg, -360, 360,
      "Where the throw comes from, seen from above: 0 ahead, along the vehicle's x axis as it lies "
      "when the object arrives, of which tilting to the side and forwards at once turns the "
      "direction; positive to the left. !uniform [160, 200] is from behind.");
    v("aim_offset_m", aim_offset_m, -2, 2,
      "Offset of the aim point from the vehicle's centre across the line of the throw, [left, up] "
      "for a viewer at the vehicle who looks at the thrower; a single distribution is drawn for "
      "each of the two.");
    v("spin_radps", spin_radps, -200, 200,
      "Rotation of the object: a rate about a random axis, or [x, y, z] in the world. It leaves "
      "the hand with its axes along the world's, whatever the bearing.");
    v("launch_height_m", launch_height_m, 0.05, 10,
      "Height of the hand (z of the world) when it lets go.");
    v("launch_s", launch_s, 0.1, 600, "Time of the launch after the start of the flight.");
    v("count", count, 1, kMost,
      "How many of these are thrown in one flight, each with draws of its own.");
    v("interval_s", interval_s, 0, 60,
      "Time from one of their launches to the next. 0: all are launched together, at launch_s of "
      "the first; then they need different places, by a drawn bearing_deg or aim_offset_m, as "
      "objects that would overlap are not launched.");
  }
};

struct StopSpec {
  double half_width = 0.03;
  double confidence = 0.95;

  template <class Visitor>
  void visit(Visitor& v) {
    v("half_width", half_width, 0.005, 0.5,
      "Fly no more throws when the success rate is known to plus or minus this; the number of "
      "throws is then at most the scenario's. Before the first throw, to find the rule that "
      "stops takes half a minute for 0.005, and minutes if confidence is 0.999 as well.");
    v("confidence", confidence, 0.5, 0.999,
      "Probability that the interval holds the true rate, whatever it is.");
  }
};

// What a campaign flies; expand.h has what one of its throws needs.
struct Scenario {
  std::string name;
  std::string description;
  std::uint64_t seed = 1;
  int repeats = 1;
  std::optional<StopSpec> stop;  // absent: all throws are flown
  VariedKeys grid;
  VariedKeys sweep;
  std::string pilot = kPaperPilot;
  std::string plugin_parameters;
  bool fly_oracle = true;
  std::string room = "room";
  std::string vehicle = "qav_rxl";
  MissionSpec mission;
  VehicleOverrides vehicle_overrides;
  std::optional<ThrowSpec> throw_spec;  // the key `throw`
  std::vector<ThrowSpec> throws;        // in its place; without both, nobody throws
  double after_s = 1;
  double duration_s = 10;
  SensorsSpec sensors;
  DelaySpec delays;
  dodge::Config dodger;
  OracleSpec oracle;
  ControllerSpec controller;
  FlightControllerSpec flight_controller;
  MotorSpec motors;

  // Not part of the file:
  std::string models_dir;                     // folder of rooms, vehicles and objects
  Plugin plugin;                              // of the pilot plugin; empty: none was given
  std::map<std::string, std::string> places;  // "file:line:column" of the keys that were given

  // One for each throw or group of throws of a flight, whichever key they stand under.
  std::vector<ThrowSpec> throw_specs() const {
    return throw_spec ? std::vector<ThrowSpec>{*throw_spec} : throws;
  }
  bool anyone_throws() const { return throw_spec || !throws.empty(); }

  template <class Visitor>
  void visit(Visitor& v) {
    v.file("extends",
           "Another scenario, relative to this file, whose keys hold where this file has none.");
    v.text("name", name, "Title of the campaign in tables; the file's name when empty.");
    v.text("description", description, "What the scenario is for.");
    v("seed", seed, 0, UINT64_MAX,
      "Names the random numbers: the same seed and scenario give the same results. Also the "
      "specimen of the cameras that all its throws see through (sensors.events.device).");
    v("repeats", repeats, 1, 1000000,
      "Number of throws (of quiet flights, when nobody throws); with a grid, of each cell.");
    v.varied(
        "grid", grid,
        "Keys to lists of values, such as {size_m: [0.1, 0.2]}; every combination is a cell of "
        "throws of its own. Keys of throw may stand without that word.");
    v.varied("sweep", sweep,
             "Keys to lists of values, as in grid; but every combination flies the same throws "
             "again, with the same noise, so that its values can be compared throw by throw. They "
             "are never pooled.");
    v("stop", stop,
      "Sequential stopping, with an interval that stays valid; without this key all throws are "
      "flown. All throws must be of one kind: without sweep and grid (draw a key with !choice "
      "instead).");
    const std::string before = dodger_preset(pilot);
    v("pilot", pilot, {kPaperPilot, kOwnPilot, kOraclePilot, kNoPilot, kPluginPilot},
      "Who flies. falanga2020: the paper's dodger; dodgesim: the same with what improves it (as a "
      "value of sweep it takes the place of all keys of dodger); oracle: one that is told the true "
      "obstacle; none: one that never dodges; plugin: your own, from the library that the option "
      "--plugin names, with falanga2020's defaults of dodger.");
    if (dodger_preset(pilot) != before) dodger = dodge::preset(dodger_preset(pilot));
    v.text("plugin_parameters", plugin_parameters,
           "Text that is handed to the pilot plugin as it is.");
    v("fly_oracle", fly_oracle,
      "Fly every throw with the pilot oracle too, which shows what perception costs; in a room "
      "set oracle.range_cap_m, or it flees into the walls.");
    v.model("room", room, "rooms", "The world around the vehicle.");
    v.model("vehicle", vehicle, "vehicles", "The quadrotor.");
    v("vehicle_overrides", vehicle_overrides, "What is different from the vehicle's model.");
    v("mission", mission, "What the vehicle does when it does not dodge.");
    v("throw", throw_spec, "What is thrown at the vehicle; without this key nobody throws.");
    v("throws", throws,
      "Several throws in one flight, in place of throw: a list of maps, each with the keys of "
      "throw. Up to 16 objects in all; launch_s says which come together.");
    v("after_s", after_s, 0.1, 60, "Flown on after the last object's predicted arrival.");
    v("duration_s", duration_s, 0.1, 3600,
      "Length of a flight when nobody throws (with a throw, after_s ends it).");
    v("sensors", sensors, "What the vehicle senses, and how badly.");
    v("delays", delays,
      "The latency chain, in simulated time. What arrives is dealt with at the next tick of 250 "
      "us: a delay that is no multiple of that acts as the next one.");
    v("dodger", dodger,
      "Detection and avoidance. The defaults are those of falanga2020; dodge/presets.cc has what "
      "dodgesim does otherwise.");
    v("oracle", oracle, "What the pilot oracle may see.");
    v("controller", controller, "From the velocity command to body rates and thrust.");
    v("flight_controller", flight_controller, "The body-rate loop and the mixer.");
    v("motors", motors, "Speed controllers and rotors.");
  }
};

// Reads and checks a scenario. Every problem is one sentence with file, line, column and key; all
// are reported together in one ScenarioError. Named models must exist in `models_dir` (empty: not
// checked). `settings` are laid over the file in their order.
Scenario load_scenario(const std::string& path, const std::string& models_dir,
                       const std::vector<Setting>& settings = {});
Scenario parse_scenario(const std::string& text, const std::string& file,
                        const std::string& models_dir, const std::vector<Setting>& settings = {});

// Every value spelled out; parse_scenario reads it back equal to the last bit.
std::string to_yaml(const Scenario& scenario);

// All keys with their defaults.
std::vector<ParameterDoc> scenario_docs();

}  // namespace dodgesim

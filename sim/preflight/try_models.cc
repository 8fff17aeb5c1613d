#include "sim/preflight/try_models.h"

#include <algorithm>
#include <cinttypes>
#include <map>
#include <numbers>
#include <set>
#include <sstream>
#include <stdexcept>
#include <vector>

#include "sim/base/error.h"
#include "sim/base/formatted.h"
#include "sim/base/gravity.h"
#include "sim/base/numbers.h"
#include "sim/config/expand.h"
#include "sim/config/pilot.h"
#include "sim/control/mixer.h"
#include "sim/flight/setup.h"
#include "sim/motors/motors.h"
#include "sim/preflight/placed.h"
#include "sim/render/scene_geometry.h"
#include "sim/world/model_trial.h"
#include "sim/world/models_digest.h"
#include "sim/world/world.h"

namespace dodgesim {

namespace {

// A size that every kind of object can have.
constexpr double kTrialSizeM = 0.2;

struct Trial {
  WorldSpec world;
  std::vector<VehiclePlace> places;
  double min_thrust_n = 0;         // the greatest idle thrust of a rotor
  bool seen = false;               // by a pilot's cameras
  bool stereo = false;             // both of which it needs
  double max_thrust_fraction = 1;  // the least
};

// The same for worlds that the same trial serves.
std::string description(const WorldSpec& world) {
  const VehicleOverrides& overrides = world.vehicle_overrides;
  std::ostringstream text;
  text.precision(17);
  text << world.models_dir << '/' << world.room << '/' << world.vehicle << '/'
       << overrides.mass_scale << '/' << overrides.max_thrust_n << '/' << overrides.inertia_scale
       << '/' << overrides.stereo_baseline_m << '/' << overrides.lower_camera_turn_deg.transpose();
  for (const ObjectSpec& object : world.objects) text << '/' << object.kind;
  return text.str();
}

std::string description(const Trial& trial) {
  std::ostringstream text;
  text.precision(17);
  text << description(trial.world) << ' ' << trial.min_thrust_n << ' ' << trial.seen << ' '
       << trial.stereo << ' ' << trial.max_thrust_fraction;
  for (const VehiclePlace& place : trial.places) {
    text << ' ' << place.p_W.transpose() << ' ' << place.heading_rad;
  }
  return text.str();
}

void add_place(const VehiclePlace& place, std::vector<VehiclePlace>& places) {
  const auto same = [&place](const VehiclePlace& other) {
    return other.p_W == place.p_W && other.heading_rad == place.heading_rad;
  };
  if (std::ranges::none_of(places, same)) places.push_back(place);
}

// The mission's start and goals.
void add_places(const MissionSpec& mission, std::vector<VehiclePlace>& places) {
  const double heading_rad = mission.heading_deg * std::numbers::pi / 180;
  add_place({"mission.start_m", mission.start_m, heading_rad}, places);
  if (mission.type == "goal") add_place({"mission.goal_m", *mission.goal_m, heading_rad}, places);
  if (mission.type != "waypoints") return;
  for (const Eigen::Vector3d& p_W : mission.waypoints_m) {
    add_place({"mission.waypoints_m", p_W, heading_rad}, places);
  }
}

// Every world that the campaign names, with all its objects, and where the vehicle is to be in it.
std::vector<Trial> trials_of(const Scenario& campaign) {
  std::map<std::string, Trial> trials;  // each kind of world once
  std::set<std::string> kinds;
  for_each_combination(campaign, [&](const Scenario& scenario) {
    const WorldSpec world = world_spec(scenario, {});
    Trial& trial = trials.try_emplace(description(world), Trial{world, {}}).first->second;
    add_places(scenario.mission, trial.places);
    trial.min_thrust_n = std::max(trial.min_thrust_n, scenario.motors.min_thrust_n);
    const bool seen = perceives(scenario.pilot);
    trial.seen |= seen;
    trial.stereo |= seen && scenario.dodger.position.stereo_depth();
    trial.max_thrust_fraction =
        std::min(trial.max_thrust_fraction, scenario.controller.max_thrust_fraction);
    for (const ThrowSpec& spec : scenario.throw_specs()) {
      kinds.insert(spec.object.names.begin(), spec.object.names.end());
    }
  });
  std::vector<Trial> all;
  for (auto& [name, trial] : trials) {
    trial.world.objects.reserve(kinds.size());
    for (const std::string& kind : kinds) trial.world.objects.push_back({kind, kTrialSizeM});
    all.push_back(trial);
  }
  return all;
}

// What `check` throws is the vehicle's fault.
template <class Check>
void blame_vehicle(const Trial& trial, const Check& check) {
  try {
    check();
  } catch (const std::invalid_argument& error) {
    throw ScenarioError(trial.world.path(trial.world.vehicle_file()) + ": " + error.what());
  }
}

// Whether the flight core can use the cameras.
void check_stereo(const World& world, const Trial& trial) {
  Scenario scenario;
  scenario.vehicle_overrides = trial.world.vehicle_overrides;
  dodge::Config config;
  config.position.depth = "stereo";
  config.cameras = camera_models(scenario, world.vehicle());
  blame_vehicle(trial, [&] { dodge::validate(config); });
}

// Whether the mixer can use the rotors.
void check_rotors(const World& world, const Trial& trial) {
  blame_vehicle(
      trial, [&] { Mixer(world.vehicle(), trial.min_thrust_n, world.vehicle().max_thrust_n, 0); });
}

// Whether each rotor lifts its share of the weight with some to spare.
void check_lift(const World& world, const Trial& trial) {
  const VehicleParameters& vehicle = world.vehicle();
  const double weight_n = vehicle.mass_kg * kGravityMps2;
  const Mixer mixer(vehicle, 0, weight_n, 0);
  const double share_n = std::ranges::max(mixer.rotor_thrusts({weight_n, {0, 0, 0}}));
  const double lift = trial.max_thrust_fraction * vehicle.max_thrust_n / share_n;
  if (lift >= kLeastLift) return;
  throw ScenarioError(
      "controller.max_thrust_fraction is " + to_text(trial.max_thrust_fraction) +
      formatted(", with which a rotor of %s lifts only %.4g times its share of %.4g kg, which is "
                "%.4g N; it needs at least %g to fly (vehicle_overrides.mass_scale, "
                "vehicle_overrides.max_thrust_n).",
                trial.world.vehicle_file().c_str(), lift, vehicle.mass_kg, share_n, kLeastLift));
}

// Of all models only rooms can have geoms that are refused: height fields never move.
SceneGeometry scene_of(const World& world, const Trial& trial) {
  try {
    return collect_scene(world.model(), world.object_bodies(), false);
  } catch (const ScenarioError& error) {
    throw ScenarioError(trial.world.path(trial.world.room_file()) + ": " + error.what());
  }
}

// Whether the event cameras see the objects.
void check_visible(const World& world, const Trial& trial) {
  const SceneGeometry scene = scene_of(world, trial);
  std::set<int> visible;
  for (const Primitive& primitive : scene.primitives) visible.insert(primitive.object);
  for (const auto& [object, batch] : scene.moving_triangles) visible.insert(object);
  for (int i = 0; i < world.object_count(); ++i) {
    if (visible.contains(i)) continue;
    throw ScenarioError(trial.world.path(trial.world.objects[static_cast<std::size_t>(i)].file()) +
                        ": No geom of the object can be seen: groups 3 and above and an alpha of 0 "
                        "are hidden.");
  }
}

void check_world(const World& world, const Trial& trial) {
  const double most_n = world.vehicle().max_thrust_n;
  if (trial.min_thrust_n >= most_n) {
    throw ScenarioError("motors.min_thrust_n is " + to_text(trial.min_thrust_n) +
                        ", but must be less than what a rotor of " + trial.world.vehicle_file() +
                        " gives at most, which is " + to_text(most_n) + " N.");
  }
  const double weight_n = world.vehicle().mass_kg * kGravityMps2;
  if (4 * trial.min_thrust_n >= weight_n) {
    throw ScenarioError("motors.min_thrust_n is " + to_text(trial.min_thrust_n) +
                        formatted(", but must be less than %.4g N, a quarter of the vehicle's "
                                  "weight: idling rotors would lift it.",
                                  weight_n / 4));
  }
  check_rotors(world, trial);
  check_lift(world, trial);
  if (trial.stereo) check_stereo(world, trial);
  if (trial.seen) check_visible(world, trial);
}

}  // namespace

void try_models(const std::vector<Scenario>& campaigns) {
  std::set<std::string> tried;
  for (const Scenario& campaign : campaigns) {
    for (const Trial& trial : trials_of(campaign)) {
      if (!tried.insert(description(trial)).second) continue;
      try {
        try_world(trial.world, trial.places,
                  [&trial](const World& world) { check_world(world, trial); });
      } catch (const ScenarioError& error) {
        throw ScenarioError(placed(error.what(), place_named_in(error.what(), campaign)));
      }
    }
  }
}

std::string digest_of_models(const Scenario& campaign) {
  std::uint64_t digest = 0;
  for (const Trial& trial : trials_of(campaign)) digest = 31 * digest + models_digest(trial.world);
  return formatted("%016" PRIx64, digest);
}

}  // namespace dodgesim

#include "sim/config/idle_keys.h"

#include <algorithm>

#include "sim/base/contains.h"
#include "sim/base/joined.h"
#include "sim/config/dotted_keys.h"
#include "sim/config/expand.h"
#include "sim/config/pilot.h"

namespace dodgesim {

namespace {

struct IdleRule {
  std::string key;                  // or a group of them
  std::vector<std::string> except;  // keys of the group that always count
  bool (*acts)(const Scenario&);
  std::string reason;
};

bool sees(const Scenario& scenario) { return perceives(scenario.pilot); }

bool stereo(const Scenario& scenario) { return scenario.dodger.position.stereo_depth(); }

// A plug-in may do as it likes with the keys of dodger.
bool may_measure_mono(const Scenario& s) { return s.pilot == kPluginPilot || !stereo(s); }
bool may_measure_stereo(const Scenario& s) { return s.pilot == kPluginPilot || stereo(s); }

bool correlates(const Scenario& s) {
  return s.pilot == kPluginPilot || s.dodger.position.stereo.disparity != "centres";
}
bool gates_by_metres(const Scenario& s) {
  return s.pilot == kPluginPilot || s.dodger.association.gate_sigmas == 0;
}
bool monitors(const Scenario& s) {
  return s.pilot == kPluginPilot || s.dodger.height_monitor.enabled;
}

bool flies_field(const Scenario& s) {
  return s.pilot == kPluginPilot || s.dodger.escape.law == "potential_field";
}

bool flies_oracle(const Scenario& s) { return s.fly_oracle || s.pilot == kOraclePilot; }

// The field ends at eta_0_m from the vehicle's surface. No cap changes anything beyond it by half
// of the largest object, the camera's distance from the vehicle's centre and what an object flies
// until the oracle knows of it.
bool caps_within_field(const Scenario& s) {
  constexpr double kMostBeyondM = 1, kFastestMps = 50;
  const dodge::RepulsiveConfig& field = s.dodger.repulsive;
  const TimeUs age_us = s.sensors.events.latency_us + s.delays.packet_us + s.delays.period_us() +
                        s.delays.transport_us;
  const double reach_m =
      field.eta_0_m + field.quadrotor_radius_m + kMostBeyondM + kFastestMps * seconds(age_us);
  return !flies_oracle(s) || s.dodger.escape.law != "potential_field" ||
         s.oracle.range_cap_m < reach_m;
}

constexpr const char* kNoField = "dodger.escape.law is closest_approach";
constexpr const char* kCentres = "dodger.position.stereo.disparity is centres";
constexpr const char* kGates = "dodger.association.gate_sigmas is not 0";
constexpr const char* kNoMonitor = "dodger.height_monitor.enabled is false";
constexpr const char* kBlind = "no pilot that flies has cameras";
constexpr const char* kStereo = "dodger.position.depth is stereo";
constexpr const char* kMono = "dodger.position.depth is mono";

const IdleRule kRules[] = {
    {"plugin_parameters",
     {},
     [](const Scenario& s) { return s.pilot == kPluginPilot; },
     "the pilot is not plugin"},
    {"oracle", {}, flies_oracle, "the pilot oracle does not fly"},
    {"oracle.range_cap_m", {}, caps_within_field, "dodger.repulsive.eta_0_m ends the field nearer"},
    {"dodger.escape",
     {"dodger.escape.law"},
     [](const Scenario& s) {
       return s.pilot == kPluginPilot || s.dodger.escape.law != "potential_field";
     },
     "dodger.escape.law is potential_field"},
    {"dodger.repulsive",
     {"dodger.repulsive.k_r0", "dodger.repulsive.lambda_decay_1ps", "dodger.repulsive.k_tau"},
     flies_field,
     kNoField},
    {"dodger.window", {}, sees, kBlind},
    {"dodger.time_image", {}, sees, kBlind},
    {"dodger.cluster", {}, sees, kBlind},
    {"dodger.association", {}, sees, kBlind},
    {"dodger.flow", {}, sees, kBlind},
    {"dodger.ego_motion", {}, sees, kBlind},
    {"dodger.position", {"dodger.position.depth"}, sees, kBlind},
    {"delays.lower_camera_us", {}, sees, kBlind},
    {"sensors.events", {"sensors.events.latency_us", "sensors.events.preset"}, sees, kBlind},
    {"sensors.render", {}, sees, kBlind},
    {"sensors.sampling", {}, sees, kBlind},
    {"sensors.keys", {}, sees, kBlind},
    {"dodger.position.stereo.search_px", {}, correlates, kCentres},
    {"dodger.position.stereo.min_correlation", {}, correlates, kCentres},
    {"dodger.position.stereo.min_share_of_best", {}, correlates, kCentres},
    {"dodger.association.first_radius_m", {}, gates_by_metres, kGates},
    {"dodger.association.first_speed_mps", {}, gates_by_metres, kGates},
    {"dodger.association.radius_m", {}, gates_by_metres, kGates},
    {"dodger.window.camera_lag_us", {}, may_measure_stereo, kMono},
    {"sensors.range", {}, monitors, kNoMonitor},
    {"dodger.landing", {}, monitors, kNoMonitor},
    {"dodger.range_sensor", {}, monitors, kNoMonitor},
    {"dodger.height_monitor", {"dodger.height_monitor.enabled"}, monitors, kNoMonitor},
    {"dodger.position.known_size_m", {}, may_measure_mono, kStereo},
    {"dodger.position.side_sigma_px", {}, may_measure_mono, kStereo},
    {"dodger.position.stereo", {}, may_measure_stereo, kMono},
    {"delays.lower_camera_us", {}, stereo, kMono},
    {"vehicle_overrides.lower_camera_turn_deg", {}, stereo, kMono},
    {"sensors.render.flicker_depth",
     {},
     [](const Scenario& s) { return s.sensors.render.flicker.flicker_hz > 0; },
     "sensors.render.flicker_hz is 0"},
    {"sensors.events.illuminance_lux",
     {},
     [](const Scenario& s) {
       const EventCameraSpec& camera = s.sensors.events;
       return camera.photoreceptor_hz > 0 || camera.shot_noise_on_hz > 0 ||
              camera.shot_noise_off_hz > 0;
     },
     "the camera has neither photoreceptor_hz nor shot noise"},
    {"sensors.events.hot_pixel_hz",
     {},
     [](const Scenario& s) { return s.sensors.events.hot_pixel_fraction > 0; },
     "sensors.events.hot_pixel_fraction is 0"},
    {"sensors.events.hot_pixel_sigma",
     {},
     [](const Scenario& s) {
       return s.sensors.events.hot_pixel_fraction > 0 && s.sensors.events.hot_pixel_hz > 0;
     },
     "there is no hot pixel"},
    {"sensors.events.photoreceptor_dark_hz",
     {},
     [](const Scenario& s) { return s.sensors.events.photoreceptor_hz > 0; },
     "sensors.events.photoreceptor_hz is 0"},
    {"sensors.state_estimate.height_drift_start_s",
     {},
     [](const Scenario& s) { return s.sensors.state_estimate.height_drift_mps != 0; },
     "sensors.state_estimate.height_drift_mps is 0"},
    {"mission.waypoint_radius_m",
     {},
     [](const Scenario& s) { return s.mission.type == "waypoints"; },
     "mission.type is not waypoints"},
    {"throw.interval_s",
     {},
     [](const Scenario& s) { return !s.throw_spec || s.throw_spec->count > 1; },
     "throw.count is 1"},
    {"after_s",
     {},
     [](const Scenario& s) { return s.anyone_throws(); },
     "nobody throws, and duration_s is the length of a flight"},
    {"duration_s",
     {},
     [](const Scenario& s) { return !s.anyone_throws(); },
     "after_s ends a flight with a throw"},
};

// The keys that the scenario gives of a rule's, without those of groups.
std::vector<std::string> given(const IdleRule& rule, const Scenario& scenario) {
  std::vector<std::string> keys;
  for (const auto& [key, place] : scenario.places) {
    const bool ruled = key == rule.key || key.starts_with(rule.key + ".");
    if (ruled && !is_group(scenario.places, key) && !contains(rule.except, key))
      keys.push_back(key);
  }
  return keys;
}

// As a resolved scenario does; nobody writes all keys of a group so large.
bool gives_all_keys(const Scenario& scenario) {
  const std::vector<ParameterDoc> docs = scenario_docs();
  return std::ranges::all_of(docs, [&scenario](const ParameterDoc& doc) {
    return !doc.path.starts_with("sensors.") || scenario.places.contains(doc.path);
  });
}

}  // namespace

std::vector<std::string> idle_keys(const Scenario& scenario) {
  std::vector<std::string> notes;
  if (gives_all_keys(scenario)) return notes;
  std::vector<const IdleRule*> idle;
  for (const IdleRule& rule : kRules) {
    if (!given(rule, scenario).empty()) idle.push_back(&rule);
  }
  if (idle.empty()) return notes;
  for_each_combination(scenario, [&](const Scenario& flown) {
    std::erase_if(idle, [&](const IdleRule* rule) { return rule->acts(flown); });
  });
  for (const IdleRule* rule : idle) {
    const std::vector<std::string> keys = given(*rule, scenario);
    notes.push_back(scenario.places.at(keys.front()) + ": " + joined(keys, {}, " and ") +
                    (keys.size() == 1 ? " has" : " have") + " no effect: " + rule->reason + ".");
  }
  return notes;
}

}  // namespace dodgesim

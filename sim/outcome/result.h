// What one throw of a campaign leaves behind. visit() lists the columns of throws.csv, objects.csv,
// detections.csv and truth.csv; the same list carries a result from a worker process to the
// campaign.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "sim/base/time.h"
#include "sim/config/axis_value.h"

namespace dodgesim {

// One pilot's flight through the throw.
struct FlightResult {
  std::string status = "not flown";  // "ok", "error", "lost" or "not flown"
  std::string error;                 // why, when the status is "error" or "lost"
  bool hit = false;                  // an object touched the vehicle
  bool crashed = false;              // the vehicle touched the room
  std::optional<TimeUs> hit_us;      // of the first touch
  std::optional<TimeUs> closest_us;
  std::optional<double> clearance_m;  // smallest distance between the surfaces; empty: nobody threw

  bool ok() const { return status == "ok"; }
  // The simulation failed, or was lost with its worker, which need not happen again.
  bool failed() const { return status == "error" || lost(); }
  bool lost() const { return status == "lost"; }
  bool unharmed() const { return ok() && !hit && !crashed; }

  template <class Visitor>
  void visit(Visitor& v) {
    v("status", status);
    v("error", error);
    v("hit", hit);
    v("crashed", crashed);
    v("hit_us", hit_us);
    v("closest_us", closest_us);
    v("clearance_m", clearance_m);
  }
};

// How an object is thrown, as drawn (sim/world/throw.h).
struct DrawnThrow {
  double size_m = 0;
  double speed_mps = 0;
  double distance_m = 0;
  double bearing_deg = 0;
  std::array<double, 2> aim_offset_m{};  // lateral, vertical
  std::array<double, 3> spin_radps{};
  double launch_height_m = 0;
  TimeUs launch_us = 0;

  template <class Visitor>
  void visit(Visitor& v) {
    v("size_m", size_m);
    v("speed_mps", speed_mps);
    v("distance_m", distance_m);
    v("bearing_deg", bearing_deg);
    v("aim_offset_m", aim_offset_m);
    v("spin_radps", spin_radps);
    v("launch_height_m", launch_height_m);
    v("launch_us", launch_us);
  }
};

// One thrown object of a throw: a row of objects.csv.
struct ObjectRow : DrawnThrow {
  int throw_index = 0;
  int object = 0;
  std::string kind;

  // What came of it with the scenario's pilot. The flight ends when any object hits.
  bool hit = false;
  std::optional<TimeUs> hit_us;
  std::optional<TimeUs> closest_us;
  std::optional<double> clearance_m;
  std::optional<TimeUs> first_detection_us;
  std::optional<double> first_detection_distance_m;
  bool none_hit = false;         // of the pilot none
  bool none_after_room = false;  // likewise: it had touched the room when it came nearest

  template <class Visitor>
  void visit(Visitor& v) {
    v("throw", throw_index);
    v("object", object);
    v("kind", kind);
    DrawnThrow::visit(v);
    v("hit", hit);
    v("hit_us", hit_us);
    v("closest_us", closest_us);
    v("clearance_m", clearance_m);
    v("first_detection_us", first_detection_us);
    v("first_detection_distance_m", first_detection_distance_m);
    v("none_hit", none_hit);
    v("none_after_room", none_after_room);
  }
};

// One detection, beside the truth at its time. Positions are in the frame of the state estimate,
// which drifts from the world's.
struct DetectionRow {
  int throw_index = 0;
  TimeUs t_us = 0;       // the instant the position speaks of
  TimeUs output_us = 0;  // when the pilot reported it
  int obstacle_id = -1;
  std::array<double, 3> p_W{};  // estimated centre [m]
  double size_m = 0;
  double depth_m = 0;  // along the camera's optical axis
  double depth_sigma_m = 0;
  std::optional<int> object;  // the true object nearest to the estimate; empty: none in flight
  std::optional<std::array<double, 3>> true_p_W;
  std::optional<double> position_error_m;
  std::optional<double> true_depth_m;

  template <class Visitor>
  void visit(Visitor& v) {
    v("throw", throw_index);
    v("t_us", t_us);
    v("output_us", output_us);
    v("obstacle_id", obstacle_id);
    v("p_W", p_W);
    v("size_m", size_m);
    v("depth_m", depth_m);
    v("depth_sigma_m", depth_sigma_m);
    v("object", object);
    v("true_p_W", true_p_W);
    v("position_error_m", position_error_m);
    v("true_depth_m", true_depth_m);
  }
};

// Events of the pilot's windows in one cycle or several, both cameras together; see
// sim/observers/event_truth.h.
struct EventTruthCounts {
  std::int64_t events = 0;
  std::int64_t object_events = 0;        // that an object made
  std::int64_t found_events = 0;         // that the pilot took for an obstacle's
  std::int64_t found_object_events = 0;  // both

  void add(const EventTruthCounts& other) {
    events += other.events;
    object_events += other.object_events;
    found_events += other.found_events;
    found_object_events += other.found_object_events;
  }

  // Of what was found, the share that an object made; of what an object made, the share that was
  // found.
  std::optional<double> precision() const { return share(found_events); }
  std::optional<double> recall() const { return share(object_events); }

  template <class Visitor>
  void visit(Visitor& v) {
    v("events", events);
    v("object_events", object_events);
    v("found_events", found_events);
    v("found_object_events", found_object_events);
  }

 private:
  std::optional<double> share(std::int64_t of) const {
    if (of == 0) return std::nullopt;
    return static_cast<double>(found_object_events) / static_cast<double>(of);
  }
};

// One cycle of the pilot while an object is in flight: a row of truth.csv.
struct EventTruthRow {
  int throw_index = 0;
  TimeUs cycle_us = 0;   // its start
  bool evading = false;  // an evasive command has reached the flight controller by then
  EventTruthCounts counts;

  template <class Visitor>
  void visit(Visitor& v) {
    v("throw", throw_index);
    v("cycle_us", cycle_us);
    v("evading", evading);
    counts.visit(v);
    std::optional<double> precision = counts.precision(), recall = counts.recall();
    v("event_precision", precision);
    v("event_recall", recall);
  }
};

// Sums over many rows.
struct EventTruthSums {
  EventTruthCounts before;  // until the vehicle evades
  EventTruthCounts after;

  void add(const std::vector<EventTruthRow>& rows) {
    for (const EventTruthRow& row : rows) (row.evading ? after : before).add(row.counts);
  }
};

struct ThrowResult : DrawnThrow {
  // One of the flights below: &ThrowResult::flown, none or oracle.
  using FlightOf = FlightResult ThrowResult::*;

  int index = 0;

  // Where the throw stands in the campaign; see sim/config/expand.h. Results of different sweep
  // values are of the same throws and must never be pooled.
  int cell = 0;
  int sweep = 0;
  std::vector<AxisValue> cell_values;   // the keys of the grid and their values in this cell
  std::vector<AxisValue> sweep_values;  // likewise of the sweep

  // How many objects there are, and the first one's kind. Without an object nobody threw.
  int objects = 0;
  std::string object;

  FlightResult flown;   // the scenario's pilot
  FlightResult none;    // would it have hit?
  FlightResult oracle;  // perfect perception, same avoidance and controller
  // An object had touched the room when it came nearest to the vehicle that none flew.
  bool none_after_room = false;

  // Of the flown pilot.
  // The object that was detected first (any, if none was) was in view of a camera, 1 px wide.
  std::optional<TimeUs> first_in_view_us;
  std::optional<TimeUs> first_detection_us;    // output of the first detection of a true object
  std::optional<TimeUs> first_detection_t_us;  // the instant it speaks of
  std::optional<double> first_detection_distance_m;  // true distance object to camera then
  // From its output to the contact if nobody dodged (to the closest approach, if that is none).
  // Empty if another object makes that contact.
  std::optional<TimeUs> time_to_contact_us;
  std::optional<TimeUs> first_command_us;  // first evasive command at the flight controller
  bool evaded = false;                     // any evasive command
  bool false_alarm = false;          // an evasive command before any detection of a true object
  std::optional<TimeUs> landing_us;  // the pilot gave up: its first command to land
  std::optional<TimeUs> landed_us;   // it touched down gently; the flight ends there
  std::string cause;                 // of a hit or crash (collision_cause.h)
  std::optional<double> escape_left_s, escape_needed_s;  // EscapeTimes
  int detections = 0;
  std::array<std::int64_t, 2> events{};       // of the top and bottom camera
  std::array<std::int64_t, 2> events_lost{};  // by a readout that could not serve them
  std::uint64_t events_hash = 0;              // of all events in order
  TimeUs duration_us = 0;                     // simulated

  std::vector<ObjectRow> object_rows;
  std::vector<DetectionRow> detection_rows;
  std::vector<EventTruthRow> truth_rows;  // on request
  std::string trajectory;                 // of the flown pilot, for the report (trajectory.h)
  double wall_s = 0;  // computing time of the flown pilot: in timing.csv, never in throws.csv

  // The tables and the report need none of objects, detections and causes of events.
  void drop_rows() {
    object_rows = {};
    detection_rows = {};
    truth_rows = {};
  }

  bool thrown() const { return !object.empty(); }
  bool lost() const { return flown.lost(); }
  // Its failure is no pilot's: it could not be launched, or its flight failed with every pilot,
  // also with none.
  bool nobody_could_fly() const {
    return thrown() && flown.failed() && !lost() && !none.ok() && !oracle.ok();
  }
  // The flown pilot gave up before the object came that would have hit: whatever becomes of the
  // throw, it is not dodged.
  bool gave_up() const { return landing_us && (!none.hit_us || *landing_us < *none.hit_us); }
  // By a pilot: the pilot none was hit, and this one was neither hit nor crashed, and had not given
  // up. A throw that failed with an error, for either, never counts.
  bool dodged(FlightOf by = &ThrowResult::flown) const {
    return none.ok() && none.hit && (this->*by).unharmed() &&
           !(by == &ThrowResult::flown && gave_up());
  }

  template <class Visitor>
  void visit(Visitor& v) {
    v("throw", index);
    v("cell", cell);
    v("sweep", sweep);
    v("", cell_values);
    v("", sweep_values);
    v("objects", objects);
    v("object", object);
    DrawnThrow::visit(v);
    v("flown", flown);
    v("none", none);
    v("oracle", oracle);
    v("none_after_room", none_after_room);
    v("first_in_view_us", first_in_view_us);
    v("first_detection_us", first_detection_us);
    v("first_detection_t_us", first_detection_t_us);
    v("first_detection_distance_m", first_detection_distance_m);
    v("time_to_contact_us", time_to_contact_us);
    v("first_command_us", first_command_us);
    v("evaded", evaded);
    v("false_alarm", false_alarm);
    v("landing_us", landing_us);
    v("landed_us", landed_us);
    v("cause", cause);
    v("escape_left_s", escape_left_s);
    v("escape_needed_s", escape_needed_s);
    v("detections", detections);
    v("events", events);
    v("events_lost", events_lost);
    v("events_hash", events_hash);
    v("duration_us", duration_us);
  }
};

}  // namespace dodgesim

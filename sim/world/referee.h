// The truth about a throw: did an object touch the vehicle, and how near did it come?
#pragma once

#include <Eigen/Dense>
#include <limits>
#include <optional>
#include <vector>

#include "sim/base/time.h"
#include "sim/world/convex.h"
#include "sim/world/world.h"

namespace dodgesim {

// About one object, or about the nearest of all.
struct Approach {
  bool hit = false;
  std::optional<TimeUs> hit_us;  // first contact, at the end of the tick that brought it
  // Smallest distance so far between the surfaces of object and vehicle hull; 0 after a contact,
  // infinite before the launch.
  double clearance_m = std::numeric_limits<double>::infinity();
  std::optional<TimeUs> closest_us;  // when (the first contact if hit)
  bool after_room = false;           // by then it had touched the room: it flew as nobody threw it
};

// A vehicle that means to land has landed, and not crashed, if it touches the room from above at no
// more than this speed and tilt: a drop from 5 cm.
inline constexpr double kTouchdownMps = 1.0;
inline constexpr double kTouchdownTiltDeg = 15;

struct Verdict {
  std::vector<Approach> objects;  // by object index
  Approach nearest;               // of all objects: the first hit, else the smallest clearance
  int nearest_object = -1;        // -1 before the first launch
  bool crashed = false;           // the vehicle touched the room
  bool landed = false;  // it touched the floor, or what stands on it, gently and on purpose
  TimeUs landed_us = -1;
};

// Observes every tick. The vehicle's hull is the geoms of its body that can collide.
class Referee {
 public:
  // Throws ScenarioError if a hull or object geom is of a kind without a known distance.
  explicit Referee(const World& world);

  // Forgets everything; call after World::reset.
  void reset();

  // Call after reset and after each step. `landing`: the vehicle has been told to land. Distances
  // are exact at ticks; between them the clearance is missed by less than the way of the nearest
  // points in half a tick, and where a ball of radius r passes an edge at clearance c by about
  // (relative speed x half a tick)^2 / (2 (r + c)).
  void observe(const World& world, bool landing = false);

  const Verdict& verdict() const { return verdict_; }

  // The vehicle's hull, in B.
  const std::vector<Convex>& hull() const { return hull_.parts; }
  // Object i, in its frame.
  const std::vector<Convex>& shape(int object) const {
    return objects_.at(static_cast<std::size_t>(object)).parts;
  }

 private:
  struct Body {
    std::vector<Convex> parts;
    double radius_m = 0;  // of the sphere about the body's origin that encloses the parts
    int id = 0;           // in the model
  };

  static Body read_body(const World& world, int body, const std::string& file);
  void observe_contacts(const World& world);
  void observe_object(std::size_t i, const Snapshot& now);
  void observe_room(const World& world, bool landing);

  Body hull_;
  std::vector<Body> objects_;
  std::vector<bool> touched_room_;  // by object, since the launch
  Verdict verdict_;
};

}  // namespace dodgesim

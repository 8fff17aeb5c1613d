// Room, vehicle and thrown objects: the physics of one throw, in ticks of kTickUs.
//
// MuJoCo gives geometry, contacts and accelerations; every moving body is a free rigid body, which
// World integrates itself. What is thrown flies to second order and better: without drag along the
// exact parabola (MuJoCo's Euler step is 1.2 mm off after 1 s, its Runge-Kutta step costs four
// times as much). The vehicle turns as exactly, but its rotors push throughout a tick with the
// thrust and along the axis that they had at its start, half a tick late: a millimetre or two after
// some seconds of hard turns.
#pragma once

#include <Eigen/Dense>
#include <array>
#include <optional>
#include <string>
#include <vector>

#include "sim/base/mujoco.h"
#include "sim/world/compose.h"
#include "sim/world/contact_bound.h"
#include "sim/world/model_reader.h"
#include "sim/world/snapshot.h"
#include "sim/world/vehicle_parameters.h"

namespace dodgesim {

inline constexpr double kAirDensityKgpm3 = 1.2;  // dry air at 20 degrees C, 1013 hPa

// Where two bodies are in each other.
struct Overlap {
  std::string with;  // "object 0", "the vehicle", "the room's \"floor\""
  double depth_m = 0;
};

class World {
 public:
  // Throws ScenarioError with one sentence that names the file.
  explicit World(const WorldSpec& spec);

  const WorldSpec& spec() const { return spec_; }
  const VehicleParameters& vehicle() const { return vehicle_; }
  const ObjectPhysics& object(int i) const { return objects_.at(static_cast<std::size_t>(i)); }
  int object_count() const { return static_cast<int>(objects_.size()); }

  // Time 0: the vehicle level at p_WB with the given heading and velocity, all objects parked far
  // away, invisible and unable to collide.
  void reset(const Eigen::Vector3d& p_WB, double yaw_rad, const Eigen::Vector3d& v_W);

  // Object i flies free from now on, and touches what is in its way or, to try it, nothing.
  void launch(int i, const BodyState& state, bool touches = true);

  // What object i is inside by more than a body that rests sinks in, now; nothing if it is free.
  std::optional<Overlap> overlap(int i) const;

  // One tick. Thrusts are held over it and clipped to [0, max_thrust_n]. Throws SimulationError
  // when the state diverges; the world must then be reset.
  void step(const std::array<double, 4>& rotor_thrust_n);

  // True state now. Accelerations are means over the tick that ends now (zero after reset).
  const Snapshot& snapshot() const { return snapshot_; }

  // MuJoCo's view of the same instant: positions and contacts are up to date.
  const mjModel& model() const { return *model_; }
  const mjData& data() const { return *data_; }
  int vehicle_body() const { return vehicle_body_; }
  const std::vector<int>& object_bodies() const { return object_bodies_; }
  int object_body(int i) const { return object_bodies_.at(static_cast<std::size_t>(i)); }

  // Whether the geom belongs to the room, a hull or an object's surface, rather than being for the
  // eye only. (The model's own contact bits of objects are off before their launch.)
  bool can_collide(int geom) const {
    const auto g = static_cast<std::size_t>(geom);
    return contype_[g] != 0 || conaffinity_[g] != 0;
  }

 private:
  BodyState state(const FreeBody& body) const;
  void set_state(const FreeBody& body, const BodyState& state);
  void set_collisions(int i, bool on);
  std::string owner_of(int geom) const;
  void update_positions();
  void apply_drag();
  void integrate(const FreeBody& body);
  void check_accelerations() const;
  void fill_snapshot();

  WorldSpec spec_;
  MjModelPtr model_;
  MjDataPtr data_;
  std::vector<int> contype_, conaffinity_;  // by geom, as the model files say
  VehicleParameters vehicle_;
  std::vector<ObjectPhysics> objects_;
  int vehicle_body_ = 0;
  std::vector<int> object_bodies_;
  FreeBody vehicle_free_;
  std::vector<FreeBody> objects_free_;
  std::optional<ContactBound> contact_bound_;
  std::vector<bool> in_flight_;              // the vehicle, then the objects
  std::vector<Eigen::Vector3d> object_a_W_;  // over the last tick: predicts the middle of the next
  Snapshot snapshot_;
};

}  // namespace dodgesim

// What a composed model says of the vehicle and the thrown objects, checked for what the simulation
// takes for granted.
#pragma once

#include <Eigen/Dense>
#include <span>
#include <string>

#include "sim/base/mujoco.h"
#include "sim/world/vehicle_overrides.h"
#include "sim/world/vehicle_parameters.h"

namespace dodgesim {

// What the rotors must lift at least to fly, in weights of the vehicle.
inline constexpr double kLeastLift = 1.2;

// One free rigid body in MuJoCo's state vectors.
struct FreeBody {
  int body = 0;
  int qpos = 0;            // first of 7: position in W, quaternion (w x y z)
  int qvel = 0;            // first of 6: velocity in W, angular velocity in the body's frame
  Eigen::Matrix3d J_kgm2;  // about the centre of mass, in the body's frame
  Eigen::Matrix3d J_inv;
};

// A thrown object's constants at its size.
struct ObjectPhysics {
  double mass_kg = 0;
  double drag_area_m2 = 0;       // Cd * A: the drag force is 1/2 rho Cd A |v| v
  double bounding_radius_m = 0;  // of the sphere about its centre of mass that encloses it
};

// Reads what one file brought into the model, which must outlive the reader. All members throw
// ScenarioError with one sentence that begins with the file's name.
class ModelReader {
 public:
  ModelReader(const mjModel& model, std::string file) : model_(model), file_(std::move(file)) {}

  int find(mjtObj type, const std::string& name) const;

  // That whatever shows the room, or measures to it, takes the same geoms for it, and that they
  // push at what touches them only.
  void check_room() const;

  // A body that is free, rigid, has its centre of mass at its origin, and pushes at what touches it
  // only.
  FreeBody free_body(int body) const;

  // Changes the model itself, so that whatever reads it agrees. `model` is that of the reader.
  void override_vehicle(mjModel& model, mjData& data, const VehicleOverrides& overrides) const;

  // Of a model that is overridden already; mass_scale: by how much its mass was.
  VehicleParameters vehicle(double mass_scale) const;

  // `prefix`: what the names of the object begin with. Its geoms that collide, and those that are
  // seen, must fit its size `size_m`, as its longest extension.
  ObjectPhysics object(const std::string& prefix, double size_m) const;

 private:
  int find_on_vehicle(mjtObj type, const std::string& name) const;  // a camera or a site
  std::span<const double> numeric(const std::string& name, int count) const;
  void check_geom(int geom) const;
  void check_contact(int geom) const;
  void check_paint(int geom) const;
  void check_rotor(int site, int actuator) const;
  void check_reach(int body, double size_m, const char* which,
                   bool (*wanted)(const mjModel& model, int geom)) const;
  void read_rotors(VehicleParameters& vehicle) const;

  const mjModel& model_;
  std::string file_;
};

}  // namespace dodgesim

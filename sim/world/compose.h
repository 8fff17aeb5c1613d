// Puts room, vehicle and thrown objects together into one MJCF model.
#pragma once

#include <string>
#include <vector>

#include "sim/base/mujoco.h"
#include "sim/world/vehicle_overrides.h"

namespace dodgesim {

// A kind of object is a file of one body at a reference size.
struct ObjectSpec {
  std::string kind = "ball";
  double size_m = 0.2;  // longest edge or diameter, 0.01 to 1

  std::string file() const { return "objects/" + kind + ".xml"; }  // in the folder of models
};

struct WorldSpec {
  std::string models_dir = "models";
  std::string room = "room";
  std::string vehicle = "qav_rxl";
  std::vector<ObjectSpec> objects;
  VehicleOverrides vehicle_overrides = {};

  std::string room_file() const { return "rooms/" + room + ".xml"; }
  std::string vehicle_file() const { return "vehicles/" + vehicle + ".xml"; }
  std::string path(const std::string& file) const { return models_dir + "/" + file; }
};

// Conventions of the model files. Contact bits: room geoms have contype 1 and conaffinity 6, the
// vehicle's hull 2 and 5, thrown objects 4 and 7; what is for the eye only has 0 and 0.
// Geom groups: 0 room, 1 thrown objects, 3 vehicle as people see it, 4 vehicle hull (never drawn).
// World puts what moves and is in MuJoCo's default group, 0, into 1.
inline constexpr int kRoomGroup = 0;
inline constexpr int kObjectGroup = 1;
inline constexpr int kVehicleGroup = 3;
inline constexpr int kFirstHiddenGroup = 3;  // from the cameras, and in MuJoCo's default view

// Prefix of the names of object i in the composed model: "object3/".
std::string object_prefix(int i);

// Names in the result: room and vehicle as in their files, objects with object_prefix().
// The files of textures and meshes are read anew only for another room, vehicle or size of objects.
// Throws ScenarioError with one sentence that names the file.
MjModelPtr compose_model(const WorldSpec& spec);

}  // namespace dodgesim

// Whether a vehicle could have got out of an object's way: what its rotors allow, whatever its
// pilot and controller make of it.
//
// The vehicle hovers, and from a command on follows a manoeuvre as fast as rotors with a
// first-order lag can turn and lift it: it tilts with the torque of full thrust on one side and
// none on the other, stops there at once, and meanwhile all rotors go to full thrust, to half of it
// or to none. No vehicle has both at a time, nor stops at once: what does not get out of the way by
// any of some 300 such manoeuvres hardly does at all.
#pragma once

#include <Eigen/Dense>
#include <optional>
#include <vector>

#include "sim/base/time.h"
#include "sim/motors/motors.h"
#include "sim/world/convex.h"
#include "sim/world/snapshot.h"
#include "sim/world/vehicle_parameters.h"

namespace dodgesim {

// What the rotors of a hovering vehicle allow.
struct Agility {
  double max_thrust_mps2 = 0;           // of all rotors together, per mass
  double tilt_acceleration_radps2 = 0;  // greatest about the faster of the roll and pitch axes
  double lag_s = 0;                     // time constant of the rotors' thrust
  double delay_s = 0;                   // before it begins to change
};

Agility agility_of(const VehicleParameters& vehicle, const MotorSpec& motors);

struct Manoeuvre {
  double azimuth_rad = 0;   // about z_W from x_W: towards which the vehicle tilts
  double tilt_rad = 0;      // how far
  double thrust_share = 1;  // of the greatest thrust; with 0 it drops
};

// Where a manoeuvre has brought the vehicle, seen from a vehicle that hovers on.
class ManoeuvrePath {
 public:
  ManoeuvrePath(const Agility& agility, const Manoeuvre& manoeuvre, double duration_s);

  // t_s after the command, at most duration_s: the displacement in W and the turn about the
  // vehicle's centre, in axes parallel to W.
  Eigen::Isometry3d at(double t_s) const;

 private:
  double tilt_rad(double t_s) const;

  Agility agility_;
  Manoeuvre manoeuvre_;
  std::vector<Eigen::Vector3d> p_W_;  // two milliseconds apart
};

// How object and vehicle meet if the vehicle does not evade: their first contact.
struct Encounter {
  TimeUs contact_us = 0;
  BodyState vehicle, object;        // then
  std::vector<Convex> hull, shape;  // of the vehicle and of the object, each in its frame

  Eigen::Vector3d velocity_W() const { return object.v_W - vehicle.v_W; }  // of the object
  // The part of a vector across that velocity: what lies along it only shifts the contact in time.
  Eigen::Vector3d across_flight(const Eigen::Vector3d& v_W) const;
};

// Whether the object passes without contact if the vehicle is displaced by this from its place at
// the time of the contact, and moves on at this velocity, both against a vehicle that hovers on.
bool passes(const Encounter& encounter, const Eigen::Vector3d& displacement_W,
            const Eigen::Vector3d& velocity_W = Eigen::Vector3d::Zero());

// Least time before the contact at which a manoeuvre must be commanded for the object to pass
// without contact, to within a millisecond; empty if none commanded kLongestEscapeS before it would
// do. (A longer time than one that does is taken to do, too.) With `towards_W`, of the manoeuvres
// that accelerate it within 30 degrees of it in the end, both taken across the object's flight.
inline constexpr double kLongestEscapeS = 1;
std::optional<double> least_time_to_escape_s(
    const Agility& agility, const Encounter& encounter,
    const std::optional<Eigen::Vector3d>& towards_W = std::nullopt);

}  // namespace dodgesim

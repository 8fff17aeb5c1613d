#include "sim/outcome/agility.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "sim/base/gravity.h"

namespace dodgesim {

namespace {

using Eigen::Isometry3d;
using Eigen::Vector3d;

constexpr double kPathStepS = 2e-3;
constexpr double kPrecisionS = 1e-3;
constexpr double kRadPerDeg = std::numbers::pi / 180;

// The manoeuvres that are tried, besides those without a tilt.
constexpr int kAzimuths = 16;
constexpr double kTiltsDeg[] = {20, 45, 70, 90, 120, 150};
constexpr double kThrustShares[] = {1, 0.5, 0};

constexpr double kTowardsDeg = 30;

// Surfaces nearer than this touch.
constexpr double kTouchingM = 1e-4;
// The object flies on for as long as the gap, of at most kFarM, lasts if everything on the vehicle
// moves at this speed against it, and for no less than this.
constexpr double kFarM = 1;
constexpr double kVehicleMps = 15;
constexpr double kLeastStepS = 5e-4;

// How long before and after the contact without evasion another contact may come.
double around_contact_s(const Encounter& encounter) {
  const double reach_m = radius_m(encounter.hull) + radius_m(encounter.shape);
  return std::min(2 * reach_m / encounter.velocity_W().norm(), kLongestEscapeS);
}

// The object t_s after the contact without evasion, seen from a vehicle that hovers on.
Isometry3d object_at(const Encounter& encounter, double t_s) {
  const BodyState& object = encounter.object;
  Isometry3d X_WO = object.pose();
  X_WO.translation() += t_s * encounter.velocity_W();
  X_WO.translation().z() -= 0.5 * kGravityMps2 * t_s * t_s;
  const double turn = object.w_W.norm();
  if (turn > 0) X_WO.linear() = Eigen::AngleAxisd(turn * t_s, object.w_W / turn) * X_WO.linear();
  return X_WO;
}

// Whether the object passes a vehicle of which moved(t_s) says how far it is from its place.
template <class Moved>
bool passes_moved(const Encounter& encounter, double from_s, const Moved& moved) {
  const double to_s = around_contact_s(encounter);
  const double object_mps = encounter.velocity_W().norm() + kGravityMps2 * to_s +
                            encounter.object.w_W.norm() * radius_m(encounter.shape);
  for (double t_s = from_s; t_s < to_s;) {
    const Isometry3d shift = moved(t_s);
    Isometry3d X_WB = encounter.vehicle.pose();
    X_WB.linear() = shift.linear() * X_WB.linear();
    X_WB.translation() += shift.translation();
    const Isometry3d X_BO = X_WB.inverse() * object_at(encounter, t_s);
    const double gap_m = convex_gap_m(encounter.hull, encounter.shape, X_BO, kFarM);
    if (gap_m < kTouchingM) return false;
    t_s += std::max(gap_m / (object_mps + kVehicleMps), kLeastStepS);
  }
  return true;
}

// Whether the object passes a vehicle on the path, commanded left_s before the contact.
bool passes_path(const Encounter& encounter, const ManoeuvrePath& path, double left_s) {
  return passes_moved(encounter, -std::min(left_s, around_contact_s(encounter)),
                      [&](double t_s) { return path.at(left_s + t_s); });
}

Vector3d level(const Manoeuvre& manoeuvre) {
  return {std::cos(manoeuvre.azimuth_rad), std::sin(manoeuvre.azimuth_rad), 0};
}

// The acceleration by a thrust under a tilt.
Vector3d acceleration_mps2(const Manoeuvre& manoeuvre, double thrust_mps2, double tilt_rad) {
  return thrust_mps2 * std::sin(tilt_rad) * level(manoeuvre) +
         (thrust_mps2 * std::cos(tilt_rad) - kGravityMps2) * Vector3d::UnitZ();
}

double last_thrust_mps2(const Agility& agility, const Manoeuvre& manoeuvre) {
  return manoeuvre.thrust_share * agility.max_thrust_mps2;
}

// Whether a manoeuvre leads towards a direction, both taken across the object's flight.
bool leads(const Agility& agility, const Manoeuvre& manoeuvre, const Vector3d& towards_W,
           const Encounter& encounter) {
  const Vector3d a_W =
      acceleration_mps2(manoeuvre, last_thrust_mps2(agility, manoeuvre), manoeuvre.tilt_rad);
  const Vector3d a = encounter.across_flight(a_W), towards = encounter.across_flight(towards_W);
  if (towards.norm() <= 1e-6 * towards_W.norm()) return false;
  return a.dot(towards) > std::cos(kTowardsDeg * kRadPerDeg) * a.norm() * towards.norm();
}

// The least time that serves, to within kPrecisionS: `high_s` does, and what is longer than one
// that serves is taken to serve, too.
template <class Predicate>
double turning_point(const Predicate& serves, double high_s) {
  for (double low_s = 0; high_s - low_s > kPrecisionS;) {
    const double middle_s = 0.5 * (low_s + high_s);
    (serves(middle_s) ? high_s : low_s) = middle_s;
  }
  return high_s;
}

std::vector<Manoeuvre> make_manoeuvres() {
  std::vector<Manoeuvre> all;
  for (const double thrust_share : kThrustShares) {
    all.push_back({0, 0, thrust_share});
    for (const double tilt_deg : kTiltsDeg) {
      for (int i = 0; i < kAzimuths; ++i) {
        all.push_back({2 * std::numbers::pi * i / kAzimuths, tilt_deg * kRadPerDeg, thrust_share});
      }
    }
  }
  return all;
}

}  // namespace

Agility agility_of(const VehicleParameters& vehicle, const MotorSpec& motors) {
  Agility agility;
  agility.max_thrust_mps2 = 4 * vehicle.max_thrust_n / vehicle.mass_kg;
  // Full thrust on one side, none on the other.
  double roll_nm = 0, pitch_nm = 0;
  for (const Vector3d& p_B : vehicle.rotor_p_B) {
    roll_nm += 0.5 * vehicle.max_thrust_n * std::abs(p_B.y());
    pitch_nm += 0.5 * vehicle.max_thrust_n * std::abs(p_B.x());
  }
  agility.tilt_acceleration_radps2 =
      std::max(roll_nm / vehicle.inertia_kgm2.x(), pitch_nm / vehicle.inertia_kgm2.y());
  agility.lag_s = std::min(motors.time_constant_up_s, motors.time_constant_down_s);
  agility.delay_s = 1e-6 * motors.esc_delay_us;
  return agility;
}

ManoeuvrePath::ManoeuvrePath(const Agility& agility, const Manoeuvre& manoeuvre, double duration_s)
    : agility_(agility), manoeuvre_(manoeuvre), p_W_{Vector3d::Zero()} {
  const double more_mps2 = last_thrust_mps2(agility, manoeuvre) - kGravityMps2;
  Vector3d v_W = Vector3d::Zero();
  while (kPathStepS * static_cast<double>(p_W_.size() - 1) < duration_s) {
    const double t_s = kPathStepS * (static_cast<double>(p_W_.size()) - 0.5);  // mid-step
    const double risen = -std::expm1(-std::max(0.0, t_s - agility.delay_s) / agility.lag_s);
    const Vector3d a_W =
        acceleration_mps2(manoeuvre, kGravityMps2 + risen * more_mps2, tilt_rad(t_s));
    p_W_.push_back(p_W_.back() + kPathStepS * (v_W + 0.5 * kPathStepS * a_W));
    v_W += kPathStepS * a_W;
  }
}

// The torque rises with the rotors' lag.
double ManoeuvrePath::tilt_rad(double t_s) const {
  const double x = std::max(0.0, t_s - agility_.delay_s) / agility_.lag_s;
  const double turned = agility_.tilt_acceleration_radps2 * agility_.lag_s * agility_.lag_s *
                        (0.5 * x * x - x - std::expm1(-x));
  return std::min(turned, manoeuvre_.tilt_rad);
}

Isometry3d ManoeuvrePath::at(double t_s) const {
  const double last = static_cast<double>(p_W_.size() - 1);
  const double step = std::clamp(t_s / kPathStepS, 0.0, last);
  const auto i = static_cast<std::size_t>(step);
  const std::size_t next = std::min(i + 1, p_W_.size() - 1);
  Isometry3d moved = Isometry3d::Identity();
  moved.translation() = p_W_[i] + (step - std::floor(step)) * (p_W_[next] - p_W_[i]);
  // z_W turns towards the azimuth.
  const Vector3d axis(-std::sin(manoeuvre_.azimuth_rad), std::cos(manoeuvre_.azimuth_rad), 0);
  moved.linear() = Eigen::AngleAxisd(tilt_rad(t_s), axis).toRotationMatrix();
  return moved;
}

Vector3d Encounter::across_flight(const Vector3d& v_W) const {
  const Vector3d flight = velocity_W().normalized();
  return v_W - v_W.dot(flight) * flight;
}

bool passes(const Encounter& encounter, const Vector3d& displacement_W,
            const Vector3d& velocity_W) {
  return passes_moved(encounter, -around_contact_s(encounter), [&](double t_s) {
    Isometry3d shift = Isometry3d::Identity();
    shift.translation() = displacement_W + t_s * velocity_W;
    return shift;
  });
}

std::optional<double> least_time_to_escape_s(const Agility& agility, const Encounter& encounter,
                                             const std::optional<Vector3d>& towards_W) {
  static const std::vector<Manoeuvre> manoeuvres = make_manoeuvres();
  double least_s = kLongestEscapeS + kPrecisionS;
  bool any = false;
  for (const Manoeuvre& manoeuvre : manoeuvres) {
    if (towards_W && !leads(agility, manoeuvre, *towards_W, encounter)) continue;
    const ManoeuvrePath path(agility, manoeuvre, least_s + around_contact_s(encounter));
    const auto serves = [&](double left_s) { return passes_path(encounter, path, left_s); };
    // Only what serves later than the best so far.
    if (!serves(least_s - kPrecisionS)) continue;
    least_s = turning_point(serves, least_s - kPrecisionS);
    any = true;
  }
  return any ? std::optional(least_s) : std::nullopt;
}

}  // namespace dodgesim

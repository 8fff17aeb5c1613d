#include "dodge/avoid/repulsive_field.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace dodge {
namespace {

// Shorter than this a vector has no direction.
constexpr double kNoDirection = 1e-9;

// Of a unit vector so little is left across an obstacle's path if it is along the path.
constexpr double kAlongThePath = 0.05;

Eigen::Vector3d without_component_along(const Eigen::Vector3d& v, const Eigen::Vector3d& unit) {
  return v - v.dot(unit) * unit;
}

}  // namespace

double decay_lifetime_s(const RepulsiveConfig& config) {
  return std::max(0.0, std::log(config.k_r0 / config.k_tau) / config.lambda_decay_1ps);
}

RepulsiveField::RepulsiveField(const RepulsiveConfig& config)
    : config_(config),
      khosla_(config.field == "khosla"),
      cross_(config.direction == "cross"),
      gradient_(config.direction == "gradient"),
      steep_sine_(std::sin(config.steep_deg * std::numbers::pi / 180)) {}

double RepulsiveField::k_r(double since_detection_s) const {
  return config_.k_r0 * std::exp(-config_.lambda_decay_1ps * std::max(0.0, since_detection_s));
}

double RepulsiveField::magnitude(double eta_m, double k_r) const {
  const double eta_0 = config_.eta_0_m, gamma = config_.gamma;
  const double eta = std::max(0.0, eta_m);
  if (eta >= eta_0) return 0;
  if (khosla_) return k_r * gamma / eta_0 * std::pow((eta_0 - eta) / eta_0, gamma - 1);
  // (1 - e^(gamma eta)) / (1 - e^(gamma eta_0)), written so that no exponent is positive.
  const double ratio =
      std::exp(gamma * (eta - eta_0)) * std::expm1(-gamma * eta) / std::expm1(-gamma * eta_0);
  return k_r * (1 - ratio);
}

Eigen::Vector3d RepulsiveField::direction(const Eigen::Vector3d& grad_eta_W,
                                          const Eigen::Vector3d& v_W,
                                          const Eigen::Vector3d& heading_W) const {
  if (gradient_) return grad_eta_W;
  const double speed = v_W.norm();
  if (speed < kNoDirection) return Eigen::Vector3d::UnitZ();
  const Eigen::Vector3d along = v_W / speed;
  const Eigen::Vector3d theta =
      cross_ ? grad_eta_W.cross(along).eval() : without_component_along(grad_eta_W, along);
  const double sine = theta.norm();  // of the angle between gradient and velocity, either way
  const double least = std::max(config_.head_on_sine, kNoDirection);
  if (sine >= least) {
    const Eigen::Vector3d theta_n = without_component_along(theta / sine, heading_W);  // (30)
    if (theta_n.norm() >= least) return theta_n.normalized();
  }
  return head_on_escape(along, heading_W);
}

Eigen::Vector3d RepulsiveField::head_on_escape(const Eigen::Vector3d& along,
                                               const Eigen::Vector3d& heading_W) const {
  const auto across = [&](const Eigen::Vector3d& wanted) -> Eigen::Vector3d {
    return without_component_along(without_component_along(wanted, along), heading_W);
  };
  const Eigen::Vector3d up = Eigen::Vector3d::UnitZ();
  if (std::abs(along.z()) >= std::min(steep_sine_, 1 - kNoDirection)) {
    const Eigen::Vector3d sideways = across(up.cross(heading_W));
    // To the right if the way to the left goes down: |F_z| would turn it against the obstacle.
    if (sideways.norm() >= kAlongThePath)
      return sideways.normalized() * (sideways.z() < 0 ? -1 : 1);
  }
  return across(up).normalized();
}

Eigen::Vector3d RepulsiveField::force(const VehicleMotion& vehicle, const Ellipsoid& obstacle,
                                      const Eigen::Vector3d& v_obstacle_W,
                                      double since_detection_s) const {
  const SurfaceDistance surface = distance_to_surface(obstacle, vehicle.p_W);
  const double eta = surface.distance_m - config_.quadrotor_radius_m;
  if (eta >= config_.eta_0_m) return Eigen::Vector3d::Zero();
  const double speed_factor = config_.scale_by_speed ? v_obstacle_W.norm() : 1.0;
  Eigen::Vector3d force = speed_factor * magnitude(eta, k_r(since_detection_s)) *
                          direction(surface.gradient_W, v_obstacle_W, vehicle.heading_W);
  if (config_.upward) force.z() = std::abs(force.z());
  return force;
}

}  // namespace dodge

#include "sim/control/flight_controller.h"

#include <cmath>
#include <stdexcept>
#include <string>

namespace dodgesim {

FlightController::FlightController(const FlightControllerSpec& spec,
                                   const VehicleParameters& vehicle, const MotorSpec& motors)
    : spec_(spec),
      mixer_(vehicle, motors.min_thrust_n, vehicle.max_thrust_n, spec.assured_yaw_torque_nm),
      mass_kg_(vehicle.mass_kg),
      inertia_kgm2_(vehicle.inertia_kgm2),
      gyro_stays_(spec.gyro_filter_s > 0 ? std::exp(-seconds(kTickUs) / spec.gyro_filter_s) : 0),
      torque_stays_(std::exp(-seconds(spec.period_us) / spec.motor_time_constant_s)) {
  if (spec.period_us <= 0 || spec.period_us % kTickUs != 0) {
    throw std::invalid_argument("The flight controller's period_us must be a multiple of " +
                                std::to_string(kTickUs) + ".");
  }
}

void FlightController::reset(const std::array<double, 4>& rotor_thrust_n) {
  w_B_radps_.setZero();
  rotor_thrust_n_ = rotor_thrust_n;
  commanded_torque_nm_ = torque_nm_ = mixer_.wrench(rotor_thrust_n).torque_nm;
}

const std::array<double, 4>& FlightController::step(TimeUs t_us, const RateThrustCommand& command,
                                                    const Eigen::Vector3d& gyro_B_radps) {
  w_B_radps_ = gyro_B_radps + gyro_stays_ * (w_B_radps_ - gyro_B_radps);
  if (t_us % spec_.period_us != 0) return rotor_thrust_n_;

  torque_nm_ = commanded_torque_nm_ + torque_stays_ * (torque_nm_ - commanded_torque_nm_);
  const Eigen::Vector3d rate_gain_1ps(spec_.rate_gain_xy_1ps, spec_.rate_gain_xy_1ps,
                                      spec_.rate_gain_z_1ps);
  const Eigen::Vector3d torque_gain(spec_.torque_gain_xy, spec_.torque_gain_xy,
                                    spec_.torque_gain_z);
  const Eigen::Vector3d gyroscopic_nm = w_B_radps_.cross(inertia_kgm2_.cwiseProduct(w_B_radps_));
  const Eigen::Vector3d angular_acceleration =
      rate_gain_1ps.cwiseProduct(command.w_B_radps - w_B_radps_);
  Wrench wanted;
  wanted.thrust_n = mass_kg_ * command.thrust_mps2;
  wanted.torque_nm = inertia_kgm2_.cwiseProduct(angular_acceleration) +
                     torque_gain.cwiseProduct(gyroscopic_nm - torque_nm_) + gyroscopic_nm;
  rotor_thrust_n_ = mixer_.rotor_thrusts(wanted);
  commanded_torque_nm_ = mixer_.wrench(rotor_thrust_n_).torque_nm;
  return rotor_thrust_n_;
}

}  // namespace dodgesim

// The flight controller: from collective thrust and body rates to rotor thrust commands.
#pragma once

#include <Eigen/Dense>
#include <array>

#include "sim/base/time.h"
#include "sim/control/mixer.h"
#include "sim/motors/motors.h"
#include "sim/world/vehicle_parameters.h"

namespace dodgesim {

// What the controller on the computer sends to the flight controller.
struct RateThrustCommand {
  Eigen::Vector3d w_B_radps = Eigen::Vector3d::Zero();  // desired body rates
  double thrust_mps2 = 0;                               // collective thrust per mass, along +z of B
};

struct FlightControllerSpec {
  int period_us = 250;
  double gyro_filter_s = 0.0036;
  double rate_gain_xy_1ps = 80;
  double rate_gain_z_1ps = 8;
  double torque_gain_xy = 1.5;
  double torque_gain_z = 0;
  double motor_time_constant_s = 0.04;
  double assured_yaw_torque_nm = 0.02;

  template <class Visitor>
  void visit(Visitor& v) {
    v("period_us", period_us, 250, 20000,
      "Time between two outputs of the rate loop (4 kHz); it must be a multiple of 250.");
    v("gyro_filter_s", gyro_filter_s, 0, 0.1,
      "First-order lag that stands for the gyroscope's filters: the 3.6 ms that those of "
      "Betaflight delay; 0 for none.");
    v("rate_gain_xy_1ps", rate_gain_xy_1ps, 0.1, 1000,
      "Angular acceleration per error of the roll and pitch rate; the P term of the platform's "
      "Betaflight amounts to 88 1/s on the nominal vehicle.");
    v("rate_gain_z_1ps", rate_gain_z_1ps, 0.1, 1000,
      "Angular acceleration per error of the yaw rate; damped 0.9 with the motors' lag.");
    v("torque_gain_xy", torque_gain_xy, 0, 100,
      "Feedback of the estimated roll and pitch torque, which speeds up the motors' lag and damps "
      "the loop to 0.7 (0.6 with the gyroscope's filter and the delays); Betaflight's D term "
      "amounts to 1.0.");
    v("torque_gain_z", torque_gain_z, 0, 100,
      "Feedback of the estimated yaw torque; none, as Betaflight has no D term on yaw.");
    v("motor_time_constant_s", motor_time_constant_s, 0.001, 1,
      "Lag of the motors in the controller's estimate of the torque.");
    v("assured_yaw_torque_nm", assured_yaw_torque_nm, 0, 1,
      "Yaw torque that saturation leaves to yaw: about a tenth of the greatest, and never more "
      "than half of it.");
  }
};

// Body-rate control of Faessler et al. 2017, which is state feedback on the body rates and on the
// torque that the lagging motors have reached:
//   tau = K_w J (w_des - w) + K_tau (tau_ref - tau_hat) + w x J w,   tau_ref = w x J w.
// Chosen over a PID because its response has a closed form, alpha s^2 + (1 + K_tau) s + K_w = 0 for
// motor lag alpha, in which the gains of the platform's Betaflight PID appear as K_w = 88 1/s and
// K_tau = 1 (its D term acts on the angular acceleration, that is on the torque).
class FlightController {
 public:
  // Throws std::invalid_argument when the vehicle's rotors cannot be mixed or when the period is no
  // multiple of the tick.
  FlightController(const FlightControllerSpec& spec, const VehicleParameters& vehicle,
                   const MotorSpec& motors);

  // Rotors turn steadily at these thrusts [N]; the vehicle is at rest.
  void reset(const std::array<double, 4>& rotor_thrust_n);

  // Call every tick with the gyroscope's value at t_us and the command that has arrived. Returns
  // the rotor thrust commands [N], new every period_us.
  const std::array<double, 4>& step(TimeUs t_us, const RateThrustCommand& command,
                                    const Eigen::Vector3d& gyro_B_radps);

 private:
  FlightControllerSpec spec_;
  Mixer mixer_;
  double mass_kg_;
  Eigen::Vector3d inertia_kgm2_;
  double gyro_stays_;    // share of the filter's state that is left after a tick
  double torque_stays_;  // share of the torque estimate that is left after a period
  Eigen::Vector3d w_B_radps_ = Eigen::Vector3d::Zero();  // filtered
  Eigen::Vector3d torque_nm_ = Eigen::Vector3d::Zero();  // estimated
  Eigen::Vector3d commanded_torque_nm_ = Eigen::Vector3d::Zero();
  std::array<double, 4> rotor_thrust_n_{};
};

}  // namespace dodgesim

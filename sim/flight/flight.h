// Everything that takes part in one throw flown by one pilot. sim/loop.cc says in which order it
// acts.
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "sim/base/wall_clock.h"
#include "sim/bridge/onboard_computer.h"
#include "sim/bridge/truth_pilot.h"
#include "sim/config/scenario.h"
#include "sim/control/flight_controller.h"
#include "sim/control/velocity_controller.h"
#include "sim/flight/detection_log.h"
#include "sim/flight/event_rig.h"
#include "sim/flight/flight_log.h"
#include "sim/flight/flight_observer.h"
#include "sim/flight/mission.h"
#include "sim/flight/plan.h"
#include "sim/motors/motors.h"
#include "sim/outcome/collision_cause.h"
#include "sim/sensors/imu.h"
#include "sim/sensors/range_sensor.h"
#include "sim/sensors/state_estimator.h"
#include "sim/world/referee.h"
#include "sim/world/world.h"

namespace dodgesim {

// Wall-clock time by stage [s], for reports only.
struct FlightTiming {
  double total_s = 0;
  double render_s = 0;
  double emulate_s = 0;
  double pilot_s = 0;
  std::int64_t keys = 0;      // pictures of the room that were drawn
  std::int64_t pictures = 0;  // whole pictures that were shown to the cameras
  std::int64_t regions = 0;   // pictures of an object's region only
};

// What a flight leaves behind.
struct FlightRecord {
  Verdict verdict;
  Snapshot last;
  FlightLog log;
  Agility agility;
  std::vector<Convex> hull;                 // of the vehicle, in B
  std::vector<std::vector<Convex>> shapes;  // of each object, in its frame
  DetectionLog detections;
  std::optional<TimeUs> first_command_us;  // first evasive command at the flight controller
  std::optional<TimeUs> landing_us;        // first command to land at the controller
  TimeUs command_delay_us = 0;             // from a command's output to the flight controller
  std::array<std::int64_t, 2> events{};
  std::array<std::int64_t, 2> events_lost{};  // by the saturated readout
  std::uint64_t events_hash = 0;
  FlightTiming timing;
};

class Flight {
 public:
  // The observer may be null. Throws ScenarioError (models) and SimulationError.
  Flight(const Scenario& scenario, const FlightPlan& plan, FlightObserver* observer);
  Flight(const Flight&) = delete;  // observer_ may be its own nobody_
  Flight& operator=(const Flight&) = delete;

  TimeUs now_us() const { return world_.snapshot().t_us; }
  // The end is reached, or the vehicle was hit, has crashed or has landed.
  bool over() const;

  // The stages of one tick, in this order.
  void move();     // rotors push, objects are launched, everything moves by one tick
  void sense();    // IMU, state estimate, range sensor
  void see();      // pictures, events, packets
  void decide();   // the pilot's cycle: a velocity command
  void control();  // velocity -> attitude and thrust -> body rates -> rotor commands
  void judge();    // the referee

  FlightRecord record() const;

 private:
  struct SentCommand {
    RateThrustCommand command;
    VelocityReference reference;  // what it is to bring about
  };

  std::uint64_t index() const;
  std::unique_ptr<dodge::Pilot> make_pilot();
  std::unique_ptr<dodge::Pilot> make_seeing_pilot() const;
  std::unique_ptr<EventRig> make_rig() const;
  int cameras() const;  // in use
  FlightLogger::Setup flight_logger_setup() const;
  void require_packet();
  double true_range_m() const;
  void note_cycle();  // of the pilot
  FlightTiming timing() const;

  Scenario scenario_;
  FlightPlan plan_;
  World world_;
  Referee referee_;
  Motors motors_;
  FlightController flight_controller_;
  VelocityController controller_;
  Imu imu_;
  Imu flight_controller_imu_;
  StateEstimator state_estimator_;
  RangeSensor range_sensor_;
  TruthPilot* truth_pilot_ = nullptr;  // owned by computer_, when the pilot knows the truth
  OnboardComputer computer_;
  FlightLogger flight_logger_;
  FlightObserver nobody_;  // looks on if no observer is given
  FlightObserver& observer_;
  std::unique_ptr<EventRig> rig_;  // none for pilots that need no eyes

  Snapshot before_;  // the tick's start
  Mission mission_;
  Eigen::Vector3d gyro_B_radps_ = Eigen::Vector3d::Zero();
  DelayLine<StateReading> controller_states_;
  DelayLine<SentCommand> rate_commands_;
  DetectionLogger detection_logger_;
  std::optional<StateReading> controller_state_;  // the last one
  VelocityReference reference_;
  bool evasion_arrived_ = false;  // and the controller has not acted since
  RateThrustCommand rate_command_;
  FlightRecord record_;
  double pilot_s_ = 0;
  WallClock::time_point constructed_ = WallClock::now();
};

}  // namespace dodgesim

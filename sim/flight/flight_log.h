// Keeps of a flight what is asked afterwards: when each object could be seen and was detected, the
// commands, and the course for the eye.
#pragma once

#include <limits>
#include <optional>
#include <vector>

#include "sim/camera/camera.h"
#include "sim/control/velocity_controller.h"
#include "sim/outcome/result.h"
#include "sim/outcome/trajectory.h"
#include "sim/world/world.h"

namespace dodgesim {

struct FlightLog {
  struct Object {
    std::optional<TimeUs> in_view_us;  // first
    bool in_view_near = false;         // at any time within Setup::near_m of that camera
    // Output of the pilot's first cycle that knew of it: that detected it or, of a pilot that is
    // told of objects, was told.
    std::optional<TimeUs> known_us;
    // Outputs of the detections that are of it, in order, with detected less true position.
    struct Detection {
      TimeUs output_us = 0;
      Eigen::Vector3d error_W = Eigen::Vector3d::Zero();
    };
    std::vector<Detection> detections;
  };
  // A command at the flight controller while an object is in flight.
  struct Command {
    TimeUs t_us = 0;
    bool evading = false;
    Eigen::Vector3d v_W = Eigen::Vector3d::Zero();
    Eigen::Vector3d vehicle_v_W = Eigen::Vector3d::Zero();
  };
  std::vector<Object> objects;
  std::vector<Command> commands;
  Trajectory trajectory;
};

class FlightLogger {
 public:
  struct Setup {
    Intrinsics intrinsics;
    int cameras = 2;  // the first of the vehicle's
    double near_m = std::numeric_limits<double>::infinity();
    TimeUs start_us = 0, end_us = 0;  // of the trajectory
  };

  FlightLogger(const World& world, const Setup& setup);

  // Call after each tick, with the velocity that the controller is asked for.
  void observe(const World& world, const VelocityReference& reference);
  // true_object: it is one of row.object.
  void add_detection(const DetectionRow& row, bool true_object);
  // Of a pilot that is told of objects: its cycle with this output knew of it.
  void add_told(int object, TimeUs output_us);
  // A command has reached the flight controller.
  void add_command(const Snapshot& now, const VelocityReference& reference);

  FlightLog log() const;

 private:
  // How far it is from a camera in whose image it is, and at least a pixel wide; empty if in none.
  // What stands between does not count.
  std::optional<double> distance_in_view_m(const World& world, std::size_t object) const;
  Trajectory::Sample sample(const Snapshot& now, const VelocityReference& reference) const;

  Setup setup_;
  FlightLog log_;
  std::optional<Trajectory::Sample> last_;  // of the last tick, unless it is in the trajectory
};

}  // namespace dodgesim

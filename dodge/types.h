// What the flight core is handed and what it returns. Frames: W world (z up), B body (x forward,
// y left, z up, origin at the centre of mass), C camera (x right, y down, z forward). Pixel (0,0)
// is the centre of the top-left pixel. Time is integer microseconds on one clock.
#pragma once

#include <Eigen/Dense>
#include <array>
#include <cstdint>

namespace dodge {

using TimeUs = std::int64_t;

inline constexpr double seconds(TimeUs t_us) { return 1e-6 * static_cast<double>(t_us); }

inline constexpr double kGravityMps2 = 9.81;  // along -z of W

// One brightness change. Streams of a camera are ordered by (t_us, y, x, polarity).
struct Event {
  TimeUs t_us = 0;
  std::uint16_t x = 0;       // column [px]
  std::uint16_t y = 0;       // row [px]
  std::int8_t polarity = 0;  // +1 brighter, -1 darker
};

struct ImuSample {
  TimeUs t_us = 0;
  Eigen::Vector3d w_WB_B = Eigen::Vector3d::Zero();  // angular velocity of B in B [rad/s]
  Eigen::Vector3d f_B = Eigen::Vector3d::Zero();     // specific force in B [m/s^2]
};

struct StateEstimate {
  TimeUs t_us = 0;                                           // the instant it describes
  Eigen::Vector3d p_WB = Eigen::Vector3d::Zero();            // [m]
  Eigen::Quaterniond q_WB = Eigen::Quaterniond::Identity();  // unit; takes vectors from B to W
  Eigen::Vector3d v_WB = Eigen::Vector3d::Zero();            // [m/s]
  Eigen::Vector3d w_WB_B = Eigen::Vector3d::Zero();          // angular velocity of B in B [rad/s]
};

struct RangeReading {
  TimeUs t_us = 0;
  double range_m = 0;  // along -z of B
};

// Where to go (or to stay, when already there).
struct Goal {
  Eigen::Vector3d p_WG = Eigen::Vector3d::Zero();  // [m]
  double speed_mps = 1.5;                          // cruise speed towards it
};

struct VelocityCommand {
  TimeUs t_us = 0;                                // the instant of the data it was computed from
  Eigen::Vector3d v_W = Eigen::Vector3d::Zero();  // desired velocity [m/s]
  bool evading = false;  // v_W evades an obstacle: to be followed at once, not smoothed
  bool landing = false;  // an emergency landing, to the ground and for good
};

// One obstacle measured in one update.
struct Detection {
  TimeUs t_us = 0;  // the instant p_W and centre_W describe
  // Four corners, near and far centre (eq. 12) [m].
  std::array<Eigen::Vector3d, 6> p_W = {Eigen::Vector3d::Zero(), Eigen::Vector3d::Zero(),
                                        Eigen::Vector3d::Zero(), Eigen::Vector3d::Zero(),
                                        Eigen::Vector3d::Zero(), Eigen::Vector3d::Zero()};
  Eigen::Vector3d centre_W = Eigen::Vector3d::Zero();  // [m]
  double depth_m = 0;                                  // along the camera's optical axis
  double depth_sigma_m = 0;                            // its standard deviation
  double distance_per_depth = 1;                       // |centre_W - camera| / depth_m
  double size_m = 0;     // longer side of the rotated rectangle at that depth (eq. 9)
  int obstacle_id = -1;  // the track it was associated with
};

// One tracked obstacle.
struct Obstacle {
  int id = 0;
  TimeUs t_us = 0;  // the instant p_WO and v_WO describe
  TimeUs last_detection_us = 0;
  int detections = 0;
  Eigen::Vector3d p_WO = Eigen::Vector3d::Zero();  // [m]
  Eigen::Vector3d v_WO = Eigen::Vector3d::Zero();  // [m/s]
  double size_m = 0;                               // as in the last detection
};

}  // namespace dodge

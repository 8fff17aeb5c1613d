// What a vehicle's other sensors said, as CSV files; t_us counts on the clock of the events.
//
// IMU    t_us,wx,wy,wz[,ax,ay,az]: angular velocity [rad/s], specific force [m/s^2]
// State  t_us,x,y,z,qw,qx,qy,qz,vx,vy,vz[,wx,wy,wz]: position [m] and velocity [m/s] in W, the
//        rotation from B to W, angular velocity in B [rad/s]
// Range  t_us,range_m: along -z of B
//
// Lines as in text_columns.h. Columns in any order, others are passed over; columns in brackets may
// be missing as a group: then forces are 0, and a state's angular velocity is between the means by
// which it turned since the last and until the next. The axes of an IMU's log are those of the
// sensor (see camera_calibration.h).
#pragma once

#include <string>
#include <vector>

#include "sim/sensors/readings.h"

namespace dodgesim {

// Throw IoError for a file that cannot be read, ScenarioError for a cell that is no number, if
// there is no row (but of ranges, as when the ground was out of reach) or time stands still; both
// in one sentence that names the file and the line.
std::vector<ImuReading> read_imu_log(const std::string& path);
std::vector<StateReading> read_state_log(const std::string& path);
std::vector<RangeReading> read_range_log(const std::string& path);

// The lines of such files: every number reads back as the same one.
std::string imu_header();
std::string state_header();
std::string range_header();
std::string log_line(const ImuReading& reading);
std::string log_line(const StateReading& reading);
std::string log_line(const RangeReading& reading);

}  // namespace dodgesim

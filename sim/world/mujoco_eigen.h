// MuJoCo's arrays as Eigen's types, in MuJoCo's order: a vector x y z, a quaternion w x y z.
#pragma once

#include <mujoco/mujoco.h>

#include <Eigen/Geometry>

namespace dodgesim {

using Map3 = Eigen::Map<Eigen::Vector3d>;
using ConstMap3 = Eigen::Map<const Eigen::Vector3d>;

inline Eigen::Quaterniond quaternion(const mjtNum* q) { return {q[0], q[1], q[2], q[3]}; }

inline void set_quaternion(mjtNum* to, const Eigen::Quaterniond& q) {
  to[0] = q.w();
  to[1] = q.x();
  to[2] = q.y();
  to[3] = q.z();
}

inline Eigen::Isometry3d pose(const mjtNum* p, const mjtNum* q) {
  Eigen::Isometry3d X = Eigen::Isometry3d::Identity();
  X.linear() = quaternion(q).toRotationMatrix();
  X.translation() = ConstMap3(p);
  return X;
}

// Of a rotation matrix, row by row.
inline Eigen::Isometry3d frame(const mjtNum* p, const mjtNum* R) {
  Eigen::Isometry3d X = Eigen::Isometry3d::Identity();
  X.linear() = Eigen::Map<const Eigen::Matrix<double, 3, 3, Eigen::RowMajor>>(R);
  X.translation() = ConstMap3(p);
  return X;
}

}  // namespace dodgesim

// Of matrices of any size, so that one solver is compiled for all: for each size it takes seconds.
#pragma once

#include <Eigen/Dense>

namespace dodge {

// A symmetric and positive semi-definite.
inline Eigen::MatrixXd solve(const Eigen::MatrixXd& A, const Eigen::MatrixXd& b) {
  return A.ldlt().solve(b);
}

}  // namespace dodge

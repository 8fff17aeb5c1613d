// Hands Eigen's values to the uniforms of the program in use.
#pragma once

#include <GL/gl.h>
#include <GL/glext.h>

#include <Eigen/Dense>

namespace dodgesim {

template <class Matrix>
void set_matrix(int location, const Matrix& matrix) {
  const Eigen::Matrix<float, Matrix::RowsAtCompileTime, Matrix::ColsAtCompileTime> m =
      matrix.template cast<float>();
  if constexpr (Matrix::RowsAtCompileTime == 4) {
    glUniformMatrix4fv(location, 1, GL_FALSE, m.data());
  } else {
    glUniformMatrix3fv(location, 1, GL_FALSE, m.data());
  }
}

inline void set_vector(int location, const Eigen::Vector3d& v) {
  glUniform3f(location, static_cast<float>(v.x()), static_cast<float>(v.y()),
              static_cast<float>(v.z()));
}

}  // namespace dodgesim

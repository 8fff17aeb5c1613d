// The axes x, y and z of a sensor, named by the directions of the body in which they point, such as
// "right down forward"; as a matrix, the columns are the axes in B.
#pragma once

#include <Eigen/Dense>
#include <array>
#include <optional>
#include <string>

namespace dodgesim {

// Nothing unless the words are three of forward, backward, left, right, up and down, along
// different axes of the body.
std::optional<Eigen::Matrix3d> axes_named(const std::string& words);

// Of such a matrix.
std::string names_of_axes(const Eigen::Matrix3d& axes);

// The 24 right-handed frames and then the 24 left-handed ones.
std::array<Eigen::Matrix3d, 48> all_axes();

}  // namespace dodgesim

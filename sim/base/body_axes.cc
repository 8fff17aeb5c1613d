#include "sim/base/body_axes.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <sstream>

namespace dodgesim {

namespace {

struct Direction {
  const char* name;
  Eigen::Vector3d in_B;
};

const std::array<Direction, 6>& directions() {
  static const std::array<Direction, 6> all = {{{"forward", {1, 0, 0}},
                                                {"backward", {-1, 0, 0}},
                                                {"left", {0, 1, 0}},
                                                {"right", {0, -1, 0}},
                                                {"up", {0, 0, 1}},
                                                {"down", {0, 0, -1}}}};
  return all;
}

bool is_frame(const Eigen::Matrix3d& axes) { return std::abs(axes.determinant()) > 0.5; }

}  // namespace

std::optional<Eigen::Matrix3d> axes_named(const std::string& words) {
  std::istringstream text(words);
  Eigen::Matrix3d axes;
  std::string word;
  for (int i = 0; i < 3; ++i) {
    text >> word;
    const auto found = std::ranges::find_if(
        directions(), [&](const Direction& direction) { return direction.name == word; });
    if (!text || found == directions().end()) return std::nullopt;
    axes.col(i) = found->in_B;
  }
  if (text >> word || !is_frame(axes)) return std::nullopt;
  return axes;
}

std::string names_of_axes(const Eigen::Matrix3d& axes) {
  std::string names;
  for (int i = 0; i < 3; ++i) {
    const auto nearest = std::ranges::max_element(
        directions(), {},
        [&](const Direction& direction) { return direction.in_B.dot(axes.col(i)); });
    names.append(i > 0 ? " " : "").append(nearest->name);
  }
  return names;
}

std::array<Eigen::Matrix3d, 48> all_axes() {
  std::array<Eigen::Matrix3d, 48> all;
  std::size_t right_handed = 0, left_handed = all.size() / 2;
  for (const Direction& x : directions()) {
    for (const Direction& y : directions()) {
      for (const Direction& z : directions()) {
        Eigen::Matrix3d axes;
        axes << x.in_B, y.in_B, z.in_B;
        if (is_frame(axes)) all[axes.determinant() > 0 ? right_handed++ : left_handed++] = axes;
      }
    }
  }
  return all;
}

}  // namespace dodgesim

#include "sim/render/tessellation.h"

#include <gtest/gtest.h>

#include <set>
#include <utility>
#include <vector>

namespace dodgesim {
namespace {

TEST(Tessellation, PartsOfNeighbouringFacesMeet) {
  Eigen::Isometry3d pose(Eigen::Translation3d(-3.1, 0.7, 2.9));
  pose.rotate(Eigen::AngleAxisd(0.7, Eigen::Vector3d(1, 2, 3).normalized()));
  std::vector<Vertex> vertices;
  append_box({3.3, 2.7, 0.4}, {}, pose, vertices);
  // Each side of a triangle is one of another.
  std::multiset<std::pair<std::vector<float>, std::vector<float>>> sides;
  const auto point = [&](std::size_t i) {
    const Eigen::Vector3f& p = vertices[i].position;
    return std::vector<float>{p.x(), p.y(), p.z()};
  };
  for (std::size_t i = 0; i < vertices.size(); i += 3) {
    for (std::size_t k = 0; k < 3; ++k) {
      auto a = point(i + k), b = point(i + (k + 1) % 3);
      if (b < a) std::swap(a, b);
      sides.insert({a, b});
    }
  }
  for (const auto& side : sides) EXPECT_EQ(sides.count(side), 2u);
  EXPECT_EQ(vertices.size(), 2u * 3u * 2u * (7 * 6 + 7 + 6));
}

}  // namespace
}  // namespace dodgesim

// What is claimed in the files of models/objects.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "sim/base/random.h"
#include "sim/world/convex.h"
#include "tests/sim/world/test_world.h"

namespace dodgesim {
namespace {

using Eigen::Vector3d;

std::vector<std::string> object_names() {
  std::vector<std::string> names;
  for (const auto& entry :
       std::filesystem::directory_iterator(std::string(DODGESIM_SOURCE_DIR) + "/models/objects")) {
    names.push_back(entry.path().stem());
  }
  return names;
}

std::vector<Convex> surface(const World& world) {
  std::vector<Convex> parts;
  const int body = world.object_body(0), first = world.model().body_geomadr[body];
  for (int geom = first; geom < first + world.model().body_geomnum[body]; ++geom) {
    parts.push_back(Convex::from_geom(world.model(), geom, "test"));
  }
  return parts;
}

class ObjectModel : public ::testing::TestWithParam<std::string> {};
INSTANTIATE_TEST_SUITE_P(Models, ObjectModel, ::testing::ValuesIn(object_names()),
                         [](const auto& info) { return info.param; });

// From end to end along an axis of its body (and a box along its longest edge), or from tip to tip
// across a quadrotor.
TEST_P(ObjectModel, IsAsLongAsItsSize) {
  constexpr double kSizeM = 0.24;
  const World world(test_spec({{GetParam(), kSizeM}}));
  const std::vector<Convex> parts = surface(world);
  double longest_m = 0;
  for (const Vector3d& direction :
       {Vector3d(1, 0, 0), Vector3d(0, 1, 0), Vector3d(0, 0, 1), Vector3d(1, 1, 0)}) {
    if (GetParam() == "box" && direction.sum() > 1) continue;
    const Vector3d d = direction.normalized();
    longest_m = std::max(longest_m, reach_m(parts, d) + reach_m(parts, -d));
  }
  EXPECT_NEAR(longest_m, kSizeM, 0.01 * kSizeM);
}

// A solid of the union of its parts, filled evenly, has its centre near the origin of its body, and
// no more inertia than all its mass at its outermost point would have.
TEST_P(ObjectModel, HasItsMassWhereItsPartsAre) {
  const World world(test_spec({{GetParam(), 0.3}}));
  const std::vector<Convex> parts = surface(world);
  RandomStream random(1, 0, "object");
  Vector3d sum = Vector3d::Zero(), squares = Vector3d::Zero();
  int inside = 0;
  for (int i = 0; i < 200000 && inside < 2000; ++i) {
    Vector3d p;
    for (int k = 0; k < 3; ++k) p[k] = random.uniform(-0.16, 0.16);
    Eigen::Isometry3d X = Eigen::Isometry3d::Identity();
    X.translation() = p;
    const Convex point = Convex::sphere(Vector3d::Zero(), 0);
    const bool in = std::any_of(parts.begin(), parts.end(), [&](const Convex& part) {
      return (p - part.centre()).norm() <= part.extent_m() && convex_gap_m(part, point, X) <= 1e-7;
    });
    if (!in) continue;
    sum += p;
    squares += p.cwiseProduct(p);
    ++inside;
  }
  ASSERT_GT(inside, 100);
  EXPECT_LT((sum / inside).norm(), 0.03 * 0.3 + 0.1 / std::sqrt(inside));
  const int body = world.object_body(0);
  const double mass_kg = world.model().body_mass[body];
  const Vector3d J = Eigen::Map<const Vector3d>(world.model().body_inertia + 3 * body);
  EXPECT_GT(J.minCoeff(), 0);
  EXPECT_LT(J.maxCoeff(), mass_kg * 0.15 * 0.15);
  // Axes that are much apart in a solid of that shape are in that order.
  const Vector3d solid = (Vector3d::Constant(squares.sum()) - squares) / inside;
  for (int a = 0; a < 3; ++a) {
    for (int b = 0; b < 3; ++b) {
      if (solid[a] <= 1.3 * solid[b]) continue;
      EXPECT_GT(J[a], J[b]);
    }
  }
  EXPECT_LE(J.maxCoeff(), J.sum() - J.maxCoeff() + 1e-9) << "no mass distribution has this inertia";
}

}  // namespace
}  // namespace dodgesim

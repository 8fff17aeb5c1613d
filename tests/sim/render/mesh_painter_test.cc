// Thrown meshes, against brute force and closed forms.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <string>

#include "tests/sim/render/coverage.h"

namespace dodgesim {
namespace {

using Eigen::Vector3d;

// The convex hull of the vertices "x y z  x y z ..." [m].
Scene white_mesh(const std::string& vertices) {
  return Scene(std::string(kWhiteLight) + "<asset><mesh name='mesh' vertex='" + vertices +
                   "'/></asset><worldbody>" +
                   thrown(0, "<geom type='mesh' mesh='mesh' rgba='1 1 1 1'/>") + "</worldbody>",
               black_sky());
}

// Whether the ray meets a triangle.
bool meets(const Vector3d& ray, const std::array<Vector3d, 3>& corners) {
  const auto& [a, b, c] = corners;
  const double u = ray.dot(a.cross(b)), v = ray.dot(b.cross(c)), w = ray.dot(c.cross(a));
  return (u >= 0 && v >= 0 && w >= 0) || (u <= 0 && v <= 0 && w <= 0);
}

// Across the border of two tiles, too (x = 128).
TEST(MeshPainter, CoversWhatBruteForceSays) {
  Scene scene = white_mesh("0 0 0  .1 0 0  0 .15 0  0 0 .2");
  BodyState& state = scene.snapshot().objects[0];
  state.p_W = {1, 0.15, 0.05};
  state.q_W = Eigen::Quaterniond(0.5, 0.3, -0.7, 0.4).normalized();
  const Eigen::Isometry3d X_WC = forward_camera(), X_CG = X_WC.inverse() * state.pose();
  std::array<Vector3d, 4> corners = {Vector3d(0, 0, 0), Vector3d(0.1, 0, 0), Vector3d(0, 0.15, 0),
                                     Vector3d(0, 0, 0.2)};
  for (Vector3d& corner : corners) corner = X_CG * corner;
  const auto hits = [&](const Vector3d& ray) {
    for (std::size_t out = 0; out < 4; ++out) {
      if (meets(ray, {corners[(out + 1) % 4], corners[(out + 2) % 4], corners[(out + 3) % 4]}))
        return true;
    }
    return false;
  };
  expect_coverage(scene.render(X_WC), hits, 0.16, 0.04);
  expect_coverage(scene.draw_objects(X_WC, scene.full(), false), hits, 0.16, 0.04);
}

// An edge that jumped from one row of samples to the next would fire its events in bursts.
TEST(MeshPainter, FollowsEdgesAlongTheImagesAxes) {
  Scene scene = white_mesh("0 .2 .2  0 .2 -.2  0 -.2 .2  0 -.2 -.2  .01 0 0");  // a plate
  const Intrinsics& camera = scene.camera();
  Vector3d& p_W = scene.snapshot().objects[0].p_W;
  for (int axis : {1, 2}) {  // left, up
    const double center_px = axis == 1 ? camera.cx() : camera.cy();
    for (double moved_px = -1; moved_px < 1; moved_px += 0.03) {
      p_W = {1, 0, 0};
      p_W[axis] = moved_px / camera.f;
      const double edge_px = center_px - 0.2 * camera.f - moved_px;
      const int edge = static_cast<int>(edge_px);
      const Image image =
          scene.render(forward_camera(), axis == 1 ? Rect{edge - 3, 120, edge + 5, 121}
                                                   : Rect{160, edge - 3, 161, edge + 5});
      for (int i = edge - 3; i < edge + 5; ++i) {
        const double seen = axis == 1 ? image.at(i, 120) : image.at(160, i);
        EXPECT_NEAR(seen, std::clamp(i + 0.5 - edge_px, 0.0, 1.0), 0.035) << i << ", " << moved_px;
      }
    }
  }
}

}  // namespace
}  // namespace dodgesim

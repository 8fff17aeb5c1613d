// Where outlines lie: against closed forms and against brute force on the CPU.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "tests/sim/render/coverage.h"

namespace dodgesim {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr double kTolerancePx = 0.1;

// x of the left and right end of a sphere's outline in image row y, in closed form.
bool sphere_row(const Intrinsics& camera, const Vector3d& c, double r, double y, double& left,
                double& right) {
  // Rays d = (X, Y, 1) with (d.c)^2 = d.d (c.c - r^2), a quadratic in X.
  const double Y = (y - camera.cy()) / camera.f, k = c.squaredNorm() - r * r;
  const double m = c.y() * Y + c.z();
  const double A = c.x() * c.x() - k, B = 2 * c.x() * m, C = m * m - k * (Y * Y + 1);
  const double discriminant = B * B - 4 * A * C;
  if (discriminant < 0) return false;
  const double x1 = (-B + std::sqrt(discriminant)) / (2 * A);
  const double x2 = (-B - std::sqrt(discriminant)) / (2 * A);
  left = camera.f * std::min(x1, x2) + camera.cx();
  right = camera.f * std::max(x1, x2) + camera.cx();
  return true;
}

class SphereOutline : public ::testing::TestWithParam<Vector3d> {};

TEST_P(SphereOutline, IsTheEllipseOfTheClosedFormInEveryRow) {
  const double radius = 0.1;
  Scene scene = white_object("<geom type='sphere' size='0.1' rgba='1 1 1 1'/>");
  const Vector3d p_C = GetParam();
  const Eigen::Isometry3d X_WC = forward_camera();
  scene.snapshot().objects[0].p_W = X_WC * p_C;
  const Image image = scene.render(X_WC);
  int rows = 0;
  for (int y = 0; y < image.camera.height; ++y) {
    double width_mean = 0, center_mean = 0;
    const int n = 64;
    bool whole = true;
    for (int i = 0; i < n && whole; ++i) {
      double left, right;
      whole = sphere_row(image.camera, p_C, radius, y + (i + 0.5) / n - 0.5, left, right) &&
              left > 0 && right < image.camera.width - 1;
      width_mean += (right - left) / n;
      center_mean += (right - left) * (right + left) / 2 / n;
    }
    if (!whole) continue;
    double width = 0, moment = 0;
    for (int x = 0; x < image.camera.width; ++x) {
      width += image.at(x, y);
      moment += image.at(x, y) * x;
    }
    EXPECT_NEAR(width, width_mean, kTolerancePx / 2) << "row " << y;
    EXPECT_NEAR(moment / width, center_mean / width_mean, kTolerancePx / 2) << "row " << y;
    ++rows;
  }
  EXPECT_GT(rows, 2);
}

INSTANTIATE_TEST_SUITE_P(Positions, SphereOutline,
                         ::testing::Values(Vector3d(0, 0, 1), Vector3d(0.003, -0.002, 3),
                                           Vector3d(-0.75, -0.55, 1.05), Vector3d(0.7, -0.5, 1),
                                           Vector3d(-0.7, 0.5, 1), Vector3d(1.4, 1.05, 2),
                                           Vector3d(0.2, 0.1, 6)));

TEST(Coverage, OfASmallSphereIsItsAreaInEveryPixel) {
  for (const double z : {1.0, 4.0, 8.0}) {
    Scene scene = white_object("<geom type='sphere' size='0.05' rgba='1 1 1 1'/>");
    const Vector3d c(0.31 * z, -0.22 * z, z);
    scene.snapshot().objects[0].p_W = forward_camera() * c;
    const Image image = scene.render(forward_camera());
    expect_coverage(
        image,
        [&](const Vector3d& d) {
          return d.cross(c).squaredNorm() <= 0.05 * 0.05 * d.squaredNorm();
        },
        0.03, 0.006);
  }
}

TEST(Coverage, OfATurnedEllipsoidMatchesBruteForce) {
  const Vector3d size(0.3, 0.1, 0.2);
  Scene scene = white_object("<geom type='ellipsoid' size='.3 .1 .2' rgba='1 1 1 1'/>");
  BodyState& state = scene.snapshot().objects[0];
  state.p_W = {1.2, 0.3, -0.2};
  state.q_W = Eigen::Quaterniond(0.5, 0.3, -0.7, 0.4).normalized();
  const Eigen::Isometry3d X_WC = forward_camera(), X_GC = state.pose().inverse() * X_WC;
  const Image image = scene.render(X_WC);
  expect_coverage(
      image,
      [&](const Vector3d& d) {
        const Vector3d e = X_GC.translation().cwiseQuotient(size);
        const Vector3d g = (X_GC.linear() * d).cwiseQuotient(size);
        return e.dot(g) * e.dot(g) >= g.squaredNorm() * (e.squaredNorm() - 1);
      },
      0.03, 0.006);
}

// Whether a line through `eye` along g comes within r of the axis segment of half length h: the
// distance is convex along the axis, so its minimum on the segment is the clamped one.
bool hits_capsule(const Vector3d& eye, const Vector3d& g, double r, double h) {
  const Vector3d u = g.normalized(), across = Vector3d::UnitZ() - u.z() * u;
  const double z = std::clamp(across.dot(eye) / across.squaredNorm(), -h, h);
  return (Vector3d(0, 0, z) - eye).cross(u).norm() <= r;
}

TEST(Coverage, OfATurnedCapsuleMatchesBruteForce) {
  Scene scene = white_object("<geom type='capsule' size='.05 .12' rgba='1 1 1 1'/>");
  BodyState& state = scene.snapshot().objects[0];
  state.p_W = {1.5, 0.2, 0.1};
  state.q_W = Eigen::Quaterniond(0.9, 0.3, -0.2, 0.5).normalized();
  const Eigen::Isometry3d X_WC = forward_camera(), X_GC = state.pose().inverse() * X_WC;
  expect_coverage(
      scene.render(X_WC),
      [&](const Vector3d& d) {
        return hits_capsule(X_GC.translation(), X_GC.linear() * d, 0.05, 0.12);
      },
      0.05, 0.01);
}

TEST(Coverage, OfATurnedCylinderMatchesBruteForce) {
  const double r = 0.08, h = 0.1;
  Scene scene = white_object("<geom type='cylinder' size='.08 .1' rgba='1 1 1 1'/>");
  BodyState& state = scene.snapshot().objects[0];
  state.p_W = {1.1, -0.2, 0.15};
  state.q_W = Eigen::Quaterniond(0.9, 0.5, -0.4, 0.1).normalized();
  const Eigen::Isometry3d X_WC = forward_camera(), X_GC = state.pose().inverse() * X_WC;
  expect_coverage(
      scene.render(X_WC),
      [&](const Vector3d& d) {
        const Vector3d e = X_GC.translation(), g = X_GC.linear() * d;
        const double a = g.head<2>().squaredNorm(), b = e.head<2>().dot(g.head<2>());
        const double root = b * b - a * (e.head<2>().squaredNorm() - r * r);
        if (root < 0) return false;
        const double z1 = (-h - e.z()) / g.z(), z2 = (h - e.z()) / g.z();
        return std::max((-b - std::sqrt(root)) / a, std::min(z1, z2)) <=
               std::min((-b + std::sqrt(root)) / a, std::max(z1, z2));
      },
      0.05, 0.01);
}

// Convex hull of points, counter-clockwise in image coordinates (gift wrapping).
std::vector<Vector2d> hull(std::vector<Vector2d> points) {
  const auto cross = [](const Vector2d& a, const Vector2d& b) {
    return a.x() * b.y() - a.y() * b.x();
  };
  std::vector<Vector2d> result;
  Vector2d at = points[0];
  for (const Vector2d& p : points) {
    if (p.x() < at.x()) at = p;
  }
  do {
    result.push_back(at);
    Vector2d next = points[0] == at ? points[1] : points[0];
    for (const Vector2d& p : points) {
      if (p != at && cross(next - at, p - at) < 0) next = p;
    }
    at = next;
  } while (at != result[0] && result.size() < points.size());
  return result;
}

// Line through an edge measured in the image (white inside): points where coverage sums place the
// crossing, one per row or column, fitted by least squares. Returns (n, c): n.x = c.
Vector3d measured_line(const Image& image, const Vector2d& a, const Vector2d& b,
                       const Vector2d& inside) {
  const bool by_row = std::abs(b.y() - a.y()) > std::abs(b.x() - a.x());
  const int along = by_row ? 1 : 0, across = 1 - along;
  const double slope = (b[across] - a[across]) / (b[along] - a[along]);
  const double low = std::min(a[along], b[along]) + 3, high = std::max(a[along], b[along]) - 3;
  const bool inside_is_after = inside[across] > a[across] + slope * (inside[along] - a[along]);
  Eigen::Matrix2d normal = Eigen::Matrix2d::Zero();
  Vector2d right = Vector2d::Zero();
  for (int i = static_cast<int>(std::ceil(low)); i <= high; ++i) {
    const int middle = static_cast<int>(std::lround(a[across] + slope * (i - a[along])));
    const int reach = 3;
    double sum = 0;
    for (int k = middle - reach; k <= middle + reach; ++k) {
      sum += by_row ? image.at(k, i) : image.at(i, k);
    }
    const double crossing =
        inside_is_after ? middle + reach + 0.5 - sum : middle - reach - 0.5 + sum;
    normal += (Eigen::Matrix2d() << i * i, i, i, 1).finished();
    right += Vector2d(i * crossing, crossing);
  }
  const Vector2d fit = normal.inverse() * right;  // across = fit.x along + fit.y
  Vector3d line;
  line[across] = 1;
  line[along] = -fit.x();
  line[2] = fit.y();
  return line;
}

void expect_corners(const Image& image, const Vector3d& half, const Eigen::Isometry3d& X_CG) {
  std::vector<Vector2d> corners;
  for (int i = 0; i < 8; ++i) {
    const Vector3d sign(i & 1 ? 1 : -1, i & 2 ? 1 : -1, i & 4 ? 1 : -1);
    corners.push_back(image.camera.project(X_CG * sign.cwiseProduct(half)));
  }
  const std::vector<Vector2d> outline = hull(corners);
  Vector2d middle = Vector2d::Zero();
  for (const Vector2d& p : outline) middle += p / static_cast<double>(outline.size());
  std::vector<Vector3d> lines;
  for (std::size_t i = 0; i < outline.size(); ++i) {
    lines.push_back(measured_line(image, outline[i], outline[(i + 1) % outline.size()], middle));
  }
  for (std::size_t i = 0; i < outline.size(); ++i) {
    const Vector3d& p = lines[(i + outline.size() - 1) % outline.size()];
    const Vector3d& q = lines[i];
    Eigen::Matrix2d A;
    A << p.x(), p.y(), q.x(), q.y();
    const Vector2d corner = A.inverse() * Vector2d(p.z(), q.z());
    EXPECT_LT((corner - outline[i]).norm(), kTolerancePx) << outline[i].transpose();
  }
}

TEST(BoxOutline, OfAThrownBoxHasItsCornersWhereTheyProject) {
  Scene scene = white_object("<geom type='box' size='.2 .15 .1' rgba='1 1 1 1'/>");
  BodyState& state = scene.snapshot().objects[0];
  const Eigen::Isometry3d X_WC = forward_camera();
  for (const Vector3d& p :
       {Vector3d(1, 0, 0), Vector3d(1.1, 0.4, -0.3), Vector3d(1.2, -0.3, 0.2)}) {
    state.p_W = p;
    state.q_W = Eigen::Quaterniond(0.8, 0.4, 0.3, 0.3).normalized();
    expect_corners(scene.render(X_WC), {0.2, 0.15, 0.1}, X_WC.inverse() * state.pose());
  }
}

TEST(BoxOutline, OfAStaticBoxHasItsCornersWhereTheyProject) {
  Scene scene(std::string(kWhiteLight) +
                  "<worldbody><geom type='box' size='.2 .15 .1' pos='1.1 .3 -.2' quat='.8 .4 .3 "
                  ".3' rgba='1 1 1 1'/></worldbody>",
              black_sky());
  const Eigen::Isometry3d X_WC = forward_camera();
  Eigen::Isometry3d X_WG = Eigen::Isometry3d::Identity();
  X_WG.translation() = Vector3d(1.1, 0.3, -0.2);
  X_WG.linear() = Eigen::Quaterniond(0.8, 0.4, 0.3, 0.3).normalized().toRotationMatrix();
  expect_corners(scene.render(X_WC), {0.2, 0.15, 0.1}, X_WC.inverse() * X_WG);
}

TEST(BoxOutline, FollowsACameraWithYawPitchAndRoll) {
  Scene scene = white_object("<geom type='box' size='.2 .15 .1' rgba='1 1 1 1'/>");
  BodyState& state = scene.snapshot().objects[0];
  state.p_W = {3, 2, 1};
  Eigen::Isometry3d X_WC = forward_camera({1.9, 1.8, 1.2});
  X_WC.linear() = Eigen::AngleAxisd(0.2, Vector3d::UnitZ()).toRotationMatrix() *
                  Eigen::AngleAxisd(0.15, Vector3d::UnitY()).toRotationMatrix() *
                  Eigen::AngleAxisd(0.9, Vector3d::UnitX()).toRotationMatrix() * X_WC.linear();
  expect_corners(scene.render(X_WC), {0.2, 0.15, 0.1}, X_WC.inverse() * state.pose());
}

TEST(Outline, MovesSmoothlyWithTheObject) {
  // One pixel in 40 steps. Analytic outlines change a pixel evenly; where 64 rays are counted, an
  // edge in the worst direction passes 8 of them at once.
  const struct {
    const char* geom;
    double largest_step;
  } cases[] = {{"<geom type='sphere' size='.1' rgba='1 1 1 1'/>", 0.04},
               {"<geom type='box' size='.1 .1 .1' rgba='1 1 1 1'/>", 0.04},
               {"<geom type='cylinder' size='.1 .1' rgba='1 1 1 1'/>", 0.13},
               {"<geom type='capsule' size='.1 .1' rgba='1 1 1 1'/>", 0.13}};
  for (const auto& object : cases) {
    Scene scene = white_object(object.geom);
    const int steps = 40;
    Image before(scene.camera());
    double largest = 0;
    for (int i = 0; i <= steps; ++i) {
      scene.snapshot().objects[0].p_W = {2, 0.1 - 2.0 / scene.camera().f * i / steps, 0.05};
      const Image now = scene.render(forward_camera());
      for (std::size_t k = 0; i > 0 && k < now.luminance.size(); ++k) {
        largest = std::max<double>(largest, std::abs(now.luminance[k] - before.luminance[k]));
      }
      before = now;
    }
    EXPECT_LT(largest, object.largest_step) << object.geom;
    EXPECT_GT(largest, 0.9 / steps) << object.geom;
  }
}

TEST(Outline, OfTheStaticSceneMovesSmoothlyWithTheCamera) {
  const std::string scene_text =
      std::string(kWhiteLight) +
      "<worldbody><geom type='box' size='.1 .3 .3' pos='2 0 0' euler='5 10 15' rgba='1 1 1 1'/>"
      "<geom type='plane' size='3 3 .1' pos='3 0 0' zaxis='-1 0 0' rgba='.4 .4 .4 1'/>"
      "<geom type='cylinder' size='.2 .4' pos='2 .8 0' rgba='.9 .9 .9 1'/></worldbody>";
  Scene scene(scene_text, black_sky());
  const int steps = 40;
  Image before(scene.camera());
  int changes = 0, jumps = 0;
  for (int i = 0; i <= steps; ++i) {
    const Vector3d p_W(0, 0.05 + 2.0 / scene.camera().f * i / steps, 0);
    const Image now = scene.render(forward_camera(p_W));
    for (std::size_t k = 0; i > 0 && k < now.luminance.size(); ++k) {
      const double change = std::abs(now.luminance[k] - before.luminance[k]);
      changes += change > 1e-4;
      jumps += change > 0.1;
    }
    before = now;
  }
  // One sample a pixel would jump by 0.5 and more, and nothing between. Corners, where two edges
  // share a pixel, still jump.
  EXPECT_GT(changes, 10000);
  EXPECT_LT(jumps, changes / 200);
}

}  // namespace
}  // namespace dodgesim

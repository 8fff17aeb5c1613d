#include "sim/render/triangle_choice.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace dodgesim {

namespace {

// Texels per pixel from which on the next level has a part: the level is their logarithm to base 2.
constexpr float kTrilinearFinest = 1, kNearestFinest = std::numbers::sqrt2_v<float>;
// OpenGL takes the step between neighbouring pixels for the derivative, and a logarithm that is not
// exact.
constexpr float kSurely = 0.95f;

// Of texels along the plane of a triangle with the sides a and b, over which they change by ta and
// tb.
Eigen::Matrix<float, 2, 3> gradient(const Eigen::Vector3f& a, const Eigen::Vector3f& b,
                                    const Eigen::Vector2f& ta, const Eigen::Vector2f& tb) {
  Eigen::Matrix<float, 3, 2> sides;
  sides << a, b;
  Eigen::Matrix2f texels;
  texels << ta, tb;
  return texels * (sides.transpose() * sides).inverse() * sides.transpose();
}

}  // namespace

TriangleChooser::TriangleChooser(const TriangleBatch& batch, const LuminanceTexture* texture,
                                 bool trilinear)
    : batch_(batch),
      flat_texture_(texture != nullptr && !texture->cube),
      finest_below_(kSurely * (trilinear ? kTrilinearFinest : kNearestFinest)) {
  for (std::size_t i = 0; i < batch.vertices.size(); i += 3) {
    const Vertex* const v = &batch.vertices[i];
    const Eigen::Vector3f a = v[1].position - v[0].position, b = v[2].position - v[0].position;
    Plane plane;
    plane.normal = a.cross(b).normalized();
    if (plane.normal.dot(v[0].normal + v[1].normal + v[2].normal) < 0) plane.normal *= -1;
    plane.offset = plane.normal.dot(v[0].position);
    if (texture != nullptr && !texture->cube) {
      const auto texels = [&](const Vertex& to) -> Eigen::Vector2f {
        const Eigen::Array2f size(texture->width, texture->height);
        return (to.texture - v[0].texture).head<2>().array() * size;
      };
      plane.texels_per_m = gradient(a, b, texels(v[1]), texels(v[2]));
    }
    planes_.push_back(plane);
  }
}

// The most texels that a step on the image at the distance 1 crosses, anywhere in the triangle.
// With e an axis of the image, c the camera and h its height above the plane with the normal n, a
// point p of the depth z moves by z / h (h e + (n . e) (p - c)); both factors are greatest at
// corners.
float TriangleChooser::texels_per_step(std::size_t triangle, const Eigen::Vector3f& camera_W,
                                       const Eigen::Matrix3f& R_WC) const {
  const Plane& plane = planes_[triangle];
  const float height_m = plane.normal.dot(camera_W) - plane.offset;
  float depth_m = 0, most = 0;
  for (std::size_t k = 3 * triangle; k < 3 * triangle + 3; ++k) {
    const Eigen::Vector3f to = batch_.vertices[k].position - camera_W;
    depth_m = std::max(depth_m, to.dot(R_WC.col(2)));
    for (const int axis : {0, 1}) {
      const Eigen::Vector3f e = R_WC.col(axis);
      const Eigen::Vector3f step = height_m * e + plane.normal.dot(e) * to;
      most = std::max(most, (plane.texels_per_m * step).norm());
    }
  }
  return depth_m * most / std::abs(height_m);
}

void TriangleChooser::choose(const Shot& shot, TriangleChoice& choice) const {
  choice.finest.clear();
  choice.mipmapped.clear();
  const Eigen::Vector3f camera_W = shot.X_WC.translation().cast<float>();
  const Eigen::Matrix3f R_WC = shot.X_WC.linear().cast<float>();
  const auto px = static_cast<float>(std::exp2(shot.lod_bias) / shot.intrinsics.f);
  for (std::size_t i = 0; i < planes_.size(); ++i) {
    if (batch_.solid && planes_[i].normal.dot(camera_W) <= planes_[i].offset) continue;
    const bool finest = flat_texture_ && px * texels_per_step(i, camera_W, R_WC) < finest_below_;
    std::vector<std::uint32_t>& chosen = finest ? choice.finest : choice.mipmapped;
    for (std::size_t k = 3 * i; k < 3 * i + 3; ++k) {
      chosen.push_back(static_cast<std::uint32_t>(k));
    }
  }
}

}  // namespace dodgesim

// Which triangles a view of the static scene needs, and how it has to read their texture: through
// mip-maps llvmpipe takes far longer (results/bench/tried.md) than at the finest level, which is
// all that counts of what is near.
#pragma once

#include <Eigen/Dense>
#include <cstdint>
#include <vector>

#include "sim/render/scene_geometry.h"
#include "sim/render/shot.h"

namespace dodgesim {

// Numbers of vertices, three for each triangle.
struct TriangleChoice {
  std::vector<std::uint32_t> finest;     // the finest level is enough
  std::vector<std::uint32_t> mipmapped;  // all others
};

class TriangleChooser {
 public:
  // `texture` is null for a plain batch; `trilinear`: between levels, or from the nearest one. The
  // batch must outlive the chooser.
  TriangleChooser(const TriangleBatch& batch, const LuminanceTexture* texture, bool trilinear);

  // Leaves out the far sides of solids.
  void choose(const Shot& shot, TriangleChoice& choice) const;

 private:
  using Gradient = Eigen::Matrix<float, 2, 3>;
  struct Plane {
    Eigen::Vector3f normal;  // outwards
    float offset;            // normal . p
    Gradient texels_per_m;   // along the plane
  };

  float texels_per_step(std::size_t triangle, const Eigen::Vector3f& camera_W,
                        const Eigen::Matrix3f& R_WC) const;

  const TriangleBatch& batch_;
  bool flat_texture_;
  float finest_below_;         // [texels per px]
  std::vector<Plane> planes_;  // of the triangles
};

}  // namespace dodgesim

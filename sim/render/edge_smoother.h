// Smooths the edges of an image of the static scene after it was drawn with one sample a pixel: a
// pixel that an edge crosses gets the luminance of its neighbour beyond the edge for the part of
// its area that lies there. Exact where both sides are even in luminance and at least a pixel wide.
#pragma once

#include <Eigen/Dense>
#include <vector>

#include "sim/camera/camera.h"
#include "sim/render/gl_scene.h"
#include "sim/render/static_edges.h"

namespace dodgesim {

class EdgeSmoother {
 public:
  // Makes OpenGL objects in the current context, with programs of that context.
  EdgeSmoother(const std::vector<Edge>& edges, ProgramCache& programs, const Intrinsics& intrinsics,
               const DepthRange& depth);

  // The luminance and depth of `target` hold the static scene in `region`, and its framebuffer
  // without ids is bound. Pixels at the region's border lack neighbours: draw 2 pixels more than is
  // needed. Leaves another framebuffer bound.
  void draw(const Eigen::Isometry3d& X_WC, const Rect& region, const GlTarget& target);

 private:
  bool touches(Eigen::Vector3d a, Eigen::Vector3d b, const Rect& region) const;

  std::vector<Edge> all_edges_;
  Intrinsics intrinsics_;
  double near_m_;
  GlProgram program_;
  VertexBuffer buffer_;
  std::vector<EdgeInstance> seen_;  // in the image being drawn
};

}  // namespace dodgesim

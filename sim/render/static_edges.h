// The straight edges at which the luminance of a static scene can jump: borders and creases of flat
// faces, and the lines where faces cut through each other. Made once, so that the renderer can
// smooth exactly these.
#pragma once

#include <Eigen/Dense>
#include <array>
#include <vector>

namespace dodgesim {

using Quad = std::array<Eigen::Vector3d, 4>;  // corners of a flat convex face, in W, in order

struct Edge {
  enum class Kind {
    kBorder,  // of a single face, or where two cut through each other: always of interest
    kCrease,  // between two faces of a solid: hidden if both face away
    kSmooth,  // between two faces of a round surface: of interest only as part of its outline
  };
  Eigen::Vector3d a, b;  // ends, in W
  Kind kind = Kind::kBorder;
  std::array<Eigen::Vector3d, 2> normals = {};  // outward, of the adjacent faces (not of a border)
  double bulge_m = 0.0;  // how much nearer than the edge a round surface may be a pixel beside it

  // Whether the edge can be seen as one from there.
  bool shows_from(const Eigen::Vector3d& eye_W) const;
  // Whether it is a crease of which both faces can be seen from there.
  bool inside_outline(const Eigen::Vector3d& eye_W) const;
};

// `creases` of boxes, borders of `rectangles`, and the segments in which any two of the flat
// `faces` intersect; an edge that lies on another one is left out.
std::vector<Edge> find_edges(const std::vector<Quad>& faces, const std::vector<Quad>& rectangles,
                             const std::vector<Edge>& creases);

}  // namespace dodgesim

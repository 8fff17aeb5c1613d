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
  Eigen::Vector3d a, b;  // ends, in W
};

// Borders of the quads, segments in which two quads intersect, and `extra` edges; an edge that lies
// on another one is left out.
std::vector<Edge> find_edges(const std::vector<Quad>& quads, const std::vector<Edge>& extra);

}  // namespace dodgesim

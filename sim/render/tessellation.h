// Triangles of the flat-faced shapes of MuJoCo.
#pragma once

#include <mujoco/mujoco.h>

#include <Eigen/Dense>
#include <vector>

#include "sim/render/scene_geometry.h"

namespace dodgesim {

// Each appends triangles of a shape of half extents `size` [m], transformed by `pose`.
void append_box(const Eigen::Vector3d& size, const Surface& surface, const Eigen::Isometry3d& pose,
                std::vector<Vertex>& out);
// The six faces.
void append_box_faces(const Eigen::Vector3d& size, const Eigen::Isometry3d& pose,
                      std::vector<Quad>& out);
// In the plane z = 0, normal +z.
void append_rectangle(const Eigen::Vector3d& size, const Surface& surface,
                      const Eigen::Isometry3d& pose, std::vector<Vertex>& out);
// Smooth normals except at creases, as in MuJoCo's pictures; texture coordinates of the mesh file
// where it has some.
void append_mesh(const mjModel& model, int mesh, const Surface& surface,
                 const Eigen::Isometry3d& pose, std::vector<Vertex>& out);

// Twelve creases.
void append_box_edges(const Eigen::Vector3d& size, const Eigen::Isometry3d& pose,
                      std::vector<Edge>& out);
// With so many sides that its outline is off by less than half a millimetre.
void append_cylinder(const Eigen::Vector3d& size, const Surface& surface,
                     const Eigen::Isometry3d& pose, std::vector<Vertex>& out,
                     std::vector<Edge>& edges);
Quad rectangle(const Eigen::Vector3d& size, const Eigen::Isometry3d& pose);
// Borders, creases, and the edges between faces that are shaded smoothly.
void append_mesh_edges(const mjModel& model, int mesh, const Eigen::Isometry3d& pose,
                       std::vector<Edge>& out);

}  // namespace dodgesim

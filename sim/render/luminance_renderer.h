// Draws what an event camera sees: linear luminance in floating point, from a MuJoCo model. What is
// made of triangles is drawn with own shaders on OSMesa, spheres, ellipsoids, capsules and all
// thrown solids but meshes are ray-cast on the processor (primitive_painter.h). Photometry:
// scene_geometry.h. Geometry: exactly Intrinsics (camera.h).
//
// Edges. At outlines a pixel's luminance is the mean over its square aperture, so that an edge that
// moves slowly changes it smoothly: analytically for ray-cast ellipsoids and the sides of cylinders
// and capsules, by 64 rays a pixel for their ends and for thrown boxes, by 17 samples a pixel for
// thrown meshes (mesh_painter.h), and by edge_smoother.h for what is static and made of triangles
// (planes, boxes, cylinders, meshes). Not smoothed: the horizon and borders of an unbounded plane
// and where something cuts into one, where a solid that is ray-cast, a cylinder or a mesh cuts into
// something, the outline of one in front of another whose centre is nearer, and that of what is
// static in front of a thrown object. Textures are read once a pixel (of thrown meshes once a
// sample), filtered as RenderSpec::texture_filter says.
#pragma once

#include <mujoco/mujoco.h>

#include <Eigen/Dense>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "sim/camera/camera.h"
#include "sim/render/spec.h"
#include "sim/world/snapshot.h"
#include "sim/world/world.h"

namespace dodgesim {

class LuminanceRenderer {
 public:
  // Body ids of the thrown objects in the order of Snapshot::objects. The model is only read here.
  // One renderer serves all cameras with these intrinsics, on one thread at a time. Throws
  // ScenarioError (a geom that cannot be drawn) and SimulationError (OpenGL).
  LuminanceRenderer(const mjModel& model, const std::vector<int>& object_bodies,
                    const Intrinsics& intrinsics, const RenderSpec& spec);
  LuminanceRenderer(const World& world, const Intrinsics& intrinsics, const RenderSpec& spec);
  ~LuminanceRenderer();

  // Both buffers: width x height, row-major from the top-left pixel; only the pixels of `region`
  // (clipped to the image) are written, with the values that a full frame has there, bit for bit.
  // luminance: linear, 1.0 = white under full light.
  // object_id (may be null): what is at the pixel's centre: -1 sky, 0 static, 1 + i thrown object
  // i. Objects that are not launched are not drawn.
  void render(const Snapshot& snapshot, const Eigen::Isometry3d& X_WC, const Rect& region,
              float* luminance, std::int32_t* object_id);

  // The static scene alone with any intrinsics, whole: both buffers are as large as that image.
  // inverse_depth: 1/z_C [1/m] of what is at the pixel's centre, 0 for the sky. `lod_bias` is added
  // to the level at which textures are read: 0, or -1 for a picture whose pixels are averaged
  // after.
  void render_static(const Intrinsics& intrinsics, const Eigen::Isometry3d& X_WC, double lod_bias,
                     float* luminance, float* inverse_depth);

  // Draws the objects that are launched over a picture of the static scene. In `region` (clipped to
  // the image) of the buffers, which are as large as the image, `luminance` is read and written,
  // and object_id (may be null) becomes 0 where no object is and 1 + i at object i. With
  // `behind_static`, what is static hides them; without, they are taken to be in front of it, which
  // is several times faster.
  void draw_objects(const Snapshot& snapshot, const Eigen::Isometry3d& X_WC, const Rect& region,
                    bool behind_static, float* luminance, std::int32_t* object_id);

 private:
  class Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace dodgesim

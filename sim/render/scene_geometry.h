// What a camera can see of a MuJoCo model, in the terms of the luminance renderer: triangles,
// primitives that are ray-cast, surfaces, textures and lights. Plain data, made once; no OpenGL.
//
// Photometry. Luminance is linear and relative: 1.0 is a white diffuse surface under full light (a
// light of intensity 1 at normal incidence). Colours (rgba) and intensities of lights are linear,
// as MuJoCo multiplies them; texels are linear too or, on request, sRGB code values. The sensor
// sees grey, with the weights of Rec. 709. Surfaces are Lambertian: specular, shininess and
// reflectance are ignored, there are no shadows, and nothing is transparent (alpha 0 is not drawn).
#pragma once

#include <mujoco/mujoco.h>

#include <Eigen/Dense>
#include <vector>

#include "sim/render/static_edges.h"

namespace dodgesim {

// Linear intensity of an sRGB code value in [0, 1] (IEC 61966-2-1).
double srgb_to_linear(double code);
// Grey value of linear red, green, blue (Rec. 709).
double luminance_of(const Eigen::Vector3d& linear_rgb);

// Texels of one texture under one tint, in linear luminance. Rows as MuJoCo stores them; a cube
// has its six faces one below the other, in OpenGL's order (+x, -x, +y, -y, +z, -z).
struct LuminanceTexture {
  int model_texture;     // id in mjModel
  Eigen::Vector3d tint;  // linear colour that multiplies the texels
  bool cube;
  int width, height;          // of one face when cube
  std::vector<float> texels;  // width * height * (cube ? 6 : 1)
};

// Texture coordinates are position in the geom's frame * scale + offset, component by component
// (x, y for a 2-D texture, a direction for a cube), as MuJoCo generates them.
struct Surface {
  int texture = -1;  // index in SceneGeometry::textures; -1: plain
  double albedo = 1.0;
  double emission = 0.0;  // luminance given off per unit of albedo
  Eigen::Vector3d texture_scale = Eigen::Vector3d::Zero();
  Eigen::Vector3d texture_offset = Eigen::Vector3d::Zero();
};

struct Vertex {
  Eigen::Vector3f position, normal, texture;
  float albedo, emission;
};
static_assert(sizeof(Vertex) == 11 * sizeof(float));

// A run of triangles with one texture.
struct TriangleBatch {
  int texture = -1;
  bool solid = false;  // they are the surfaces of closed bodies, which nobody sees from within
  std::vector<Vertex> vertices;
};

// Convex solid that the renderer ray-casts, with analytic or finely sampled coverage at its edges.
struct Primitive {
  mjtGeom type;          // sphere and ellipsoid: mjGEOM_ELLIPSOID; capsule, cylinder, box
  Eigen::Vector3d size;  // half axes, or radius, radius, half length (without caps)
  Surface surface;
  int object = -1;         // thrown object it belongs to, or -1: static
  Eigen::Isometry3d pose;  // geom in W if static, else in the object's frame
  double bounding_radius() const;
};

// Triangles of a thrown object, in the object's frame.
struct MovingTriangles {
  int object;
  TriangleBatch batch;
};

// Plane without borders, or a strip with borders across one axis alone; the renderer moves its
// tessellation along with the camera.
struct InfinitePlane {
  Eigen::Isometry3d pose;  // in W
  Eigen::Vector3d half_m;  // half extents along x and y; 0: without borders
  Surface surface;
};

struct Light {
  bool directional;
  Eigen::Vector3d position, direction;  // W; direction of the beam
  double ambient, diffuse;
  double cos_cutoff, exponent;  // spot as in OpenGL
  Eigen::Vector3d attenuation;  // 1, d, d^2
};

struct SceneGeometry {
  bool srgb_texels = false;
  std::vector<LuminanceTexture> textures;
  std::vector<TriangleBatch> static_triangles;  // in W
  std::vector<Edge> static_edges;               // of the static triangles
  std::vector<MovingTriangles> moving_triangles;
  std::vector<Primitive> primitives;
  std::vector<InfinitePlane> infinite_planes;
  std::vector<Light> lights;
  double ambient = 0.0;
  int sky_texture = -1;  // a cube texture, or -1
};

// Collects the geoms of the groups 0 to 2 that are fixed to the world or belong to a body in
// `object_bodies` (index = thrown object). Everything else that moves, such as the camera's own
// vehicle, is left out; so are lights' motions (they stay where they are at the model's start).
// Throws ScenarioError for a visible geom of a type that cannot be drawn (a height field).
SceneGeometry collect_scene(const mjModel& model, const std::vector<int>& object_bodies,
                            bool srgb_texels);

}  // namespace dodgesim

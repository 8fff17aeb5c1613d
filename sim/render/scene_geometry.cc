#include "sim/render/scene_geometry.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "sim/base/error.h"
#include "sim/base/mujoco.h"
#include "sim/render/tessellation.h"
#include "sim/world/compose.h"
#include "sim/world/geom_color.h"
#include "sim/world/mujoco_eigen.h"

namespace dodgesim {

namespace {

using Eigen::Vector3d;

Vector3d rgb_of(const float* rgb) { return {rgb[0], rgb[1], rgb[2]}; }

LuminanceTexture make_texture(const mjModel& m, int id, const Vector3d& tint, bool srgb) {
  LuminanceTexture texture;
  texture.model_texture = id;
  texture.tint = tint;
  texture.cube = m.tex_type[id] != mjTEXTURE_2D;
  texture.width = m.tex_width[id];
  texture.height = texture.cube ? m.tex_width[id] : m.tex_height[id];
  const int stored_faces = texture.cube ? m.tex_height[id] / m.tex_width[id] : 1;
  const int faces = texture.cube ? 6 : 1;
  double linear[256];
  for (int code = 0; code < 256; ++code)
    linear[code] = srgb ? srgb_to_linear(code / 255.0) : code / 255.0;
  const std::size_t face_texels =
      static_cast<std::size_t>(texture.width) * static_cast<std::size_t>(texture.height);
  texture.texels.reserve(face_texels * static_cast<std::size_t>(faces));
  for (int face = 0; face < faces; ++face) {
    // A cube stored as one square shows it on all faces.
    const std::size_t first = stored_faces == 6 ? static_cast<std::size_t>(face) * face_texels : 0;
    const mjtByte* rgb = m.tex_rgb + m.tex_adr[id] + 3 * first;
    for (std::size_t i = 0; i < face_texels; ++i, rgb += 3) {
      const Vector3d texel(linear[rgb[0]], linear[rgb[1]], linear[rgb[2]]);
      texture.texels.push_back(static_cast<float>(luminance_of(texel.cwiseProduct(tint))));
    }
  }
  return texture;
}

int find_or_add_texture(const mjModel& m, int id, const Vector3d& tint, SceneGeometry& scene) {
  for (std::size_t i = 0; i < scene.textures.size(); ++i) {
    const LuminanceTexture& texture = scene.textures[i];
    if (texture.model_texture == id && texture.tint == tint) return static_cast<int>(i);
  }
  scene.textures.push_back(make_texture(m, id, tint, scene.srgb_texels));
  return static_cast<int>(scene.textures.size()) - 1;
}

// MuJoCo's texture coordinates: on shapes scaled from unit size (`size`; meshes keep theirs, and
// under a cube planes, too).
void set_texture_mapping(const mjModel& m, int geom, const Vector3d& size, Surface& surface,
                         bool cube) {
  const int material = m.geom_matid[geom];
  const bool uniform = m.mat_texuniform[material] != 0;
  const bool keeps = m.geom_type[geom] == mjGEOM_MESH || m.geom_type[geom] == mjGEOM_PLANE;
  Vector3d scale = Vector3d::Ones();
  for (int axis = 0; axis < 3; ++axis) {
    if (size[axis] <= 0) continue;  // an unbounded axis of a plane repeats by length
    if (cube) {
      scale[axis] = keeps ? (uniform ? size[axis] : 1.0) : (uniform ? 1.0 : 1.0 / size[axis]);
    } else {
      scale[axis] = uniform ? 1.0 : 1.0 / size[axis];
    }
  }
  if (cube) {
    surface.texture_scale = scale;
    return;
  }
  const float* repeat = m.mat_texrepeat + 2 * material;
  surface.texture_scale = {0.5 * repeat[0] * scale.x(), -0.5 * repeat[1] * scale.y(), 0.0};
  surface.texture_offset = {-0.5, -0.5, 0.0};
}

// "geom 'floor'" or "geom number 3".
std::string name_of(const mjModel& m, int type, int id, const std::string& what) {
  const char* name = mj_id2name(&m, type, id);
  return what + (name ? " '" + std::string(name) + "'" : " number " + std::to_string(id));
}

// Luminance is not negative, and a number.
void expect_light(const std::string& of, std::initializer_list<double> values) {
  for (const double value : values) {
    if (value >= 0 && std::isfinite(value)) continue;
    throw ScenarioError("The " + of +
                        " has a colour, emission or attenuation below 0; no light is.");
  }
}

Surface make_surface(const mjModel& m, int geom, const Vector3d& size, SceneGeometry& scene) {
  Surface surface;
  const Vector3d color = rgb_of(geom_color(m, geom));
  const int material = m.geom_matid[geom];
  const int texture = material >= 0 ? m.mat_texid[material] : -1;
  if (material >= 0) surface.emission = m.mat_emission[material];
  expect_light(name_of(m, mjOBJ_GEOM, geom, "geom"),
               {color.x(), color.y(), color.z(), surface.emission});
  if (texture < 0) {
    surface.albedo = luminance_of(color);
    return surface;
  }
  surface.texture = find_or_add_texture(m, texture, color, scene);
  set_texture_mapping(m, geom, size, surface, m.tex_type[texture] != mjTEXTURE_2D);
  return surface;
}

// Half extents along the geom's axes; 0 where a plane is unbounded.
Vector3d extents(const mjModel& m, int geom) {
  const mjtNum* size = m.geom_size + 3 * geom;
  switch (m.geom_type[geom]) {
    case mjGEOM_SPHERE:
      return Vector3d::Constant(size[0]);
    case mjGEOM_CAPSULE:
    case mjGEOM_CYLINDER:
      return {size[0], size[0], size[1]};
    case mjGEOM_PLANE:
      return {size[0], size[1], 0.0};
    default:
      return {size[0], size[1], size[2]};
  }
}

// Triangles of solids or others.
std::vector<Vertex>& static_triangles(int texture, bool solid, SceneGeometry& scene) {
  for (TriangleBatch& batch : scene.static_triangles) {
    if (batch.texture == texture && batch.solid == solid) return batch.vertices;
  }
  scene.static_triangles.push_back({texture, solid, {}});
  return scene.static_triangles.back().vertices;
}

[[noreturn]] void reject(const mjModel& m, int geom) {
  throw ScenarioError("The " + name_of(m, mjOBJ_GEOM, geom, "geom") +
                      (m.geom_type[geom] == mjGEOM_HFIELD ? ", a height field," : "") +
                      " cannot be seen by an event camera: only planes of the room, boxes, "
                      "spheres, ellipsoids, capsules, cylinders and meshes can. Put it in group 4 "
                      "or 5 to hide it.");
}

// What static edges are found from.
struct StaticFaces {
  std::vector<Quad> faces, rectangles;  // rectangles are among the faces
  std::vector<Edge> box_creases;
};

// `pose`: geom in W (object -1) or in the object's frame.
void add_geom(const mjModel& m, int geom, int object, const Eigen::Isometry3d& pose,
              SceneGeometry& scene, StaticFaces& faces) {
  const Vector3d size = extents(m, geom);
  const Surface surface = make_surface(m, geom, size, scene);
  const auto type = static_cast<mjtGeom>(m.geom_type[geom]);
  switch (type) {
    case mjGEOM_SPHERE:
    case mjGEOM_ELLIPSOID:
      scene.primitives.push_back({mjGEOM_ELLIPSOID, size, surface, object, pose});
      return;
    case mjGEOM_CAPSULE:
      scene.primitives.push_back({type, size, surface, object, pose});
      return;
    case mjGEOM_CYLINDER:
      if (object >= 0) {
        scene.primitives.push_back({type, size, surface, object, pose});
      } else {
        append_cylinder(size, surface, pose, static_triangles(surface.texture, true, scene),
                        scene.static_edges);
      }
      return;
    case mjGEOM_BOX:
      if (object >= 0) {
        scene.primitives.push_back({type, size, surface, object, pose});
      } else {
        append_box(size, surface, pose, static_triangles(surface.texture, true, scene));
        append_box_faces(size, pose, faces.faces);
        append_box_edges(size, pose, faces.box_creases);
      }
      return;
    case mjGEOM_PLANE:
      if (size.x() > 0 && size.y() > 0) {
        append_rectangle(size, surface, pose, static_triangles(surface.texture, false, scene));
        faces.faces.push_back(rectangle(size, pose));
        faces.rectangles.push_back(faces.faces.back());
      } else {
        scene.infinite_planes.push_back({pose, size, surface});
      }
      return;
    case mjGEOM_MESH:
      if (object < 0) {
        append_mesh(m, m.geom_dataid[geom], surface, pose,
                    static_triangles(surface.texture, false, scene));
        append_mesh_edges(m, m.geom_dataid[geom], pose, scene.static_edges);
      } else {
        scene.moving_triangles.push_back({object, {surface.texture, false, {}}});
        append_mesh(m, m.geom_dataid[geom], surface, pose,
                    scene.moving_triangles.back().batch.vertices);
      }
      return;
    default:
      reject(m, geom);
  }
}

void add_lights(const mjModel& m, const mjData& d, SceneGeometry& scene) {
  for (int i = 0; i < m.nlight; ++i) {
    if (!m.light_active[i]) continue;
    Light light;
    light.directional = m.light_directional[i] != 0;
    light.position = Eigen::Map<const Vector3d>(d.light_xpos + 3 * i);
    light.direction = Eigen::Map<const Vector3d>(d.light_xdir + 3 * i).normalized();
    light.ambient = luminance_of(rgb_of(m.light_ambient + 3 * i));
    light.diffuse = luminance_of(rgb_of(m.light_diffuse + 3 * i));
    // 180 degrees means no cone.
    const double cutoff_deg = m.light_cutoff[i];
    light.cos_cutoff = cutoff_deg >= 180.0 ? -2.0 : std::cos(cutoff_deg * mjPI / 180.0);
    light.exponent = cutoff_deg >= 180.0 ? 0.0 : m.light_exponent[i];
    light.attenuation =
        Eigen::Map<const Eigen::Vector3f>(m.light_attenuation + 3 * i).cast<double>();
    const std::string name = name_of(m, mjOBJ_LIGHT, i, "light");
    expect_light(name, {light.ambient, light.diffuse, light.attenuation.x(), light.attenuation.y(),
                        light.attenuation.z()});
    if (!light.directional && light.attenuation.isZero()) {
      throw ScenarioError("The " + name + " has an attenuation of 0, and so shines without end.");
    }
    scene.lights.push_back(light);
  }
  // The head light would move with the camera: only its ambient part lights the scene.
  if (m.vis.headlight.active) {
    scene.ambient = luminance_of(rgb_of(m.vis.headlight.ambient));
    expect_light("headlight", {scene.ambient});
  } else if (scene.lights.empty()) {
    scene.ambient = 0.3;  // as OpenGL pictures of MuJoCo do without any light
  }
}

}  // namespace

double srgb_to_linear(double code) {
  return code <= 0.04045 ? code / 12.92 : std::pow((code + 0.055) / 1.055, 2.4);
}

double luminance_of(const Vector3d& linear_rgb) {
  return linear_rgb.dot(Vector3d(0.2126, 0.7152, 0.0722));
}

double Primitive::bounding_radius() const {
  switch (type) {
    case mjGEOM_ELLIPSOID:
      return size.maxCoeff();
    case mjGEOM_CAPSULE:
      return size.x() + size.z();
    case mjGEOM_CYLINDER:
      return std::hypot(size.x(), size.z());
    default:
      return size.norm();
  }
}

SceneGeometry collect_scene(const mjModel& model, const std::vector<int>& object_bodies,
                            bool srgb_texels) {
  SceneGeometry scene;
  scene.srgb_texels = srgb_texels;
  StaticFaces faces;
  const MjDataPtr data(mj_makeData(&model));
  mj_kinematics(&model, data.get());
  mj_comPos(&model, data.get());
  mj_camlight(&model, data.get());
  for (int geom = 0; geom < model.ngeom; ++geom) {
    if (!is_drawn(model, geom)) continue;
    const int root = model.body_weldid[model.geom_bodyid[geom]];
    int object = -1;
    for (std::size_t i = 0; i < object_bodies.size(); ++i) {
      if (model.body_weldid[object_bodies[i]] == root) object = static_cast<int>(i);
    }
    if (object < 0 && root != 0) continue;
    Eigen::Isometry3d pose = frame(data->geom_xpos + 3 * geom, data->geom_xmat + 9 * geom);
    if (object >= 0) {
      // The frame of a thrown object has its origin at the centre of mass (Snapshot).
      Eigen::Isometry3d X_WO = frame(data->xpos + 3 * root, data->xmat + 9 * root);
      X_WO.translation() = Eigen::Map<const Vector3d>(data->xipos + 3 * root);
      pose = X_WO.inverse() * pose;
    }
    add_geom(model, geom, object, pose, scene, faces);
  }
  // What stands before walls is drawn before them, so that less is drawn in vain.
  std::stable_partition(scene.static_triangles.begin(), scene.static_triangles.end(),
                        [](const TriangleBatch& batch) { return batch.solid; });
  const std::vector<Edge> flat = find_edges(faces.faces, faces.rectangles, faces.box_creases);
  scene.static_edges.insert(scene.static_edges.end(), flat.begin(), flat.end());
  add_lights(model, *data, scene);
  for (int i = 0; i < model.ntex; ++i) {
    if (model.tex_type[i] != mjTEXTURE_SKYBOX) continue;
    scene.sky_texture = find_or_add_texture(model, i, Vector3d::Ones(), scene);
    break;
  }
  return scene;
}

}  // namespace dodgesim

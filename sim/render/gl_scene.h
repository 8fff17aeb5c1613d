// The OpenGL objects of a scene: textures, vertex buffers, programs with their uniform locations.
// They belong to the context that was current when they were made, which must be current again when
// they are destroyed.
#pragma once

#include <Eigen/Dense>
#include <vector>

#include "sim/camera/camera.h"
#include "sim/render/depth_range.h"
#include "sim/render/gl_objects.h"
#include "sim/render/program_cache.h"
#include "sim/render/scene_geometry.h"
#include "sim/render/shaders.h"

namespace dodgesim {

// Of a ProgramCache: kept by it, and used by one renderer at a time.
struct GlProgram {
  unsigned name = 0;
  // Of the uniforms, of which a program has those that it needs.
  int lod_bias;
  int camera;                                // f, cx, cy [px]: all but triangles
  int clip_from_G, X_WG, texture_shift, id;  // triangles
  int R_WC;                                  // sky
  int X_CW, image;                           // edges; image: width, height [px]
};

// The textures of what OpenGL draws of a scene.
class SceneTextures {
 public:
  SceneTextures(const SceneGeometry& scene, bool trilinear);

  bool trilinear() const { return trilinear_; }
  // By index in the scene; -1 is none.
  TextureKind kind_of(int texture) const;
  // To be read through its mip-maps, or at its finest level only.
  void bind(int texture, bool finest_only = false) const;

 private:
  struct Texture {
    GlTexture texture;
    TextureKind kind;
  };
  std::vector<Texture> textures_;
  bool trilinear_;
};

struct VertexBuffer {
  GlVertexArray array;
  GlBuffer buffer;
  int count = 0;
};
VertexBuffer upload_vertices(const std::vector<Vertex>& vertices);

struct EdgeInstance {
  Eigen::Vector3f a, b;  // ends, in W
  float inside;          // 1 if it is a crease inside the outline of its solid, else 0
  float bulge_m;
};
static_assert(sizeof(EdgeInstance) == 8 * sizeof(float));

// Room for `capacity` instances.
VertexBuffer make_edge_buffer(std::size_t capacity);

// Takes a program and sets the uniforms that a renderer never changes: lights, depth range. All
// others must be set before each use.
GlProgram make_triangle_program(ProgramCache& programs, TextureKind texture,
                                const SceneGeometry& scene);
GlProgram make_sky_program(ProgramCache& programs, TextureKind texture, double luminance);
GlProgram make_edge_program(ProgramCache& programs, const DepthRange& depth);

void set_camera(const GlProgram& program, const Intrinsics& intrinsics);

// Off-screen image: luminance (R32F), ids (R32I), depth. Binding a framebuffer chooses
// whether ids are written.
struct GlTarget {
  GlTexture luminance, ids, depth;
  GlTexture luminance_copy;
  GlFramebuffer without_ids, with_ids;
  GlFramebuffer without_depth;  // for passes that read the depth
};
GlTarget make_target(int width, int height);

}  // namespace dodgesim

// Draws what is made of triangles, unbounded planes and the sky with OpenGL. Lives in the context
// that was current when it was made, with programs of that context.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "sim/render/gl_scene.h"
#include "sim/render/scene_geometry.h"
#include "sim/render/shot.h"
#include "sim/render/triangle_choice.h"
#include "sim/world/snapshot.h"

namespace dodgesim {

class TrianglePainter {
 public:
  // Scene and textures must outlive the painter. Unbounded planes end at far_m; `sky_luminance` is
  // that of a sky without texture.
  TrianglePainter(const SceneGeometry& scene, const SceneTextures& textures, ProgramCache& programs,
                  const DepthRange& depth, double far_m, double sky_luminance);

  // Into the framebuffer that is bound, within the scissor. `window_from_image` is applied to clip
  // coordinates, of which the identity shows the shot's whole image in the viewport.
  void draw_static(const Shot& shot);
  void draw_objects(const Shot& shot, const Snapshot& snapshot,
                    const Eigen::Matrix4d& window_from_image);

 private:
  static constexpr std::size_t kTextureKinds = 3;

  const GlProgram& program_for(int texture) const;
  void make_program_for(ProgramCache& programs, int texture);
  void use(const Shot& shot, int texture, const Eigen::Matrix4d& clip_from_G,
           const Eigen::Isometry3d& X_WG, const Eigen::Vector3d& texture_shift, int id) const;
  void draw(const VertexBuffer& buffer, int texture) const;
  void draw(const VertexBuffer& buffer, const std::vector<std::uint32_t>& vertices, int texture,
            bool finest_only) const;
  void draw_unbounded(const Shot& shot);
  void draw_sky(const Shot& shot);

  const SceneGeometry& scene_;
  const SceneTextures& textures_;
  DepthRange depth_;
  std::vector<VertexBuffer> static_buffers_, moving_buffers_, unbounded_buffers_;
  std::vector<TriangleChooser> choosers_;  // of the static batches
  TriangleChoice choice_;                  // while one is drawn
  GlBuffer chosen_;                        // its numbers of vertices
  GlVertexArray no_vertices_;
  std::array<GlProgram, kTextureKinds> programs_;
  GlProgram sky_program_;
};

}  // namespace dodgesim

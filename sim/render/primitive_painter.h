// Draws the ray-cast solids with OpenGL: static ones and parts of thrown objects. Lives in the
// context that was current when it was made, with programs of that context.
#pragma once

#include <array>
#include <vector>

#include "sim/render/gl_scene.h"
#include "sim/render/primitive_view.h"
#include "sim/render/scene_geometry.h"
#include "sim/render/shot.h"
#include "sim/world/snapshot.h"

namespace dodgesim {

class PrimitivePainter {
 public:
  // Scene and textures must outlive the painter.
  PrimitivePainter(const SceneGeometry& scene, const SceneTextures& textures,
                   ProgramCache& programs, const DepthRange& depth);

  // Into the framebuffer that is bound, within the scissor. With depth and ids where a pixel's
  // centre is hit, which may be left out for what is drawn last.
  void draw_static(const Shot& shot);
  void draw_objects(const Shot& shot, const Snapshot& snapshot, bool last_depth_and_id);
  void draw_all(const Shot& shot, const Snapshot& snapshot);

  // Only where the static ones are.
  void draw_static_depth(const Shot& shot);

 private:
  static constexpr std::size_t kTypes = 4, kTextureKinds = 3;

  struct Wanted {
    bool statics, objects;
  };
  void make_programs(ProgramCache& programs);
  void arrange(const Shot& shot, const Snapshot* snapshot, Wanted wanted);
  void draw_arranged(const Shot& shot, bool last_depth_and_id);
  void set_outline(const GlProgram& program, const Shot& shot, std::size_t index) const;
  void draw_luminance(const Shot& shot, std::size_t index);
  void draw_depth_and_id(const Shot& shot, std::size_t index);

  const SceneGeometry& scene_;
  const SceneTextures& textures_;
  DepthRange depth_;
  GlVertexArray no_vertices_;
  std::array<std::array<GlProgram, kTextureKinds>, kTypes> programs_;
  std::array<GlProgram, kTypes> hard_programs_;

  // Of the shot being drawn.
  std::vector<PrimitiveView> views_;
  std::vector<Eigen::Isometry3d> poses_;  // X_WG
  std::vector<std::size_t> order_;        // primitives to draw, back to front
};

}  // namespace dodgesim

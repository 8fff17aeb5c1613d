// Paints thrown meshes: OpenGL draws them with many samples a pixel, of which a pixel takes the
// mean, as its square aperture would.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "sim/render/gl_scene.h"
#include "sim/render/primitive_painter.h"
#include "sim/render/shot.h"
#include "sim/render/triangle_painter.h"
#include "sim/world/snapshot.h"

namespace dodgesim {

class MeshPainter {
 public:
  // Makes OpenGL objects in the current context, which must be that of `triangles`.
  explicit MeshPainter(TrianglePainter& triangles);

  // In the shot's region of the picture, whose depth is not null: what it shows before is hidden by
  // what is nearer. Leaves another framebuffer bound.
  void paint(const Shot& shot, const Snapshot& snapshot, const PaintedPicture& picture);

 private:
  void draw(const Shot& shot, const Snapshot& snapshot, const Rect& tile, const Rect& samples);
  void blend_pixel(std::ptrdiff_t center, std::ptrdiff_t pitch, std::ptrdiff_t pixel,
                   const PaintedPicture& picture) const;

  TrianglePainter& triangles_;
  GlTarget target_;
  // Of the samples that were drawn last.
  std::vector<float> luminance_, depth_;
  std::vector<std::int32_t> id_;
};

}  // namespace dodgesim

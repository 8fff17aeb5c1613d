// Paints the solids that are ray-cast: static ones and parts of thrown objects. With loops over
// pixels of our own, which take less time than shaders of llvmpipe (results/bench/tried.md).
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "sim/render/depth_range.h"
#include "sim/render/primitive_view.h"
#include "sim/render/scene_geometry.h"
#include "sim/render/shot.h"
#include "sim/render/solid_coverage.h"
#include "sim/render/surface_kernels.h"
#include "sim/render/texture_pyramid.h"
#include "sim/world/snapshot.h"

namespace dodgesim {

// A picture as large as the camera's image.
struct PaintedPicture {
  float* luminance;  // null: only what the other two say is painted
  float* depth;      // as DepthRange says; null: nothing hides anything, and none is written
  std::int32_t* id;  // where a solid is at a pixel's centre, 1 + its object; may be null
};

class PrimitivePainter {
 public:
  // The scene must outlive the painter.
  PrimitivePainter(const SceneGeometry& scene, bool trilinear, const DepthRange& depth);

  // In the shot's region of the picture, from back to front.
  void paint_static(const Shot& shot, const PaintedPicture& picture);
  void paint_objects(const Shot& shot, const Snapshot& snapshot, const PaintedPicture& picture);
  void paint_all(const Shot& shot, const Snapshot& snapshot, const PaintedPicture& picture);

 private:
  // Points of one face on two rows of pixels.
  class FaceRows {
   public:
    void start(int width);
    // Of the row and, with `below`, of the next one.
    void compute(const SolidKernels& kernels, const SolidView& view, int face, int column, int row,
                 int size, bool below);
    // From that pixel of the row on.
    PointRow here(int pixel = 0) { return at(here_, pixel); }
    PointRow below(int pixel = 0) { return at(1 - here_, pixel); }

   private:
    static constexpr std::size_t kComponents = 6;
    PointRow at(int row, int pixel);

    std::array<std::array<std::vector<float>, kComponents>, 2> rows_;
    int here_ = 0, row_below_ = -1;
  };
  struct Wanted {
    bool statics, objects;
  };
  // The primitive being painted.
  struct Subject {
    const SolidKernels* kernels;
    SolidView view;
    float albedo, emission;
    bool textured;
    TextureOnSolid texture;
    TextureRead read;
    std::int32_t id;
    Rect pixels;
  };

  void arrange(const Shot& shot, const Snapshot* snapshot, Wanted wanted);
  void paint_arranged(const Shot& shot, const PaintedPicture& picture);
  // Without depths only the luminance is wanted, and nothing hides the solid.
  void start(const Shot& shot, std::size_t index, bool depths);
  void turn_lights(const Eigen::Isometry3d& X_WG);
  struct Span {
    int begin, size;
  };
  Span covered(int size) const;
  void paint_row(int y, int size, const float* depth, float* luminance);
  const float* unhidden(const float* depth, int size);
  float buffered(float z_C) const;
  void mark(int size, float* depth, std::int32_t* id) const;

  const SceneGeometry& scene_;
  bool trilinear_;
  DepthRange depth_;
  std::vector<TexturePyramid> pyramids_;  // of the scene's textures; empty if no primitive has it

  // Of the shot being painted.
  std::vector<PrimitiveView> views_;
  std::vector<Eigen::Isometry3d> poses_;  // X_WG
  std::vector<std::size_t> order_;        // primitives to paint, back to front
  Subject subject_{};
  LightsInG lights_;
  SolidCoverage coverage_;
  std::array<FaceRows, kMostFaces> faces_;
  std::vector<float> value_, sum_, shown_;
};

}  // namespace dodgesim

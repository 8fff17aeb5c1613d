// What a camera sees of the static scene, taken from a picture of it that was drawn nearby.
//
// Drawing a room in software costs milliseconds; a turning camera needs a thousand pictures a
// second. What a static scene shows from one pose, it shows from the poses around: a point of known
// depth moves to where geometry says (Hartley and Zisserman 2004, chapter 6), with the same
// luminance, as surfaces are Lambertian. So a picture of the static scene, a key, is drawn finer
// and wider than the camera's view, with its depth, and the view from every later pose is read from
// it until the view leaves it or the camera has moved so far that an edge of something near would
// be in the wrong place.
//
// Where the pixels of the view lie in the key is computed on a grid of nodes and runs linearly
// between them. A pixel's luminance is the mean over its square aperture, as a pixel of a sensor
// collects it, and is read from a picture of all such means, a third of a pixel apart (with the
// default supersampling of 3), linearly in between; the means are sharpened by what the linear
// reading smooths away on the average. What all this costs in accuracy: results/sensor/README.md.
#pragma once

#include <Eigen/Dense>
#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "sim/camera/camera.h"
#include "sim/render/spec.h"

namespace dodgesim {

class KeyPicture {
 public:
  KeyPicture(const Intrinsics& view, const KeySpec& spec);

  // Of the picture to draw: finer and wider than the view, with the same optical axis.
  const Intrinsics& intrinsics() const { return fine_; }
  // How sharply to read its textures: the mean over an aperture smooths them enough.
  double lod_bias() const { return supersampling_ > 1 ? -1 : 0; }

  // The picture from X_WC, row-major from the top-left pixel of intrinsics(): linear luminance
  // (at most 65504) and inverse depth 1/z_C [1/m], 0 for the sky.
  void set(const Eigen::Isometry3d& X_WC, const std::vector<float>& luminance,
           const std::vector<float>& inverse_depth);

  // Writes the pixels of `region` of the view from X_WC into `luminance` (width x height of the
  // view). False, and nothing is written, if a new picture must be drawn, which depends on the pose
  // alone and not on the region. Equal on every processor, bit for bit.
  bool show(const Eigen::Isometry3d& X_WC, const Rect& region, float* luminance);

  // A lower bound on the distance from the camera [m] of everything static that the last show()
  // saw in `region` and kKeyCellPx around it, inside the view or not; infinite for the sky.
  double nearest_m(const Rect& region) const;

 private:
  void set_aperture_means(const std::vector<float>& luminance);
  void take_means(const std::vector<float>& luminance, int j, std::vector<float>& means);
  void put_means(int j, int above, int at, int below);
  void set_depth(const std::vector<float>& inverse_depth);
  void set_tile(int x0, int y0);
  bool near_enough() const;
  double bend_px() const;
  void place_nodes();
  bool covers_view() const;
  void read_row(int row, const Rect& cells, float* luminance);
  std::size_t node(int column, int row) const;
  std::size_t tile(int column, int row) const;

  Intrinsics view_, fine_, wide_;  // wide_: the view with its margin, no finer
  int supersampling_;
  int columns_;           // of nodes
  int tile_columns_ = 0;  // see tile_nearest_
  bool every_picture_;    // is drawn
  bool is_set_ = false;
  double max_misplacement_px_, max_zoom_;

  // While means are taken.
  static constexpr int kMeanRows = 3;
  std::array<std::vector<float>, kMeanRows> mean_rows_;
  std::vector<float> scratch_row_, sharp_row_;

  Eigen::Isometry3d X_KW_ = Eigen::Isometry3d::Identity();  // K: the camera when it was drawn
  std::vector<std::uint16_t> means_;  // over apertures, half precision; of fine_, with spare rows
  std::vector<float> inverse_depth_;  // of wide_ [1/m]
  std::vector<float> tile_nearest_;   // bounds on inverse distance, by tiles of a cell's size [1/m]
  double nearest_inverse_m_ = 0;      // largest of inverse_depth_
  double misplacement_px_per_m_ = 0;  // bound on the error of a straight line between nodes

  // Of the last show().
  Eigen::Isometry3d X_KC_ = Eigen::Isometry3d::Identity();
  std::vector<float> node_u_, node_v_;  // where a node lies in means_ [px]
  std::vector<float> cell_u_, cell_v_;  // where a row's cells begin in means_
  std::vector<float> step_u_, step_v_;  // from pixel to pixel of a cell
  std::vector<float> row_;              // of the view, in whole cells
};

}  // namespace dodgesim

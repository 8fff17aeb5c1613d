// What a camera sees of the static scene between two pictures of it, when it mostly turns.
//
// A rotation about the camera's centre moves the picture by a homography that knows no depth
// (Hartley and Zisserman 2004, section 8.4.2): x' ~ K R K^-1 x. A picture that was drawn at one
// orientation therefore serves every orientation near it. Seen from the orientation in between, two
// pictures differ by what the camera's translation has moved alone; that runs linearly in time from
// the one to the other, as luminance does from sample to sample.
#pragma once

#include <Eigen/Dense>
#include <vector>

#include "sim/render/camera.h"

namespace dodgesim {

// `view` with margin_px more on every side.
Intrinsics with_margin(const Intrinsics& view, int margin_px);

// A picture of the static scene, wider than the camera's view so that it covers the view of a
// camera that has turned a little.
class TurnedPicture {
 public:
  // A camera may turn until no point of its view has moved farther than max_turn_px.
  TurnedPicture(const Intrinsics& view, int max_turn_px);

  // How many pixels wider than the view the picture is on every side.
  int margin_px() const { return margin_px_; }
  const Intrinsics& intrinsics() const { return wide_; }

  // The picture of orientation R_WC: intrinsics().width x height, row-major from the top left,
  // linear luminance.
  void set(const Eigen::Matrix3d& R_WC, const std::vector<float>& luminance);

  // The camera's view: width x height of the view.
  void copy_view(std::vector<float>& luminance) const;

  const Eigen::Matrix3d& R_WC() const { return R_WC_; }

  // The picture at twice its resolution, for reading between pixels: grid point (2 x, 2 y) is pixel
  // (x, y). Filled when it is first asked for.
  const std::vector<float>& fine();
  int fine_width() const { return 2 * wide_.width; }

 private:
  void refine();

  int margin_px_;
  Intrinsics wide_;
  Eigen::Matrix3d R_WC_ = Eigen::Matrix3d::Identity();
  std::vector<float> luminance_;
  std::vector<float> fine_;
  bool is_fine_ = false;
};

// The view of a camera of orientation R_WC, from one picture. `luminance` is written: view.width x
// view.height. Equal on every processor, bit for bit.
void turn(const Intrinsics& view, TurnedPicture& picture, const Eigen::Matrix3d& R_WC,
          std::vector<float>& luminance);

// The same from two, of which `share_b` (0 to 1) is b's. `scratch` is as large as
// `luminance`.
void blend_turned(const Intrinsics& view, TurnedPicture& a, TurnedPicture& b,
                  const Eigen::Matrix3d& R_WC, double share_b, std::vector<float>& scratch,
                  std::vector<float>& luminance);

}  // namespace dodgesim

// What a camera sees of the static scene: read from pictures of it that are drawn when needed
// (key_picture.h).
#pragma once

#include <Eigen/Dense>
#include <cstdint>
#include <vector>

#include "sim/camera/camera.h"
#include "sim/render/key_picture.h"
#include "sim/render/luminance_renderer.h"
#include "sim/render/spec.h"

namespace dodgesim {

class KeyedView {
 public:
  KeyedView(const Intrinsics& view, const KeySpec& spec);

  // Writes the pixels of `region` of the view from X_WC into `luminance` (width x height of the
  // view). Equal on every processor, bit for bit.
  void show(LuminanceRenderer& renderer, const Eigen::Isometry3d& X_WC, const Rect& region,
            float* luminance);

  // As KeyPicture::nearest_m(), of the last show().
  double nearest_m(const Rect& region) const { return key_.nearest_m(region); }
  std::int64_t drawn() const { return drawn_; }  // pictures

 private:
  KeyPicture key_;
  std::vector<float> luminance_, inverse_depth_;  // as the renderer draws a picture
  std::int64_t drawn_ = 0;
};

}  // namespace dodgesim

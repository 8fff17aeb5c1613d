#include "sim/render/keyed_view.h"

#include <cstddef>
#include <stdexcept>

namespace dodgesim {

KeyedView::KeyedView(const Intrinsics& view, const KeySpec& spec)
    : key_(view, spec),
      luminance_(static_cast<std::size_t>(key_.intrinsics().width) *
                 static_cast<std::size_t>(key_.intrinsics().height)),
      inverse_depth_(luminance_.size()) {}

void KeyedView::show(LuminanceRenderer& renderer, const Eigen::Isometry3d& X_WC, const Rect& region,
                     float* luminance) {
  if (key_.show(X_WC, region, luminance)) return;
  renderer.render_static(key_.intrinsics(), X_WC, key_.lod_bias(), luminance_.data(),
                         inverse_depth_.data());
  key_.set(X_WC, luminance_, inverse_depth_);
  ++drawn_;
  if (!key_.show(X_WC, region, luminance)) {
    throw std::logic_error("A picture must serve the pose from which it was drawn.");
  }
}

}  // namespace dodgesim

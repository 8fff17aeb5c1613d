// Moving pictures without end, for the event camera's benchmark. Deterministic.
#pragma once

#include <cstdint>
#include <functional>
#include <vector>

namespace dodgesim {

// Fills in picture number k, width x height of linear luminance.
using MovingPicture = std::function<void(std::int64_t k, std::vector<float>& luminance)>;

// A random texture without detail finer than 10 px that drifts sideways by speed_px a picture,
// back and forth over a stretch of 64 px.
MovingPicture drifting_texture(int width, int height, double speed_px);

// The same texture at rest, in steps of 1/255, each pixel flickering between two neighbouring ones
// that no event camera with thresholds of 0.1 or more tells apart.
MovingPicture quiet_texture(int width, int height);

}  // namespace dodgesim

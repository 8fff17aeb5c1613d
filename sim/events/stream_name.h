// Random streams of a camera.
#pragma once

#include <string>
#include <string_view>

namespace dodgesim {

// Of one thing in one camera.
inline std::string stream_name(std::string_view camera, const char* what) {
  return std::string(camera) + "/" + what;
}

}  // namespace dodgesim

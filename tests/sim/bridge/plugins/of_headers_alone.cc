// A plug-in that links no more than dodge_headers, and looks through its camera.
#include <stdexcept>

#include "dodge/plugin.h"

namespace {

std::unique_ptr<dodge::Pilot> make(const dodge::Config& config, const std::string& /*text*/) {
  const dodge::CameraModel& camera = config.cameras.at(0);
  const Eigen::Vector2d bearing = camera.bearing({3, 4});
  const Eigen::Vector2d pixel = camera.project(bearing.homogeneous());
  throw std::invalid_argument("I see " + std::to_string(camera.bearing_table().size()) +
                              " pixels, one of them at " + std::to_string(pixel.x()));
}

}  // namespace

DODGE_PLUGIN(make)

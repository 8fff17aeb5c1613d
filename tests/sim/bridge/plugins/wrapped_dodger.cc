// The paper's pilot as a plug-in.
#include "dodge/dodger.h"
#include "dodge/plugin.h"

namespace {

std::unique_ptr<dodge::Pilot> make(const dodge::Config& config, const std::string&) {
  return std::make_unique<dodge::Dodger>(config);
}

}  // namespace

DODGE_PLUGIN(make)

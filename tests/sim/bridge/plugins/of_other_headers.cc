// A plug-in as it was compiled before some class of dodge/ grew.
#include "dodge/plugin.h"

extern "C" std::uint64_t dodge_plugin_interface() { return dodge::kPluginInterface + 1; }
extern "C" dodge::Pilot* dodge_plugin_pilot(const dodge::Config&, const std::string&) {
  return nullptr;
}

#include "sim/bridge/plugin.h"

#include <dlfcn.h>
#include <xxhash.h>

#include <array>
#include <cerrno>
#include <cinttypes>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <map>
#include <sstream>

#include "sim/base/error.h"

namespace dodgesim {

namespace {

using InterfaceFunction = std::uint64_t();
using PilotFunction = dodge::Pilot*(const dodge::Config&, const std::string&);

[[noreturn]] void refuse(const Plugin& plugin, const std::string& why) {
  throw SimulationError("The plug-in " + plugin.file + " " + why);
}

template <class Function>
Function* function_of(void* library, const char* name, const Plugin& plugin) {
  void* const symbol = ::dlsym(library, name);
  if (symbol == nullptr) {
    refuse(plugin,
           std::string("has no ") + name + "(); DODGE_PLUGIN of dodge/plugin.h puts it there.");
  }
  return reinterpret_cast<Function*>(symbol);
}

PilotFunction* load(const Plugin& plugin) {
  if (read_plugin(plugin.file).digest != plugin.digest) {
    refuse(plugin, "has changed since the campaign began.");
  }
  // A name without a slash would be looked for among the libraries of the system.
  const std::string path = std::filesystem::absolute(plugin.file).string();
  void* const library = ::dlopen(path.c_str(), RTLD_NOW | RTLD_LOCAL);
  if (library == nullptr) {
    refuse(plugin, std::string("cannot be loaded: ") + ::dlerror() + ".");
  }
  if (function_of<InterfaceFunction>(library, "dodge_plugin_interface", plugin)() !=
      dodge::kPluginInterface) {
    refuse(plugin,
           "was compiled with headers of dodge/ other than the simulator's: compile it anew.");
  }
  return function_of<PilotFunction>(library, "dodge_plugin_pilot", plugin);
}

}  // namespace

Plugin read_plugin(const std::string& file) {
  std::ifstream in(file, std::ios::binary);
  std::ostringstream bytes;
  if (in) bytes << in.rdbuf();
  if (!in || !bytes) {
    throw IoError("The plug-in " + file + " could not be read: " + std::strerror(errno) + ".");
  }
  const std::string text = bytes.str();
  std::array<char, 17> digest{};
  std::snprintf(digest.data(), digest.size(), "%016" PRIx64, XXH64(text.data(), text.size(), 0));
  return {file, digest.data()};
}

std::unique_ptr<dodge::Pilot> make_pilot(const Plugin& plugin, const dodge::Config& config,
                                         const std::string& parameters) {
  static std::map<std::string, PilotFunction*> loaded;  // by digest; a process flies in one thread
  PilotFunction*& make = loaded[plugin.digest];
  if (make == nullptr) make = load(plugin);
  std::unique_ptr<dodge::Pilot> pilot(make(config, parameters));
  if (!pilot) refuse(plugin, "made no pilot.");
  return pilot;
}

}  // namespace dodgesim

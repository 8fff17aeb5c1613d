#include "sim/bridge/plugin.h"

#include <dlfcn.h>
#include <sys/mman.h>
#include <unistd.h>
#include <xxhash.h>

#include <array>
#include <cerrno>
#include <cinttypes>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>
#include <new>

#include "sim/base/error.h"
#include "sim/bridge/guarded_pilot.h"

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
  const std::string path = "/proc/self/fd/" + std::to_string(plugin.copy);
  void* const library = ::dlopen(path.c_str(), RTLD_NOW | RTLD_LOCAL);
  if (library == nullptr) {
    refuse(plugin, std::string("cannot be loaded: ") + ::dlerror() + ".");
  }
  if (function_of<InterfaceFunction>(library, "dodge_plugin_interface", plugin)() !=
      dodge::kPluginInterface) {
    refuse(plugin,
           "was compiled with other headers of dodge/ than the simulator, or with options that "
           "change their classes, such as -march=native: compile it anew.");
  }
  return function_of<PilotFunction>(library, "dodge_plugin_pilot", plugin);
}

// The functions of the libraries that this process has loaded, by their digest.
PilotFunction* loaded(const Plugin& plugin) {
  static std::map<std::string, PilotFunction*> functions;  // no thread but one makes pilots
  PilotFunction*& function = functions[plugin.digest];
  if (function == nullptr) function = load(plugin);
  return function;
}

std::string bytes_of(const std::string& file) {
  std::error_code error;
  if (std::filesystem::exists(file, error) && !std::filesystem::is_regular_file(file, error)) {
    throw IoError("The plug-in " + file + " could not be read: it is no regular file.");
  }
  std::ifstream in(file, std::ios::binary);
  const std::string reason = std::strerror(errno);
  std::string bytes{std::istreambuf_iterator<char>(in), {}};
  if (!in.is_open() || in.bad()) {
    throw IoError("The plug-in " + file + " could not be read: " + reason + ".");
  }
  return bytes;
}

// So that the library may be compiled anew while a campaign flies what it was.
int copy_in_memory(const std::string& bytes, const std::string& file) {
  const int copy = ::memfd_create("plugin", 0);
  for (std::size_t written = 0; copy >= 0 && written < bytes.size();) {
    const ssize_t n = ::write(copy, bytes.data() + written, bytes.size() - written);
    if (n < 0 && errno == EINTR) continue;
    if (n <= 0) throw IoError("The plug-in " + file + " does not fit into the memory.");
    written += static_cast<std::size_t>(n);
  }
  if (copy < 0) throw IoError("The plug-in " + file + ": " + std::strerror(errno) + ".");
  return copy;
}

}  // namespace

Plugin read_plugin(const std::string& file) {
  const std::string bytes = bytes_of(file);
  std::array<char, 17> digest{};
  std::snprintf(digest.data(), digest.size(), "%016" PRIx64, XXH64(bytes.data(), bytes.size(), 0));
  return {file, digest.data(), copy_in_memory(bytes, file)};
}

std::unique_ptr<dodge::Pilot> make_plugin_pilot(const Plugin& plugin, const dodge::Config& config,
                                                const std::string& parameters) {
  if (plugin.file.empty()) throw SimulationError("The pilot is plugin, but no library is given.");
  PilotFunction* const make = loaded(plugin);
  std::unique_ptr<dodge::Pilot> pilot;
  try {
    pilot.reset(make(config, parameters));
  } catch (const std::bad_alloc&) {
    throw;
  } catch (const std::exception& error) {
    refuse(plugin, "makes no pilot: " + sentence_of(error));
  } catch (...) {
    refuse(plugin, "makes no pilot: it threw what is no std::exception.");
  }
  if (!pilot) refuse(plugin, "makes no pilot.");
  return std::make_unique<GuardedPilot>(std::move(pilot));
}

}  // namespace dodgesim

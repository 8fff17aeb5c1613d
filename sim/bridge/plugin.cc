#include "sim/bridge/plugin.h"

#include <dlfcn.h>
#include <sys/mman.h>
#include <xxhash.h>

#include <cerrno>
#include <cinttypes>
#include <cstring>
#include <map>
#include <new>

#include "sim/base/descriptor.h"
#include "sim/base/error.h"
#include "sim/base/formatted.h"
#include "sim/base/input_file.h"
#include "sim/base/process_state.h"
#include "sim/bridge/guarded_pilot.h"
#include "sim/bridge/no_exit.h"

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

// Why the library could not be loaded, without the name of the copy that nobody knows.
std::string loading_error(const std::string& copy) {
  std::string why = ::dlerror();
  const std::string name = copy + ": ";
  for (std::size_t at = 0; (at = why.find(name, at)) != std::string::npos;) {
    why.erase(at, name.size());
  }
  if (why.find("undefined symbol") == std::string::npos) return why + ".";
  return why +
         "; link the library that has it (with CMake, dodge for the parts of our pilot). With "
         "-Wl,-z,defs the linker reports it.";
}

PilotFunction* load(const Plugin& plugin) {
  const std::string path = "/proc/self/fd/" + std::to_string(plugin.copy);
  void* const library = ::dlopen(path.c_str(), RTLD_NOW | RTLD_LOCAL);
  if (library == nullptr) refuse(plugin, "cannot be loaded: " + loading_error(path));
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

// So that the library may be compiled anew while a campaign flies what it was.
int copy_in_memory(const std::string& bytes, const std::string& file) {
  const int copy = ::memfd_create("plugin", MFD_CLOEXEC);
  if (copy >= 0 && write_all(copy, bytes)) return copy;
  throw IoError("The plug-in " + file + " could not be copied: " + std::strerror(errno) + ".");
}

}  // namespace

Plugin read_plugin(const std::string& file) {
  const std::string bytes = read_file(file);
  return {file, formatted("%016" PRIx64, XXH64(bytes.data(), bytes.size(), 0)),
          copy_in_memory(bytes, file)};
}

std::unique_ptr<dodge::Pilot> make_plugin_pilot(const Plugin& plugin, const dodge::Config& config,
                                                const std::string& parameters) {
  if (plugin.file.empty()) throw SimulationError("The pilot is plugin, but no library is given.");
  // Libraries compiled with -ffast-math change it when they are loaded.
  const KeptRounding rounding;
  const NoExit no_exit;
  keep_decimal_point();
  PilotFunction* const make = loaded(plugin);
  std::unique_ptr<dodge::Pilot> pilot;
  try {
    pilot.reset(make(config, parameters));
  } catch (const std::bad_alloc&) {
    throw MemoryError("The plug-in " + plugin.file + " makes no pilot: it " + threw_bad_alloc());
  } catch (const std::exception& error) {
    refuse(plugin, "makes no pilot: " + sentence_of(error));
  } catch (...) {
    refuse(plugin, "makes no pilot: it threw what is no std::exception.");
  }
  if (!pilot) refuse(plugin, "makes no pilot.");
  return std::make_unique<GuardedPilot>(std::move(pilot));
}

}  // namespace dodgesim

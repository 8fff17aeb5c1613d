#include "sim/render/gl.h"

#include <dlfcn.h>

#include <string>

#include "sim/base/error.h"
#include "sim/base/memory_limit.h"

namespace dodgesim {

namespace {

void* load_osmesa() {
  // For all: MuJoCo looks for its own functions in what the process has loaded.
  void* library = dlopen("libOSMesa.so.8", RTLD_NOW | RTLD_GLOBAL);
  if (library) return library;
  const std::string reason = dlerror();
  const std::optional<std::int64_t> limit_mb = memory_limit_mb();
  throw SimulationError(
      "OSMesa cannot be loaded (" + reason + "): is Mesa's llvmpipe (libosmesa6) installed" +
      (limit_mb ? ", and is the limit of memory, " + std::to_string(*limit_mb) + " MB, enough"
                : "") +
      "?");
}

}  // namespace

void* find_in_osmesa(const char* function) {
  static void* const library = load_osmesa();
  if (void* found = dlsym(library, function)) return found;
  throw SimulationError(std::string("OSMesa has no function ") + function + ".");
}

}  // namespace dodgesim

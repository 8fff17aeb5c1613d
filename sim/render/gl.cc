#include "sim/render/gl.h"

#include <dlfcn.h>

#include <string>

#include "sim/base/error.h"

namespace dodgesim {

namespace {

void* load_osmesa() {
  // For all: MuJoCo looks for its own functions in what the process has loaded.
  void* library = dlopen("libOSMesa.so.8", RTLD_NOW | RTLD_GLOBAL);
  if (library) return library;
  throw SimulationError(std::string("OSMesa cannot be loaded (") + dlerror() +
                        "): is Mesa's llvmpipe (libosmesa6) installed?");
}

}  // namespace

void* find_in_osmesa(const char* function) {
  static void* const library = load_osmesa();
  if (void* found = dlsym(library, function)) return found;
  throw SimulationError(std::string("OSMesa has no function ") + function + ".");
}

}  // namespace dodgesim

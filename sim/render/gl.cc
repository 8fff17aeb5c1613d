#include "sim/render/gl.h"

#include <dlfcn.h>

#include <string>

#include "sim/base/error.h"
#include "sim/base/memory_limit.h"

namespace dodgesim {

namespace {

constexpr const char* kQuestion = ": is Mesa's llvmpipe (libosmesa6) installed";

void* load_osmesa() {
  // For all: MuJoCo looks for its own functions in what the process has loaded.
  void* library = dlopen("libOSMesa.so.8", RTLD_NOW | RTLD_GLOBAL);
  if (library) return library;
  const std::string reason = dlerror();
  const std::string what = "OSMesa cannot be loaded (" + reason + ")";
  if (reason.find("No such file") == std::string::npos) refuse_osmesa(what);
  throw ScenarioError(what + kQuestion + "?");
}

}  // namespace

void refuse_osmesa(const std::string& what) {
  const std::string question = what + kQuestion;
  const std::optional<std::int64_t> limit_mb = memory_limit_mb();
  if (!limit_mb) throw ScenarioError(question + "?");
  throw MemoryError(question + ", and is the limit of memory, " + std::to_string(*limit_mb) +
                    " MB, enough?");
}

void* find_in_osmesa(const char* function) {
  static void* const library = load_osmesa();
  if (void* found = dlsym(library, function)) return found;
  throw SimulationError(std::string("OSMesa has no function ") + function + ".");
}

}  // namespace dodgesim

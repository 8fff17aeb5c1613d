#include "sim/base/mujoco.h"

#include <mujoco/mjxmacro.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <string_view>
#include <type_traits>

#include "sim/base/error.h"

namespace dodgesim {

namespace {

// "could not allocate memory", "Could not allocate mjData buffer".
bool lacks_memory(const std::string& message) {
  return message.find("ould not allocate") != std::string::npos;
}

void throw_error(const char* message) {
  const std::string what = std::string("MuJoCo reports an error: ") + message + ".";
  if (lacks_memory(message)) throw MemoryError(what);
  throw SimulationError(what);
}

void ignore_warning(const char*) {}

// MuJoCo's messages run over several lines and end without a full stop.
std::string one_line(std::string text) {
  while (!text.empty() && (text.back() == '\n' || text.back() == '.')) text.pop_back();
  for (std::size_t at = 0; (at = text.find('\n', at)) != std::string::npos;) {
    text.replace(at, 1, ", ");
  }
  return text;
}

// MuJoCo makes the hulls of what collides with Qhull, and drops what that says.
std::string explained(std::string message) {
  constexpr std::string_view kQhull = "qhull error";
  const std::size_t at = message.find(kQhull);
  if (at == message.npos) return message;
  return message.insert(at + kQhull.size(), " (are the mesh's points in one plane?)");
}

template <class T>
bool all_finite(const T* values, int count) {
  if constexpr (!std::is_floating_point_v<T>) return true;
  return std::all_of(values, values + count, [](T value) { return std::isfinite(value); });
}

// MuJoCo takes "nan" for a number, and compiles it.
void check_numbers(const mjModel* model, const std::string& label) {
  MJMODEL_POINTERS_PREAMBLE(model)
#define X(type, name, rows, columns)                                                   \
  if (!all_finite(model->name, model->rows * (columns))) {                             \
    throw ScenarioError(label + ": a number of the model is not finite (" #name ")."); \
  }
  MJMODEL_POINTERS
#undef X
}

}  // namespace

MjModelPtr compile_model(const std::string& xml, const std::string& directory,
                         const std::string& label) {
  mju_user_error = throw_error;
  mju_user_warning = ignore_warning;
  // A virtual file inside `directory`, so that relative includes and assets resolve there.
  const std::string name = "dodgesim_composed_model.xml";
  const auto vfs_memory = std::make_unique<mjVFS>();
  mj_defaultVFS(vfs_memory.get());
  const std::unique_ptr<mjVFS, decltype(&mj_deleteVFS)> vfs(vfs_memory.get(), mj_deleteVFS);
  const int failed = mj_makeEmptyFileVFS(vfs.get(), name.c_str(), static_cast<int>(xml.size()));
  if (failed != 0) throw MemoryError(label + ": the composed model does not fit in memory.");
  std::memcpy(vfs->filedata[mj_findFileVFS(vfs.get(), name.c_str())], xml.data(), xml.size());
  char message[1000] = "";
  MjModelPtr model;
  try {
    model.reset(mj_loadXML((directory + "/" + name).c_str(), vfs.get(), message, sizeof message));
  } catch (const SimulationError& error) {
    throw ScenarioError(label + ": " + error.what());
  }
  if (!model && lacks_memory(message)) {
    throw MemoryError(label + ": " + one_line(message) + ".");
  }
  if (!model) {
    throw ScenarioError(label + ": the model does not compile: " + explained(one_line(message)) +
                        ".");
  }
  check_numbers(model.get(), label);
  return model;
}

void check_warnings(const mjData& data) {
  if (data.warning[mjWARN_CONTACTFULL].number + data.warning[mjWARN_CNSTRFULL].number > 0) {
    throw SimulationError("The models touch at too many points at once for the simulation, at " +
                          std::to_string(data.time) +
                          " s: give those that collide fewer or simpler geoms.");
  }
  if (data.warning[mjWARN_INERTIA].number > 0) {
    throw SimulationError("The simulation diverged: MuJoCo warns of the inertia matrix at " +
                          std::to_string(data.time) + " s.");
  }
}

}  // namespace dodgesim

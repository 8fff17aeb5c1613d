// The project's models, and copies of them that a test may change.
#pragma once

#include <filesystem>
#include <string>

#include "tests/sim/files/temporary_directory.h"

namespace dodgesim::testing {

inline const std::string kModels = DODGESIM_SOURCE_DIR "/models";

// As `directory`/models, which is returned.
inline std::filesystem::path copy_models(const std::filesystem::path& directory) {
  std::filesystem::path models = directory / "models";
  std::filesystem::copy(kModels, models, std::filesystem::copy_options::recursive);
  return models;
}

// Makes the vehicle's rotor drag so large that a tick is too long.
inline void make_diverging(const std::filesystem::path& models) {
  const std::filesystem::path vehicle = models / "vehicles/qav_rxl.xml";
  std::string model = contents(vehicle);
  const std::string drag = "0.544 0.386 0";
  model.replace(model.find(drag), drag.size(), "1e99 1e99 0");
  put(vehicle, model);
}

}  // namespace dodgesim::testing

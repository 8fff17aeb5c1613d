#include <filesystem>
#include <fstream>

#include "sim/config/event_camera_file.h"
#include "tests/fuzz/inputs.h"

namespace dodgesim::fuzz {

bool camera(Bytes bytes) {
  // By its name the reader knows that it is YAML.
  static const std::string path = std::filesystem::temp_directory_path() /
                                  ("dodgesim_fuzz_" + std::to_string(::getpid()) + ".yaml");
  std::ofstream(path, std::ios::binary) << text_of(bytes);
  const bool accepted = accepts([&] { named_event_camera(path); });
  std::filesystem::remove(path);
  return accepted;
}

}  // namespace dodgesim::fuzz

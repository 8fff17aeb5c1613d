#include <filesystem>
#include <fstream>

#include "sim/gate/baseline.h"
#include "tests/fuzz/inputs.h"

namespace dodgesim::fuzz {

namespace {

// A baseline that is whole but for its manifest.
class Directory {
 public:
  Directory() {
    std::filesystem::create_directories(path_);
    for (const char* name : {"throws.csv", "objects.csv", "scenario.resolved.yaml", "table.md"}) {
      std::ofstream(path_ / name) << "x\n";
    }
  }
  ~Directory() { std::filesystem::remove_all(path_); }
  const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_ = std::filesystem::temp_directory_path() /
                                ("dodgesim_fuzz_baseline_" + std::to_string(::getpid()));
};

}  // namespace

bool manifest(Bytes bytes) {
  static const Directory directory;
  std::ofstream(directory.path() / "manifest.json", std::ios::binary) << text_of(bytes);
  const bool is_kind = accepts([&] { machine_kind(directory.path()); });
  return accepts([&] { read_baseline(directory.path()); }) && is_kind;
}

}  // namespace dodgesim::fuzz

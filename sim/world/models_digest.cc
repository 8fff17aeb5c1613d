#include "sim/world/models_digest.h"

#include <xxhash.h>

#include <string>

#include "sim/base/input_file.h"
#include "sim/world/mjcf.h"

namespace dodgesim {

namespace {

void add(const std::string& text, std::uint64_t& digest) {
  digest = XXH64(text.data(), text.size(), digest);
}

void add_model(const std::string& directory, const std::string& file, std::uint64_t& digest) {
  add(file, digest);
  for (const MjcfTag& tag : read_model_file(directory, file)) {
    add(std::to_string(static_cast<int>(tag.kind)) + tag.name, digest);
    for (const auto& [name, value] : tag.attributes) {
      add(name, digest);
      add(value, digest);
      if (name.starts_with("file")) add(read_file(directory + "/" + value), digest);
    }
  }
}

}  // namespace

std::uint64_t models_digest(const WorldSpec& spec) {
  std::uint64_t digest = 0;
  add_model(spec.models_dir, spec.room_file(), digest);
  add_model(spec.models_dir, spec.vehicle_file(), digest);
  for (const ObjectSpec& object : spec.objects) {
    add_model(spec.models_dir, object.file(), digest);
  }
  return digest;
}

}  // namespace dodgesim

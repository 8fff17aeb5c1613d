#include "tools/commands/command.h"

namespace dodgesim {

void add_models_option(CLI::App& command, std::string& models_dir) {
  models_dir = DODGESIM_MODELS_DIR;
  command.add_option("--models", models_dir, "Folder of the rooms, vehicles and objects")
      ->envname("DODGESIM_MODELS")
      ->capture_default_str()
      ->type_name("DIR");
}

std::string count_of_throws(int n) { return std::to_string(n) + (n == 1 ? " throw" : " throws"); }

}  // namespace dodgesim

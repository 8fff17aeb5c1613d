// What this program was built from and on what it runs, for the manifest of a campaign.
#pragma once

#include <string>

namespace dodgesim {

struct BuildInfo {
  std::string commit;     // "unknown" outside of a git work tree
  bool modified = false;  // the work tree had uncommitted changes
  std::string build_type, compiler;
  std::string version;
  std::string mujoco, opencv, eigen, yaml_cpp;
};

BuildInfo build_info();

struct Machine {
  std::string cpu;        // model name
  std::string cpu_flags;  // byte-equality is promised only between machines with the same
  int cores = 0;
  std::string system;  // kernel name and machine
};

Machine machine_info();

}  // namespace dodgesim

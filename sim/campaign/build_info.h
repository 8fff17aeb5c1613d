// What this program was built from and on what it runs, for the manifest of a campaign.
#pragma once

#include <string>

namespace dodgesim {

struct BuildInfo {
  std::string commit;     // "unknown" outside of a git work tree
  bool modified = false;  // the work tree had uncommitted changes
  std::string sources;    // digest of the sources, if the commit does not say what they were
  std::string build_type, compiler;
  std::string version;
  std::string mujoco, opencv, eigen, yaml_cpp;

  // Equal for programs of the same sources: "0.1.0 <commit>", "0.1.0 <commit> modified <digest>".
  std::string name() const;
};

BuildInfo build_info();

struct Machine {
  std::string cpu;        // model name
  std::string cpu_flags;  // byte-equality is promised only between machines with the same
  int cores = 0;
  std::string system;  // kernel with its release, and machine
};

Machine machine_info();

}  // namespace dodgesim

#include "sim/campaign/build_info.h"

#include <sys/utsname.h>

#include <mujoco/mujoco.h>
#include <Eigen/Core>
#include <fstream>
#include <opencv2/core/version.hpp>
#include <thread>

// Written at build time: DODGESIM_COMMIT, DODGESIM_MODIFIED, DODGESIM_SOURCES.
#include "dodgesim_commit.h"

namespace dodgesim {

namespace {

#if defined(__clang__)
constexpr const char* kCompiler = "clang++ ";
#else
constexpr const char* kCompiler = "g++ ";
#endif

}  // namespace

BuildInfo build_info() {
  BuildInfo info;
  info.commit = DODGESIM_COMMIT;
  info.modified = DODGESIM_MODIFIED;
  info.sources = DODGESIM_SOURCES;
  info.version = DODGESIM_VERSION;
  info.build_type = DODGESIM_BUILD_TYPE;
  info.compiler = std::string(kCompiler) + __VERSION__;
  info.mujoco = mj_versionString();
  info.opencv = CV_VERSION;
  info.eigen = std::to_string(EIGEN_WORLD_VERSION) + "." + std::to_string(EIGEN_MAJOR_VERSION) +
               "." + std::to_string(EIGEN_MINOR_VERSION);
  info.yaml_cpp = DODGESIM_YAML_CPP_VERSION;
  return info;
}

std::string BuildInfo::name() const {
  std::string text = version + " " + commit;
  if (modified) text += " modified";
  if (!sources.empty()) text += " " + sources;
  return text;
}

Machine machine_info() {
  Machine machine;
  machine.cores = static_cast<int>(std::thread::hardware_concurrency());
  utsname system;
  if (::uname(&system) == 0) {
    machine.system = std::string(system.sysname) + " " + system.release + " " + system.machine;
  }
  std::ifstream cpus("/proc/cpuinfo");
  for (std::string line; std::getline(cpus, line);) {
    const std::size_t colon = line.find(": ");
    if (colon == std::string::npos) continue;
    const std::string value = line.substr(colon + 2);
    if (line.starts_with("model name") && machine.cpu.empty()) machine.cpu = value;
    if (line.starts_with("flags") && machine.cpu_flags.empty()) machine.cpu_flags = value;
  }
  return machine;
}

}  // namespace dodgesim

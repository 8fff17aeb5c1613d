#include "sim/campaign/manifest.h"

#include <ctime>
#include <stdexcept>

#include "sim/base/error.h"
#include "sim/base/input_file.h"
#include "sim/campaign/build_info.h"
#include "sim/campaign/campaign_files.h"

namespace dodgesim {

std::string utc_now() {
  const std::time_t now = std::time(nullptr);
  std::tm utc{};
  ::gmtime_r(&now, &utc);
  char text[32];
  std::strftime(text, sizeof(text), "%Y-%m-%dT%H:%M:%SZ", &utc);
  return text;
}

Json program_group() {
  const BuildInfo build = build_info();
  return {{"name", "dodgesim"},        {"version", build.version},
          {"commit", build.commit},    {"modified", build.modified},
          {"sources", build.sources},  {"build_type", build.build_type},
          {"compiler", build.compiler}};
}

Json machine_group() {
  const Machine machine = machine_info();
  return {{"cpu", machine.cpu},
          {"cpu_flags", machine.cpu_flags},
          {"cores", machine.cores},
          {"system", machine.system}};
}

Json read_manifest(const std::filesystem::path& directory) {
  const std::filesystem::path path = directory / kManifestFile;
  try {
    return parse_json(read_file(path));
  } catch (const std::invalid_argument& error) {
    throw IoError(path.string() + " is no manifest of a campaign: " + error.what() + ".");
  }
}

Json manifest_of(const Scenario& scenario, const CampaignOptions& options,
                 const CampaignSummary& summary, const std::string& started) {
  const BuildInfo build = build_info();
  Json manifest;
  manifest["program"] = program_group();
  manifest["libraries"] = {{"mujoco", build.mujoco},
                           {"opencv", build.opencv},
                           {"eigen", build.eigen},
                           {"yaml_cpp", build.yaml_cpp},
                           {"gl_renderer", options.gl_renderer ? options.gl_renderer() : ""}};
  manifest["machine"] = machine_group();
  manifest["campaign"] = {{"scenario", scenario.name},
                          {"seed", scenario.seed},
                          {"throws", throw_count(scenario)},
                          {"cells", cell_count(scenario)},
                          {"sweep_values", sweep_count(scenario)},
                          {"models", options.models},
                          {"plugin", options.plugin},
                          {"errors", summary.errors},
                          {"command_line", options.command_line},
                          {"jobs", options.jobs}};
  manifest["time"] = {{"started", started},
                      {"finished", utc_now()},
                      {"wall_s", summary.wall_s},
                      {"throws_flown", summary.flown},
                      {"real_time_factor", summary.real_time_factor}};
  if (summary.flown > 0 && summary.wall_s > 0) {
    manifest["time"]["throws_per_minute"] = 60.0 * summary.flown / summary.wall_s;
  }
  return manifest;
}

}  // namespace dodgesim

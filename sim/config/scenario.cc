#include "sim/config/scenario.h"

#include <filesystem>
#include <stdexcept>

#include "sim/config/numbers.h"
#include "sim/config/reader.h"
#include "sim/config/writer.h"

namespace dodgesim {

namespace {

Position position_of(const ReadContext& context, const std::string& key) {
  const auto found = context.where.find(key);
  return found == context.where.end() ? Position{} : found->second;
}

// R_BC of a camera whose z looks along x of B.
Eigen::Matrix3d looking_forward() {
  Eigen::Matrix3d R_BC;
  R_BC << 0, 0, 1, -1, 0, 0, 0, -1, 0;
  return R_BC;
}

// What a single range per key cannot say.
void check_consistency(const Scenario& scenario, ReadContext& context) {
  if (scenario.mission.type == "goal" && !scenario.mission.goal_m) {
    context.problems.add(position_of(context, "mission.type"),
                         "mission.goal_m is missing, but mission.type goal needs it.");
  }
  if (scenario.mission.type == "hover" && scenario.mission.goal_m) {
    context.problems.add(position_of(context, "mission.goal_m"),
                         "mission.goal_m is given, but mission.type hover does not fly to a goal.");
  }
}

// The flight core checks its own configuration. Which cameras it gets is known only with the
// vehicle's model; a rectified pair stands for them.
void check_dodger(const Scenario& scenario, ReadContext& context) {
  dodge::Config config = scenario.dodger;
  config.cameras.resize(2);
  config.cameras[0].X_BC.translation().z() = 0.15;
  for (dodge::CameraModel& camera : config.cameras) camera.X_BC.linear() = looking_forward();
  try {
    dodge::validate(config);
  } catch (const std::invalid_argument& error) {
    context.problems.add(position_of(context, "dodger"),
                         std::string("dodger does not fit together: ") + error.what());
  }
}

}  // namespace

Scenario parse_scenario(const std::string& text, const std::string& file,
                        const std::string& models_dir) {
  ReadContext context(file);
  context.models_dir = models_dir;
  for (const ParameterDoc& doc : scenario_docs()) context.all_keys.push_back(doc.path);
  const YamlNode root = parse_yaml(text, context.problems);
  Scenario scenario;
  scenario.models_dir = models_dir;
  Reader reader(root, "", context);
  scenario.visit(reader);
  reader.finish();
  context.problems.raise_if_any();
  check_consistency(scenario, context);
  check_dodger(scenario, context);
  context.problems.raise_if_any();
  if (scenario.name.empty()) scenario.name = std::filesystem::path(file).stem().string();
  return scenario;
}

Scenario load_scenario(const std::string& path, const std::string& models_dir) {
  return parse_scenario(read_scenario_text(path), path, models_dir);
}

std::string to_yaml(const Scenario& scenario) {
  Scenario copy = scenario;  // visit() is not const because the reader shares it
  Writer writer;
  copy.visit(writer);
  return writer.yaml();
}

std::vector<ParameterDoc> scenario_docs() {
  Scenario defaults;
  Documenter documenter;
  defaults.visit(documenter);
  return documenter.take();
}

}  // namespace dodgesim

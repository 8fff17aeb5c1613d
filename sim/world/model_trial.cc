#include "sim/world/model_trial.h"

#include <new>
#include <string>

#include "sim/base/child_process.h"
#include "sim/base/error.h"
#include "sim/base/formatted.h"
#include "sim/base/memory_limit.h"
#include "sim/world/referee.h"
#include "sim/world/world.h"

namespace dodgesim {

namespace {

constexpr int kTicks = 40;

std::string files_of(const WorldSpec& spec) {
  std::string files = spec.room_file() + ", " + spec.vehicle_file();
  for (const ObjectSpec& object : spec.objects) files += ", " + object.file();
  return spec.models_dir + " (" + files + ")";
}

void check_place(const VehiclePlace& place, World& world, Referee& referee) {
  world.reset(place.p_W, place.heading_rad, Eigen::Vector3d::Zero());
  referee.reset();
  referee.observe(world, false);
  if (!referee.verdict().crashed) return;
  throw ScenarioError(formatted("The vehicle cannot be at (%g, %g, %g) m: it touches the room "
                                "there, or is outside; move ",
                                place.p_W.x(), place.p_W.y(), place.p_W.z()) +
                      place.key + ".");
}

// What is wrong with the models or the places, or nothing.
std::string complaint_about(const WorldSpec& spec, const std::vector<VehiclePlace>& places,
                            const WorldCheck& check, const TrialLimits& limits) {
  try {
    World world(spec);
    if (check) check(world);
    Referee referee(world);
    for (const VehiclePlace& place : places) check_place(place, world, referee);
    for (int i = 0; i < world.object_count(); ++i) {
      BodyState state;
      state.p_W = Eigen::Vector3d(0, 0, 100);  // where a ceiling may be solid
      world.launch(i, state, false);
    }
    for (int tick = 0; tick < kTicks; ++tick) world.step({});
  } catch (const std::bad_alloc&) {
    return "The models in " + files_of(spec) + " need more memory than " +
           std::to_string(memory_limit_mb().value_or(limits.memory_mb)) + " MB.";
  } catch (const ScenarioError& error) {
    return error.what();
  } catch (const std::exception& error) {
    return "The models in " + files_of(spec) + " cannot fly: " + error.what();
  }
  return "";
}

}  // namespace

void try_world(const WorldSpec& spec, const std::vector<VehiclePlace>& places,
               const WorldCheck& check, const TrialLimits& limits) {
  // First a byte that says whether they are good.
  const ChildAnswer answer = ask_child(
      [&] {
        limit_memory(limits.memory_mb);
        const std::string complaint = complaint_about(spec, places, check, limits);
        return std::string(1, complaint.empty() ? 1 : 0) + complaint;
      },
      limits.wall_ms);
  const std::string subject = "The models in " + files_of(spec);
  if (!answer.in_time) {
    throw ScenarioError(subject + " take longer than " + std::to_string(limits.wall_ms / 1000) +
                        " s to load.");
  }
  if (answer.said.empty()) {
    throw ScenarioError(subject +
                        " crash MuJoCo; a mesh whose faces name points that it does not "
                        "have is a common reason.");
  }
  if (answer.said[0] == 0) throw ScenarioError(answer.said.substr(1));
}

}  // namespace dodgesim

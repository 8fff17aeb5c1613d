#include "sim/flight/setup.h"

#include "sim/config/pilot.h"

namespace dodgesim {

WorldSpec world_spec(const Scenario& scenario, const std::vector<FlightPlan::Launch>& launches) {
  WorldSpec spec;
  spec.models_dir = scenario.models_dir;
  spec.room = scenario.room;
  spec.vehicle = scenario.vehicle;
  spec.vehicle_overrides = scenario.vehicle_overrides;
  for (const auto& launch : launches) spec.objects.push_back(launch.drawn.object);
  return spec;
}

Intrinsics intrinsics(const CameraSpec& camera) {
  return {camera.width, camera.height, focal_length_px(camera.width, camera.horizontal_fov_deg)};
}

int cameras_in_use(const Scenario& scenario) {
  return perceives(scenario.pilot) ? static_cast<int>(scenario.dodger.position.cameras()) : 0;
}

std::vector<dodge::CameraModel> camera_models(const Scenario& scenario,
                                              const VehicleParameters& vehicle) {
  const Intrinsics camera = intrinsics(scenario.sensors.camera);
  std::vector<dodge::CameraModel> models;
  for (const Eigen::Isometry3d& X_BC : vehicle.X_BC) {
    dodge::CameraModel model;
    model.width = camera.width;
    model.height = camera.height;
    model.fx = model.fy = camera.f;
    model.cx = camera.cx();
    model.cy = camera.cy();
    model.X_BC = X_BC;
    models.push_back(model);
  }
  if (const auto turn = scenario.vehicle_overrides.lower_camera_turn()) {
    models.at(1).X_BC.rotate(turn->inverse());
  }
  return models;
}

dodge::Config core_config(const Scenario& scenario, const VehicleParameters& vehicle) {
  dodge::Config config = scenario.dodger;
  config.p_BR = vehicle.X_BR.translation();
  config.cameras = camera_models(scenario, vehicle);
  return config;
}

}  // namespace dodgesim

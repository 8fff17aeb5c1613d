// From the keys of a scenario to the parts that they describe.
#pragma once

#include <vector>

#include "dodge/config.h"
#include "sim/camera/camera.h"
#include "sim/config/scenario.h"
#include "sim/flight/plan.h"
#include "sim/world/compose.h"
#include "sim/world/vehicle_parameters.h"

namespace dodgesim {

// The world in which a scenario's objects fly.
WorldSpec world_spec(const Scenario& scenario, const std::vector<FlightPlan::Launch>& launches);

// The event cameras' geometry.
Intrinsics intrinsics(const CameraSpec& camera);

// Of the vehicle's cameras the pilot looks through the first so many; through none if it is blind.
int cameras_in_use(const Scenario& scenario);

// The cameras as the pilot is told of them, without lower_camera_turn_deg.
std::vector<dodge::CameraModel> camera_models(const Scenario& scenario,
                                              const VehicleParameters& vehicle);

// What a pilot that sees is given: the keys of dodger, and the vehicle's calibration.
dodge::Config core_config(const Scenario& scenario, const VehicleParameters& vehicle);

}  // namespace dodgesim

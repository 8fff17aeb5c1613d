// The flight core's times by its load: figures S4 (ego-motion compensation over events) and S5
// (clustering over pixels) of Falanga et al. 2020.
#pragma once

#include <filesystem>
#include <vector>

namespace dodgesim {

// One camera, one window.
struct WindowTimes {
  double events = 0;  // in the window
  double pixels = 0;  // with events, of moving objects
  double ego_motion_us = 0;
  double clustering_us = 0;
};

// Slopes of the straight lines with the least squares; 0 if all windows have the same load.
double ego_motion_us_per_event(const std::vector<WindowTimes>& windows);
double clustering_us_per_pixel(const std::vector<WindowTimes>& windows);

// Writes ego_motion.png, clustering.png and windows.csv; throws IoError.
void write_stage_curves(const std::filesystem::path& directory,
                        const std::vector<WindowTimes>& windows);

}  // namespace dodgesim

// What a pilot finds in a recording, as CSV files in a folder; see detection_files.cc for columns.
//
// cycles.csv      a row for every cycle: what it found, what it commands
// clusters.csv    what seems to move in the image of a camera (of our own pilots only)
// detections.csv  what was measured, in W
// obstacles.csv   what is tracked, in W
#pragma once

#include <array>
#include <filesystem>

#include "dodge/pilot.h"
#include "sim/base/time.h"
#include "sim/files/directory.h"
#include "sim/files/output_file.h"

namespace dodgesim {

class DetectionFiles {
 public:
  static constexpr std::array<const char*, 4> kNames = {"cycles.csv", "clusters.csv",
                                                        "detections.csv", "obstacles.csv"};

  // Makes the folder. All functions throw IoError; without finish() no file appears, nor a folder.
  explicit DetectionFiles(const std::filesystem::path& directory);

  // After a cycle that began at now_us. Returns the number of clusters.
  int add(TimeUs now_us, const dodge::Pilot& pilot, const dodge::VelocityCommand& command);
  void finish();

 private:
  int add_clusters(TimeUs now_us, const dodge::Pilot& pilot);

  NewDirectory directory_;
  OutputFile cycles_, clusters_, detections_, obstacles_;
};

}  // namespace dodgesim

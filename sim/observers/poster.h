// One picture that tells a throw: the scene with both trajectories, and below it what the top
// camera saw when the pilot first noticed the object: luminance, events, mean time stamp,
// obstacles.
#pragma once

#include <memory>
#include <opencv2/core.hpp>
#include <vector>

#include "sim/camera/camera.h"
#include "sim/files/output_file.h"
#include "sim/observers/chase_camera.h"
#include "sim/observers/dodger_observer.h"
#include "sim/observers/trail.h"
#include "sim/render/scene_pictures.h"
#include "sim/render/spec.h"

namespace dodgesim {

class Poster : public DodgerObserver {
 public:
  Poster(const Intrinsics& intrinsics, const RenderSpec& render)
      : intrinsics_(intrinsics), render_(render) {}

  void on_tick(const World& world) override;
  void on_first_detection() override { detected_ = true; }
  void on_dodger_cycle(TimeUs now_us, const dodge::Dodger& dodger) override;

  // Writes and commits the file; false if nothing was thrown, so that there is nothing to show.
  // Throws IoError if that fails. Of a pilot that is no dodge::Dodger there are the flight paths
  // only.
  bool save(OutputFile& file) const;

 private:
  void draw_scene(const World& world, const PictureView& view);

  Intrinsics intrinsics_;
  RenderSpec render_;
  std::unique_ptr<ScenePictures> scenes_;
  ChaseCamera chase_camera_{3.6};
  Trail trail_{0.015, ScenePictures::kMaxDots};
  const World* world_ = nullptr;  // of the running flight
  double nearest_m_ = 1e9;        // of the object so far
  double looked_at_m_ = 1e9;      // the same when the pilot was looked at last
  bool detected_ = false;         // a true object
  bool looked_last_ = false;      // at the pilot, of what it has detected
  cv::Mat3b scene_;               // at the closest approach
  cv::Mat3b strip_;  // what was seen at the first detection; without one, near the closest approach
};

}  // namespace dodgesim

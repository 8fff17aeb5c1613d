// Pictures of the stages of the paper's pilot.
#pragma once

#include <opencv2/core.hpp>
#include <string>
#include <vector>

#include "sim/observers/dodger_observer.h"

namespace dodgesim {

// Of pictures of events [BGR].
inline const cv::Vec3b kNoEventColour(110, 110, 110), kOnColour(255, 255, 255), kOffColour(0, 0, 0);

// Text that is legible on any ground, its baseline's left end at (x, y).
void write_caption(cv::Mat3b& image, const std::string& text, int x, int y);

// The image at that width, with a title.
cv::Mat3b titled_panel(const cv::Mat3b& image, int width, const std::string& title);

// The stages of one camera [BGR]: events, count, normalised mean time stamp, threshold, obstacles
// with the clusters' rectangles (panels B to F of the paper's Fig. 4). Empty if the pilot does not
// capture them or has no such camera.
std::vector<cv::Mat3b> stage_panels(const dodge::Dodger& pilot, int camera, int panel_width);

// A row of such stages for each camera in use; empty without any. t_us is written into it.
cv::Mat3b stage_picture(const dodge::Dodger& pilot, TimeUs t_us);

// Writes one PNG a cycle of the paper's pilot while an object is in flight: a row of stages for
// each camera.
class StageFilm : public DodgerObserver {
 public:
  // Makes the directory. Throws IoError if it cannot.
  explicit StageFilm(std::string directory);

  void on_tick(const World& world) override;
  void on_dodger_cycle(TimeUs now_us, const dodge::Dodger& dodger) override;

  int pictures() const { return pictures_; }

 private:
  std::string directory_;
  bool object_in_flight_ = false;
  int pictures_ = 0;
};

}  // namespace dodgesim

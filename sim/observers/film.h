// A throw as people look at it: a video of the scene with the event streams beside it.
#pragma once

#include <memory>
#include <opencv2/core.hpp>
#include <string>
#include <vector>

#include "sim/camera/camera.h"
#include "sim/files/mp4_file.h"
#include "sim/flight/flight_observer.h"
#include "sim/observers/chase_camera.h"
#include "sim/observers/trail.h"
#include "sim/render/scene_pictures.h"

namespace dodgesim {

// Events of one camera, drawn over mid grey: ON white, OFF black.
class EventPicture {
 public:
  EventPicture(int width, int height);
  void add(std::span<const Event> events);
  void clear();
  const cv::Mat3b& image() const { return image_; }

 private:
  cv::Mat3b image_;
};

// Writes the video: outside view on the left, the event pictures of the cameras, if any are in use,
// on the right. A picture between two packets of events shows those of the first.
class Film : public FlightObserver {
 public:
  // How many times slower than real a flight may be shown: up to a picture a tick.
  static constexpr double kSlowest = 160;

  // MPEG-4 with H.264, which browsers open, of about 25 pictures a second, `slow` (1 to kSlowest)
  // times slower than real. Throws IoError as Mp4File does. The file gets its name, and takes the
  // place of another, in finish(). `cameras` are in use: none to two.
  Film(const std::string& path, const Intrinsics& intrinsics, int cameras, double slow);

  void on_tick(const World& world) override;
  void on_events(int camera, const Packet& packet) override;
  void on_cycle(TimeUs now_us, const dodge::Pilot& pilot) override;
  void on_command(TimeUs now_us, bool evading) override;

  // Shows the last picture for a second more, with what became of the throw, and finishes the file.
  // Throws IoError if it does not hold every picture.
  void finish(const std::string& verdict);

  // The last picture [BGR].
  const cv::Mat3b& picture() const { return picture_; }

 private:
  struct Eye {
    EventPicture picture;
    TimeUs last_packet_us = 0;
    bool shown = false;  // in a picture of the video
  };

  void compose(const Snapshot& snapshot);
  void caption(const Snapshot& snapshot);

  TimeUs picture_every_us_;  // of flight
  std::unique_ptr<ScenePictures> scene_;
  ChaseCamera chase_camera_;
  std::vector<Eye> eyes_;
  Trail trail_{0.012, 2000};
  bool evading_ = false;
  int detections_ = 0;
  cv::Mat3b picture_;
  Mp4File video_;
};

}  // namespace dodgesim

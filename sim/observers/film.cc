#include "sim/observers/film.h"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

#include "sim/base/error.h"
#include "sim/base/formatted.h"
#include "sim/observers/stage_panels.h"
#include "sim/world/vehicle_parameters.h"

namespace dodgesim {

namespace {

constexpr int kSceneWidth = 640, kSceneHeight = 480;
constexpr int kEyeHeight = kSceneHeight / 2;
constexpr double kSceneDistanceM = 4.2;
constexpr TimeUs kTrailEveryUs = 4000;
constexpr TimeUs kLongestShownUs = 4000;  // events that no others follow
constexpr int kPicturesPerS = 25;
constexpr TimeUs kShownEveryUs = 1000000 / kPicturesPerS;
static_assert(Film::kSlowest * kTickUs <= kShownEveryUs);

}  // namespace

EventPicture::EventPicture(int width, int height) : image_(height, width, kNoEventColour) {}

void EventPicture::add(std::span<const Event> events) {
  for (const Event& e : events) image_(e.y, e.x) = e.polarity > 0 ? kOnColour : kOffColour;
}

void EventPicture::clear() { image_.setTo(kNoEventColour); }

Film::Film(const std::string& path, const Intrinsics& intrinsics, int cameras, double slow)
    : picture_every_us_(std::lround(static_cast<double>(kShownEveryUs) / slow / kTickUs) * kTickUs),
      chase_camera_(kSceneDistanceM),
      picture_(kSceneHeight,
               kSceneWidth + (cameras > 0 ? intrinsics.width * kEyeHeight / intrinsics.height : 0),
               cv::Vec3b(0, 0, 0)),
      // Exactly `slow` times slower, whatever became of the interval in whole ticks.
      video_(path, picture_.cols, picture_.rows,
             1e6 / (slow * static_cast<double>(picture_every_us_))) {
  // One by one: copies would share their pixels.
  for (int i = 0; i < cameras; ++i) {
    eyes_.push_back({EventPicture(intrinsics.width, intrinsics.height)});
  }
}

void Film::on_tick(const World& world) {
  const Snapshot& now = world.snapshot();
  if (now.t_us % kTrailEveryUs == 0) trail_.extend(now);
  if (now.t_us % picture_every_us_ != 0) return;
  if (!scene_) scene_ = std::make_unique<ScenePictures>(world, kSceneWidth, kSceneHeight);
  compose(now);
  video_.write(picture_.data);
  for (Eye& eye : eyes_) {
    eye.shown = true;
    if (now.t_us - eye.last_packet_us >= kLongestShownUs) eye.picture.clear();
  }
}

void Film::on_events(int camera, const Packet& packet) {
  Eye& eye = eyes_.at(static_cast<std::size_t>(camera));
  if (eye.shown) eye.picture.clear();
  eye.shown = false;
  eye.last_packet_us = packet.end_us;
  eye.picture.add(packet.events);
}

void Film::on_cycle(TimeUs /*now_us*/, const dodge::Pilot& pilot) {
  detections_ += static_cast<int>(pilot.detections().size());
}

void Film::on_command(TimeUs /*now_us*/, bool evading) { evading_ = evading; }

void Film::compose(const Snapshot& snapshot) {
  cv::Mat3b scene(kSceneHeight, kSceneWidth);
  scene_->draw(snapshot, chase_camera_.follow(snapshot.vehicle), trail_.dots(), scene.data);
  cv::cvtColor(scene, scene, cv::COLOR_RGB2BGR);
  scene.copyTo(picture_(cv::Rect(0, 0, kSceneWidth, kSceneHeight)));
  cv::Rect place(kSceneWidth, 0, picture_.cols - kSceneWidth, kEyeHeight);
  for (const Eye& eye : eyes_) {
    cv::resize(eye.picture.image(), picture_(place), place.size(), 0, 0, cv::INTER_NEAREST);
    place.y += kEyeHeight;
  }
  caption(snapshot);
}

void Film::caption(const Snapshot& snapshot) {
  write_caption(picture_, formatted("t = %.3f s", seconds(snapshot.t_us)), 10, 20);
  for (std::size_t i = 0; i < snapshot.objects.size(); ++i) {
    if (!snapshot.launched[i]) continue;
    const double distance_m = (snapshot.objects[i].p_W - snapshot.vehicle.p_W).norm();
    const std::string which = snapshot.objects.size() > 1 ? formatted("object %zu", i) : "object";
    write_caption(picture_, formatted("%s: centre at %.2f m", which.c_str(), distance_m), 10,
                  40 + 20 * static_cast<int>(i));
  }
  std::string doing = evading_ ? "evading" : "";
  if (!eyes_.empty()) {
    doing = std::to_string(detections_) + " detections" + (evading_ ? ", evading" : "");
  }
  write_caption(picture_, doing, 10, kSceneHeight - 12);
  for (std::size_t i = 0; i < eyes_.size(); ++i) {
    write_caption(picture_, formatted("events, %s camera", kCameraNames.at(i)), kSceneWidth + 8,
                  static_cast<int>(i) * kEyeHeight + 18);
  }
}

void Film::finish(const std::string& verdict) {
  write_caption(picture_, verdict, 10, kSceneHeight - 32);
  for (int i = 0; i < kPicturesPerS; ++i) video_.write(picture_.data);
  video_.close();
}

}  // namespace dodgesim

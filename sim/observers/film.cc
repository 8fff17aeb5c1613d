#include "sim/observers/film.h"

#include <cmath>
#include <filesystem>
#include <opencv2/imgproc.hpp>

#include "sim/base/error.h"
#include "sim/base/formatted.h"
#include "sim/files/directory.h"
#include "sim/files/output_file.h"
#include "sim/files/png.h"

namespace dodgesim {

namespace {

constexpr int kSceneWidth = 640, kSceneHeight = 480;
constexpr std::size_t kMaxTrail = 2000;
constexpr TimeUs kTrailEveryUs = 4000;
constexpr TimeUs kShownEveryUs = 40000;  // 25 pictures a second
static_assert(Film::kSlowest * kTickUs <= kShownEveryUs);

const cv::Vec3b kGrey(110, 110, 110), kWhite(255, 255, 255), kBlack(0, 0, 0);
const cv::Vec3b kGreen(90, 160, 60), kPurple(170, 60, 130);  // as in the paper's Fig. 4

void write_text(cv::Mat3b& image, const std::string& text, int x, int y) {
  cv::putText(image, text, {x, y}, cv::FONT_HERSHEY_SIMPLEX, 0.45, {0, 0, 0}, 3, cv::LINE_AA);
  cv::putText(image, text, {x, y}, cv::FONT_HERSHEY_SIMPLEX, 0.45, {255, 255, 255}, 1, cv::LINE_AA);
}

}  // namespace

EventPicture::EventPicture(int width, int height) : image_(height, width, kGrey) {}

void EventPicture::add(std::span<const Event> events) {
  for (const Event& e : events) image_(e.y, e.x) = e.polarity > 0 ? kWhite : kBlack;
}

void EventPicture::clear() { image_.setTo(kGrey); }

Film::Film(const std::string& path, const Intrinsics& intrinsics, double slow)
    : place_(path),
      picture_every_us_(std::lround(static_cast<double>(kShownEveryUs) / slow / kTickUs) * kTickUs),
      picture_(kSceneHeight,
               kSceneWidth + intrinsics.width * (kSceneHeight / 2) / intrinsics.height, kBlack),
      // Exactly `slow` times slower, whatever became of the interval in whole ticks.
      video_(place_.partial().string(), place_.path().string(), picture_.cols, picture_.rows,
             1e6 / (slow * static_cast<double>(picture_every_us_))) {
  // One by one: copies would share their pixels.
  for (int i = 0; i < 2; ++i) eyes_.emplace_back(intrinsics.width, intrinsics.height);
}

void Film::on_tick(const World& world) {
  const Snapshot& now = world.snapshot();
  if (now.t_us % kTrailEveryUs == 0) extend_trail(now);
  if (now.t_us % picture_every_us_ != 0) return;
  if (!scene_) scene_ = std::make_unique<ScenePictures>(world, kSceneWidth, kSceneHeight);
  compose(now);
  video_.write(picture_.data);
  for (EventPicture& eye : eyes_) eye.clear();
}

void Film::on_events(int camera, const Packet& packet) {
  eyes_.at(static_cast<std::size_t>(camera)).add(packet.events);
}

void Film::on_cycle(TimeUs /*now_us*/, const dodge::Pilot& pilot) {
  detections_ += static_cast<int>(pilot.detections().size());
}

void Film::on_command(TimeUs /*now_us*/, bool evading) { evading_ = evading; }

void Film::extend_trail(const Snapshot& now) {
  if (trail_.size() + 1 + now.objects.size() > kMaxTrail) return;
  trail_.push_back({now.vehicle.p_W, 0.012, {0.1F, 0.7F, 1.0F, 1.0F}});
  for (std::size_t i = 0; i < now.objects.size(); ++i) {
    if (now.launched[i]) trail_.push_back({now.objects[i].p_W, 0.012, {1.0F, 0.3F, 0.1F, 1.0F}});
  }
}

void Film::compose(const Snapshot& snapshot) {
  // From behind and beside, a little above, far enough to see where throws come from.
  const Eigen::Vector3d forward_W = snapshot.vehicle.q_W * Eigen::Vector3d::UnitX();
  if (!view_) {
    view_ = PictureView{};
    view_->look_at_W = snapshot.vehicle.p_W + 1.2 * forward_W;
    view_->distance_m = 4.2;
    view_->azimuth_deg = 180 / M_PI * std::atan2(forward_W.y(), forward_W.x()) + 65;
    view_->elevation_deg = -15;
  }
  cv::Mat3b scene(kSceneHeight, kSceneWidth);
  scene_->draw(snapshot, *view_, trail_, scene.data);
  cv::cvtColor(scene, scene, cv::COLOR_RGB2BGR);
  scene.copyTo(picture_(cv::Rect(0, 0, kSceneWidth, kSceneHeight)));
  const int width = picture_.cols - kSceneWidth, height = kSceneHeight / 2;
  for (int i = 0; i < 2; ++i) {
    cv::Mat3b eye;
    cv::resize(eyes_[static_cast<std::size_t>(i)].image(), eye, {width, height}, 0, 0,
               cv::INTER_NEAREST);
    eye.copyTo(picture_(cv::Rect(kSceneWidth, i * height, width, height)));
  }
  caption(snapshot);
}

void Film::caption(const Snapshot& snapshot) {
  write_text(picture_, formatted("t = %.3f s", seconds(snapshot.t_us)), 10, 20);
  for (std::size_t i = 0; i < snapshot.objects.size(); ++i) {
    if (!snapshot.launched[i]) continue;
    const double distance_m = (snapshot.objects[i].p_W - snapshot.vehicle.p_W).norm();
    write_text(picture_, formatted("object at %.2f m", distance_m), 10,
               40 + 20 * static_cast<int>(i));
  }
  write_text(picture_, std::to_string(detections_) + " detections" + (evading_ ? ", evading" : ""),
             10, kSceneHeight - 12);
  write_text(picture_, "events, top camera", kSceneWidth + 8, 18);
  write_text(picture_, "events, bottom camera", kSceneWidth + 8, kSceneHeight / 2 + 18);
}

void Film::close() {
  video_.close();
  place_.commit();
}

StageFilm::StageFilm(std::string directory) : directory_(std::move(directory)) {
  make_directory(directory_);
}

void StageFilm::on_start(dodge::Pilot& pilot) {
  if (auto* dodger = dynamic_cast<dodge::Dodger*>(&pilot)) dodger->set_capture(true);
}

void StageFilm::on_tick(const World& world) { object_in_flight_ = world.snapshot().any_launched(); }

void StageFilm::on_cycle(TimeUs now_us, const dodge::Pilot& pilot) {
  const auto* dodger = dynamic_cast<const dodge::Dodger*>(&pilot);
  if (dodger == nullptr || !object_in_flight_) return;
  cv::Mat3b picture = stage_panels(*dodger, 0);
  const cv::Mat3b bottom = stage_panels(*dodger, 1);
  if (!bottom.empty()) cv::vconcat(picture, bottom, picture);
  const auto stamp_us = static_cast<long long>(now_us);
  write_file(directory_ + formatted("/stages_%09lld_us.png", stamp_us), png_of(picture));
  ++pictures_;
}

cv::Mat3b stage_panels(const dodge::Dodger& pilot, int camera) {
  const dodge::StageImages& stages = pilot.stage_images(camera);
  if (stages.events.empty()) return {};
  const cv::Size size = stages.events.size();
  cv::Mat3b panels(size.height, 5 * size.width, kBlack);
  const auto panel = [&](int i) {
    return cv::Mat3b(panels, cv::Rect(i * size.width, 0, size.width, size.height));
  };
  cv::Mat3b events = panel(0), count = panel(1), rho = panel(2), cut = panel(3), found = panel(4);
  events.setTo(kGrey);
  events.setTo(kBlack, stages.events == 1);
  events.setTo(kWhite, stages.events == 2);
  count.setTo(kWhite, stages.count > 0);
  cv::Mat1b rho8;  // -0.5 .. 0.5 over the colour map; no event: black
  stages.rho.convertTo(rho8, CV_8U, 255, 127.5);
  cv::Mat3b colours;
  cv::applyColorMap(rho8, colours, cv::COLORMAP_VIRIDIS);
  colours.copyTo(rho, stages.count > 0);
  cut.setTo(kGreen, stages.count > 0);
  cut.setTo(kPurple, stages.threshold_mask);
  found.setTo(kWhite, stages.obstacle_mask);
  for (const dodge::Cluster& cluster : pilot.clusters(camera)) {
    cv::Point2f corners[4];
    cluster.rectangle.points(corners);
    for (int i = 0; i < 4; ++i) {
      cv::line(found, corners[i], corners[(i + 1) % 4], {60, 60, 255}, 1, cv::LINE_AA);
    }
  }
  const char* titles[] = {"events", "compensated", "mean time stamp", "threshold", "obstacles"};
  for (int i = 0; i < 5; ++i) write_text(panels, titles[i], i * size.width + 6, 16);
  return panels;
}

}  // namespace dodgesim

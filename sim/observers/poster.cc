#include "sim/observers/poster.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <opencv2/imgproc.hpp>
#include <vector>

#include "sim/files/output_file.h"
#include "sim/files/png.h"
#include "sim/observers/stage_panels.h"
#include "sim/render/luminance_renderer.h"

namespace dodgesim {

namespace {

constexpr int kPosterSceneWidth = 1280, kPosterSceneHeight = 600, kPanels = 4;
constexpr TimeUs kDotEveryUs = 10000;
// As long as nothing is detected, the pilot is looked at again when an object is so much nearer.
constexpr double kNearer = 0.9;

// What the top camera has in view, as a grey picture [BGR] of log luminance.
cv::Mat3b log_picture(const World& world, const Intrinsics& intrinsics, const RenderSpec& spec) {
  LuminanceRenderer renderer(world, intrinsics, spec);
  cv::Mat1f luminance(intrinsics.height, intrinsics.width);
  const Snapshot& now = world.snapshot();
  renderer.render(now, now.vehicle.pose() * world.vehicle().X_BC.front(),
                  {0, 0, intrinsics.width, intrinsics.height}, luminance.ptr<float>(), nullptr);
  cv::log(luminance + 1e-3F, luminance);
  cv::Mat1b grey;
  cv::normalize(luminance, grey, 0, 255, cv::NORM_MINMAX, CV_8U);
  cv::Mat3b picture;
  cv::cvtColor(grey, picture, cv::COLOR_GRAY2BGR);
  return picture;
}

}  // namespace

void Poster::on_tick(const World& world) {
  world_ = &world;
  const Snapshot& now = world.snapshot();
  double distance_m = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < now.objects.size(); ++i) {
    if (!now.launched[i]) continue;
    distance_m = std::min(distance_m, (now.objects[i].p_W - now.vehicle.p_W).norm());
  }
  if (std::isinf(distance_m)) return;
  const PictureView& view = chase_camera_.follow(now.vehicle);
  const bool dot = now.t_us % kDotEveryUs == 0;
  if (dot) trail_.extend(now);
  if (distance_m >= nearest_m_) return;
  nearest_m_ = distance_m;
  if (dot) draw_scene(world, view);
}

void Poster::draw_scene(const World& world, const PictureView& view) {
  if (!scenes_)
    scenes_ = std::make_unique<ScenePictures>(world, kPosterSceneWidth, kPosterSceneHeight);
  scene_.create(kPosterSceneHeight, kPosterSceneWidth);
  scenes_->draw(world.snapshot(), view, trail_.dots(), scene_.data);
  cv::cvtColor(scene_, scene_, cv::COLOR_RGB2BGR);
}

void Poster::on_dodger_cycle(TimeUs /*now_us*/, const dodge::Dodger& dodger) {
  if (world_ == nullptr || looked_last_ || trail_.dots().empty()) return;
  looked_last_ = detected_;
  if (!detected_ && nearest_m_ > kNearer * looked_at_m_) return;
  looked_at_m_ = nearest_m_;
  constexpr int kWidth = kPosterSceneWidth / kPanels;
  const std::vector<cv::Mat3b> stages = stage_panels(dodger, 0, kWidth);
  if (stages.empty()) return;
  const cv::Mat3b seen =
      titled_panel(log_picture(*world_, intrinsics_, render_), kWidth, "luminance");
  cv::hconcat(std::vector<cv::Mat3b>{seen, stages[0], stages[2], stages[4]}, strip_);
}

bool Poster::save(OutputFile& file) const {
  if (scene_.empty()) return false;
  cv::Mat picture = scene_;
  if (!strip_.empty()) cv::vconcat(scene_, strip_, picture);
  file.write(png_of(picture));
  file.commit();
  return true;
}

}  // namespace dodgesim

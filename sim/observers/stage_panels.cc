#include "sim/observers/stage_panels.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <opencv2/imgproc.hpp>

#include "sim/base/error.h"
#include "sim/base/formatted.h"
#include "sim/files/directory.h"
#include "sim/files/output_file.h"
#include "sim/files/png.h"
#include "sim/world/vehicle_parameters.h"

namespace dodgesim {

namespace {

constexpr int kLeastPanelWidth = 320;  // its title is legible

const cv::Vec3b kMarked(255, 255, 255), kUnmarked(0, 0, 0);
const cv::Vec3b kGreen(90, 160, 60), kPurple(170, 60, 130);  // as in the paper's Fig. 4

}  // namespace

void write_caption(cv::Mat3b& image, const std::string& text, int x, int y) {
  cv::putText(image, text, {x, y}, cv::FONT_HERSHEY_SIMPLEX, 0.45, {0, 0, 0}, 3, cv::LINE_AA);
  cv::putText(image, text, {x, y}, cv::FONT_HERSHEY_SIMPLEX, 0.45, {255, 255, 255}, 1, cv::LINE_AA);
}

cv::Mat3b titled_panel(const cv::Mat3b& image, int width, const std::string& title) {
  const double scale = static_cast<double>(width) / image.cols;
  const int height = std::max(1, static_cast<int>(std::lround(scale * image.rows)));
  cv::Mat3b panel;
  cv::resize(image, panel, {width, height}, 0, 0, scale < 1 ? cv::INTER_AREA : cv::INTER_NEAREST);
  write_caption(panel, title, 6, 16);
  return panel;
}

std::vector<cv::Mat3b> stage_panels(const dodge::Dodger& pilot, int camera, int panel_width) {
  const dodge::StageImages& stages = pilot.stage_images(camera);
  if (stages.events.empty()) return {};
  const cv::Size size = stages.events.size();
  cv::Mat3b events(size, kNoEventColour), count(size, kUnmarked), rho(size, kUnmarked),
      cut(size, kUnmarked), found(size, kUnmarked);
  events.setTo(kOffColour, stages.events == 1);
  events.setTo(kOnColour, stages.events == 2);
  count.setTo(kMarked, stages.count > 0);
  cv::Mat1b rho8;  // -0.5 .. 0.5 over the colour map; no event: black
  stages.rho.convertTo(rho8, CV_8U, 255, 127.5);
  cv::Mat3b colours;
  cv::applyColorMap(rho8, colours, cv::COLORMAP_VIRIDIS);
  colours.copyTo(rho, stages.count > 0);
  cut.setTo(kGreen, stages.count > 0);
  cut.setTo(kPurple, stages.threshold_mask);
  found.setTo(kMarked, stages.obstacle_mask);
  for (const dodge::Cluster& cluster : pilot.clusters(camera)) {
    cv::Point2f corners[4];
    cluster.rectangle.points(corners);
    for (int i = 0; i < 4; ++i) {
      cv::line(found, corners[i], corners[(i + 1) % 4], {60, 60, 255}, 1, cv::LINE_AA);
    }
  }
  return {titled_panel(events, panel_width, "events"),
          titled_panel(count, panel_width, "compensated"),
          titled_panel(rho, panel_width, "mean time stamp: yellow is late"),
          titled_panel(cut, panel_width, "threshold: purple is above"),
          titled_panel(found, panel_width, "obstacles")};
}

cv::Mat3b stage_picture(const dodge::Dodger& pilot, TimeUs t_us) {
  cv::Mat3b picture;
  for (int camera = 0; camera < 2; ++camera) {
    const int width = std::max(kLeastPanelWidth, pilot.stage_images(camera).events.cols);
    std::vector<cv::Mat3b> panels = stage_panels(pilot, camera, width);
    if (panels.empty()) continue;  // mono
    write_caption(panels[0],
                  formatted("%s camera, %.3f s", kCameraNames[static_cast<std::size_t>(camera)],
                            seconds(t_us)),
                  6, panels[0].rows - 8);
    cv::Mat3b row;
    cv::hconcat(panels, row);
    if (picture.empty()) {
      picture = row;
    } else {
      cv::vconcat(picture, row, picture);
    }
  }
  return picture;
}

StageFilm::StageFilm(std::string directory) : directory_(std::move(directory)) {
  make_directory(directory_);
  std::vector<std::filesystem::path> earlier;
  std::error_code error;
  for (const auto& entry : std::filesystem::directory_iterator(directory_, error)) {
    const std::string name = entry.path().filename().string();
    if (name.starts_with("stages_") && name.ends_with("_us.png")) earlier.push_back(entry.path());
  }
  if (error) throw IoError(directory_ + " could not be read: " + error.message() + ".");
  for (const std::filesystem::path& file : earlier) remove_file(file);
}

void StageFilm::on_tick(const World& world) { object_in_flight_ = world.snapshot().any_launched(); }

void StageFilm::on_dodger_cycle(TimeUs now_us, const dodge::Dodger& dodger) {
  if (!object_in_flight_) return;
  write_file(directory_ + formatted("/stages_%09.0f_us.png", static_cast<double>(now_us)),
             png_of(stage_picture(dodger, now_us)));
  ++pictures_;
}

}  // namespace dodgesim

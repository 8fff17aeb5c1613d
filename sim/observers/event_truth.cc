#include "sim/observers/event_truth.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "sim/base/error.h"

namespace dodgesim {

namespace {

bool covers(const cv::RotatedRect& rectangle, double x, double y) {
  const double angle = rectangle.angle * std::numbers::pi / 180;
  const double dx = x - rectangle.center.x, dy = y - rectangle.center.y;
  return std::abs(dx * std::cos(angle) + dy * std::sin(angle)) <= 0.5 * rectangle.size.width &&
         std::abs(dy * std::cos(angle) - dx * std::sin(angle)) <= 0.5 * rectangle.size.height;
}

bool same(const dodge::Event& a, const Event& b) {
  return a.t_us == b.t_us && a.x == b.x && a.y == b.y && a.polarity == b.polarity;
}

}  // namespace

void EventTruth::on_tick(const World& world) {
  object_in_flight_ = world.snapshot().any_launched();
}

void EventTruth::on_events(int camera, const Packet& packet) {
  auto& sent = sent_.at(static_cast<std::size_t>(camera));
  for (std::size_t i = 0; i < packet.events.size(); ++i) {
    sent.push_back({packet.events[i], packet.causes[i]});
  }
}

void EventTruth::on_dodger_cycle(TimeUs now_us, const dodge::Dodger& dodger) {
  for (std::size_t camera = 0; camera < windows_.size(); ++camera) label_window(camera, dodger);
  if (!object_in_flight_) return;
  EventTruthRow row{0, now_us, evading_, {}};
  for (const auto& window : windows_) {
    for (const WindowEvent& event : window) {
      ++row.counts.events;
      row.counts.object_events += of_object(event.cause) ? 1 : 0;
      row.counts.found_events += event.found ? 1 : 0;
      row.counts.found_object_events += event.found && of_object(event.cause) ? 1 : 0;
    }
  }
  rows_.push_back(row);
}

void EventTruth::label_window(std::size_t camera, const dodge::Dodger& dodger) {
  const int index = static_cast<int>(camera);
  const dodge::StageImages& stages = dodger.stage_images(index);
  auto& sent = sent_[camera];
  auto& window = windows_[camera];
  window.clear();
  if (stages.window.empty()) return;
  while (!sent.empty() && sent.front().event.t_us < stages.window.front().event.t_us) {
    sent.pop_front();
  }
  auto known = sent.begin();
  for (const dodge::CompensatedEvent& compensated : stages.window) {
    while (known != sent.end() && !same(compensated.event, known->event)) ++known;
    if (known == sent.end()) {
      throw SimulationError("The pilot's window holds an event that no camera has sent.");
    }
    WindowEvent event{known->event.t_us, known->cause, compensated.pixel, false};
    ++known;
    if (event.pixel >= 0) {
      const int x = event.pixel % stages.obstacle_mask.cols;
      const int y = event.pixel / stages.obstacle_mask.cols;
      const auto& clusters = dodger.clusters(index);
      event.found = stages.obstacle_mask(y, x) != 0 &&
                    std::ranges::any_of(clusters, [&](const auto& cluster) {
                      return covers(cluster.rectangle, x, y);
                    });
    }
    window.push_back(event);
  }
}

}  // namespace dodgesim

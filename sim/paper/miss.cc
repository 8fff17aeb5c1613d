#include "sim/paper/miss.h"

#include <algorithm>

#include "sim/flight/setup.h"

namespace dodgesim {

namespace {

dodge::DepthConfig without_limits(dodge::DepthConfig config) {
  config.min_range_m = config.min_size_m = 0;
  config.max_range_m = config.max_size_m = 1e6;
  return config;
}

// Whether a pixel of one camera lies on the object's outline.
bool on_outline(const ObjectView& view, const Intrinsics& intrinsics, double x, double y) {
  const Eigen::Vector3d ray_C((x - intrinsics.cx()) / intrinsics.f,
                              (y - intrinsics.cy()) / intrinsics.f, 1);
  return dodgesim::on_outline(view, view.X_WC * ray_C);
}

Miss miss_of(const ObservedCycle& cycle, const dodge::DepthConfig& limits, int min_events) {
  const bool stereo = limits.stereo_depth();
  if (cycle.location) {
    const ObservedCycle::Location& found = *cycle.location;
    if (found.range_m < limits.min_range_m || found.range_m > limits.max_range_m)
      return Miss::kRange;
    if (found.size_m < limits.min_size_m || found.size_m > limits.max_size_m) return Miss::kSize;
    return Miss::kElsewhere;
  }
  const int seen_by = (cycle.clusters[0] > 0 ? 1 : 0) + (cycle.clusters[1] > 0 ? 1 : 0);
  if (stereo && seen_by == 2) return Miss::kNoMatch;
  if (stereo && seen_by == 1) return Miss::kOneCamera;
  const int events = stereo ? std::min(cycle.events[0], cycle.events[1]) : cycle.events[0];
  return events < min_events ? Miss::kFewEvents : Miss::kNoCluster;
}

}  // namespace

std::string miss_text(Miss miss) {
  constexpr const char* kTexts[] = {"too few events",
                                    "no cluster",
                                    "cluster in one camera only",
                                    "no stereo match",
                                    "located beyond the limits of distance",
                                    "located with a size beyond the limits",
                                    "located, but at another instant or place"};
  return kTexts[static_cast<std::size_t>(miss)];
}

Miss miss_of(std::span<const ObservedCycle> cycles, const dodge::DepthConfig& limits,
             int min_events) {
  Miss best = Miss::kFewEvents;
  for (const auto& cycle : cycles) best = std::max(best, miss_of(cycle, limits, min_events));
  return best;
}

MissObserver::MissObserver(const Scenario& scenario)
    : scenario_(scenario), rig_(camera_rig(scenario)) {}

void MissObserver::on_tick(const World& world) {
  truth_.on_tick(world);
  if (!unlimited_) {
    const std::vector<dodge::CameraModel> cameras = camera_models(scenario_, world.vehicle());
    unlimited_.emplace(without_limits(scenario_.dodger.position), cameras,
                       scenario_.dodger.window.window_us, scenario_.dodger.cluster.max_groups);
    radius_m_ = world.object(0).bounding_radius_m;
  }
  history_.add(world.snapshot());
}

std::optional<Snapshot> MissObserver::state_at(TimeUs t_us) const {
  std::optional<Snapshot> state = history_.at(t_us);
  return state && state->launched.front() ? state : std::nullopt;
}

ObjectView MissObserver::view(const Snapshot& state, std::size_t camera) const {
  const CameraRig one{rig_.intrinsics, {rig_.X_BC[camera]}};
  return view_of(one, state.vehicle.pose(), state.objects.front().p_W, radius_m_);
}

// The pilot's window ends with the newest packet that has come through the cable.
void MissObserver::on_dodger_cycle(TimeUs now_us, const dodge::Dodger& dodger) {
  truth_.on_dodger_cycle(now_us, dodger);
  const std::optional<Snapshot> state = state_at(scenario_.delays.newest_packet_end_us(now_us));
  if (!state) return;
  ObservedCycle cycle;
  const ObjectView both =
      view_of(rig_, state->vehicle.pose(), state->objects.front().p_W, radius_m_);
  cycle.t_us = state->t_us;
  cycle.range_m = both.range_m();
  cycle.centre_in_view = both.centre_in_view;
  for (std::size_t i = 0; i < rig_.X_BC.size(); ++i) {
    const int camera = static_cast<int>(i);
    const auto& window = truth_.window(camera);
    cycle.events[i] = static_cast<int>(
        std::ranges::count_if(window, [](const WindowEvent& e) { return of_object(e.cause); }));
    const ObjectView one = view(*state, i);
    for (const dodge::Cluster& cluster : dodger.clusters(camera)) {
      const cv::Point2f middle = cluster.rectangle.center;
      if (on_outline(one, rig_.intrinsics, middle.x, middle.y)) ++cycle.clusters[i];
    }
  }
  cycle.location = locate(*state, dodger);
  cycles_.push_back(cycle);
}

std::optional<ObservedCycle::Location> MissObserver::locate(const Snapshot& state,
                                                            const dodge::Dodger& pilot) {
  std::vector<dodge::View> views;
  for (std::size_t i = 0; i < rig_.X_BC.size(); ++i) {
    const int camera = static_cast<int>(i);
    views.push_back({&pilot.clusters(camera), &pilot.stage_images(camera).averaged});
  }
  dodge::StateEstimate truth;
  truth.t_us = state.t_us;
  truth.p_WB = state.vehicle.p_W;
  truth.q_WB = state.vehicle.q_W;
  truth.v_WB = state.vehicle.v_W;
  std::vector<dodge::Detection> located;
  unlimited_->locate(views, truth, located);

  std::optional<ObservedCycle::Location> best;
  double best_error_m = 0;
  for (const dodge::Detection& detection : located) {
    const std::optional<Snapshot> then = state_at(detection.t_us);
    if (!then) continue;
    const ObjectView seen = view(*then, 0);
    if (!dodgesim::on_outline(seen, detection.centre_W)) continue;
    const double error_m = (detection.centre_W - then->objects.front().p_W).norm();
    if (best && error_m >= best_error_m) continue;
    best_error_m = error_m;
    best = {(detection.centre_W - seen.X_WC.translation()).norm(), detection.size_m};
  }
  return best;
}

}  // namespace dodgesim

#include "sim/flight/event_rig.h"

#include <algorithm>
#include <cstddef>

#include "sim/base/wall_clock.h"
#include "sim/events/event_hash.h"
#include "sim/render/flicker.h"

namespace dodgesim {

namespace {

std::vector<double> object_radii(const World& world) {
  std::vector<double> radii;
  radii.reserve(static_cast<std::size_t>(world.object_count()));
  for (int i = 0; i < world.object_count(); ++i) {
    radii.push_back(world.object(i).bounding_radius_m);
  }
  return radii;
}

// Often enough for the flicker of the light, too.
SamplingSpec sampling_of(const EventRigSetup& setup) {
  SamplingSpec sampling = setup.sampling;
  sampling.min_rate_hz = std::max(sampling.min_rate_hz, flicker_sampling_hz(setup.render.flicker));
  return sampling;
}

}  // namespace

// One camera.
struct EventRig::Eye {
  Eye(const World& world, const EventRigSetup& setup, int camera)
      : index(camera),
        X_BC(world.vehicle().X_BC.at(static_cast<std::size_t>(camera))),
        sampler(sampling_of(setup), setup.intrinsics, X_BC, object_radii(world)),
        pixels(setup.events, setup.intrinsics.width, setup.intrinsics.height, setup.seed,
               setup.throw_index, kCameraNames.at(static_cast<std::size_t>(camera)),
               setup.keep_causes),
        packets(setup.packet_us),
        view(setup.intrinsics, setup.keys),
        luminance(static_cast<std::size_t>(setup.intrinsics.width) *
                  static_cast<std::size_t>(setup.intrinsics.height)) {}

  int index;
  Eigen::Isometry3d X_BC;
  Sampler sampler;
  EventCamera pixels;
  Packetizer packets;
  KeyedView view;                                         // of the static scene
  StaticDistances distances{0};                           // as in the last whole picture
  Eigen::Vector3d seen_from_W = Eigen::Vector3d::Zero();  // by that picture
  std::vector<float> luminance;
  EventHash hash;
  std::int64_t count = 0;
};

EventRig::EventRig(const World& world, const EventRigSetup& setup)
    : world_(world),
      setup_(setup),
      renderer_(world, setup.intrinsics, setup.render),
      flicker_phase_rad_(flicker_phase_rad(setup.seed, setup.throw_index)) {
  for (int i = 0; i < setup.cameras; ++i) {
    eyes_.push_back(std::make_unique<Eye>(world, setup, i));
  }
  region_luminance_.resize(eyes_.front()->luminance.size());
  if (setup.keep_causes) {
    object_ids_.resize(region_luminance_.size());
    cause_.resize(region_luminance_.size());
  }
}

EventRig::~EventRig() = default;

// A region of what the camera sees.
void EventRig::show(Eye& eye, const Snapshot& snapshot, const Rect& region,
                    std::vector<float>& luminance) {
  const auto start = WallClock::now();
  const Eigen::Isometry3d X_WC = snapshot.vehicle.pose() * eye.X_BC;
  eye.view.show(renderer_, X_WC, region, luminance.data());
  if (setup_.keep_causes) clear_causes(region);
  draw_objects(eye, snapshot, X_WC, region, luminance);
  flicker(snapshot.t_us, region, luminance);
  render_s_ += seconds_since(start);
}

// The light of the instant on a part of the view that was drawn in the mean light.
void EventRig::flicker(TimeUs t_us, const Rect& region, std::vector<float>& luminance) const {
  if (setup_.render.flicker.flicker_hz <= 0) return;
  const auto factor =
      static_cast<float>(flicker_factor(setup_.render.flicker, flicker_phase_rad_, t_us));
  for (std::ptrdiff_t y = region.y0; y < region.y1; ++y) {
    const auto row = luminance.begin() + y * setup_.intrinsics.width;
    std::for_each(row + region.x0, row + region.x1, [factor](float& light) { light *= factor; });
  }
}

// Draws the objects over a picture of the static scene.
void EventRig::draw_objects(Eye& eye, const Snapshot& snapshot, const Eigen::Isometry3d& X_WC,
                            const Rect& region, std::vector<float>& luminance) {
  Rect part;
  double farthest_m = 0;
  for (std::size_t i = 0; i < snapshot.objects.size(); ++i) {
    const Rect outline = intersection(eye.sampler.outline(snapshot, i), region);
    if (outline.empty()) continue;
    part = merged(part, outline);
    const double distance_m = (snapshot.objects[i].p_W - X_WC.translation()).norm();
    const double radius_m = world_.object(static_cast<int>(i)).bounding_radius_m;
    farthest_m = std::max(farthest_m, distance_m + radius_m);
  }
  if (part.empty()) return;
  const bool behind_static = farthest_m > eye.view.nearest_m(part);
  renderer_.draw_objects(snapshot, X_WC, part, behind_static, luminance.data(),
                         setup_.keep_causes ? object_ids_.data() : nullptr);
  if (setup_.keep_causes) mark_objects(part, snapshot, X_WC.translation());
}

void EventRig::clear_causes(const Rect& region) {
  for (std::ptrdiff_t y = region.y0; y < region.y1; ++y) {
    const auto row = cause_.begin() + y * setup_.intrinsics.width;
    std::fill(row + region.x0, row + region.x1, kCauseScene);
  }
}

// What an object lights in part shows it, too: the pixels beside those whose centres it covers. Of
// several objects beside a pixel it is the nearest to the camera.
void EventRig::mark_objects(const Rect& part, const Snapshot& snapshot,
                            const Eigen::Vector3d& camera_W) {
  const std::ptrdiff_t width = setup_.intrinsics.width;
  const auto id_at = [&](int x, int y) {
    return object_ids_[static_cast<std::size_t>(y * width + x)];
  };
  const auto distance_m = [&](std::int32_t id) {
    return (snapshot.objects[static_cast<std::size_t>(id - 1)].p_W - camera_W).norm();
  };
  const auto nearest_beside = [&](int x, int y) {
    std::int32_t nearest = 0;
    for (int v = std::max(y - 1, part.y0); v < std::min(y + 2, part.y1); ++v) {
      for (int u = std::max(x - 1, part.x0); u < std::min(x + 2, part.x1); ++u) {
        const std::int32_t id = id_at(u, v);
        if (id < 1 || id == nearest) continue;
        if (nearest == 0 || distance_m(id) < distance_m(nearest)) nearest = id;
      }
    }
    return nearest;
  };
  for (int y = part.y0; y < part.y1; ++y) {
    for (int x = part.x0; x < part.x1; ++x) {
      const std::int32_t id = id_at(x, y) > 0 ? id_at(x, y) : nearest_beside(x, y);
      cause_[static_cast<std::size_t>(y * width + x)] =
          id < 1 ? kCauseScene : static_cast<Cause>(std::min<int>(id, kCauseLastObject));
    }
  }
}

Picture EventRig::picture(const std::vector<float>& luminance) const {
  return {luminance.data(), setup_.keep_causes ? cause_.data() : nullptr};
}

void EventRig::start() {
  const Snapshot& now = world_.snapshot();
  for (auto& eye : eyes_) {
    show_whole(*eye, now);
    eye->pixels.reset(now.t_us, picture(eye->luminance));
    eye->sampler.reset(now.t_us);
    eye->packets.reset();
  }
}

void EventRig::rebase() {
  for (auto& eye : eyes_) {
    show_whole(*eye, world_.snapshot());
    eye->pixels.rebase(picture(eye->luminance));
  }
}

void EventRig::require(TimeUs t_us) {
  for (auto& eye : eyes_) eye->sampler.require(t_us);
}

void EventRig::advance(const Snapshot& a, const Snapshot& b, const Sink& sink) {
  for (auto& eye : eyes_) {
    samples_.clear();
    eye->sampler.advance(a, b, distances_until(*eye, a, b), samples_);
    for (const Sample& sample : samples_) {
      const Snapshot now = interpolate(a, b, sample.t_us);
      const Rect region = eye->sampler.region(sample, now);
      if (sample.object != Sample::kWholeImage && !setup_.whole_pictures) {
        if (!region.empty()) take_region(*eye, now, region);
        continue;
      }
      take_picture(*eye, now);
      while (const std::optional<Packet> packet = eye->packets.take()) sink(eye->index, *packet);
    }
  }
}

// How near the static scene is to the camera between a and b.
StaticDistances EventRig::distances_until(const Eye& eye, const Snapshot& a,
                                          const Snapshot& b) const {
  StaticDistances distances = eye.distances;
  double moved_m = 0;
  for (const Snapshot* now : {&a, &b}) {
    const Eigen::Vector3d p_W = now->vehicle.pose() * eye.X_BC.translation();
    moved_m = std::max(moved_m, (p_W - eye.seen_from_W).norm());
  }
  for (double& distance_m : distances.m) distance_m -= moved_m;
  return distances;
}

// Shows the whole picture of an instant, and keeps how near what it shows is.
void EventRig::show_whole(Eye& eye, const Snapshot& snapshot) {
  show(eye, snapshot, whole(), eye.luminance);
  for (int row = 0; row < StaticDistances::kRows; ++row) {
    for (int column = 0; column < StaticDistances::kColumns; ++column) {
      const Rect part = StaticDistances::part(setup_.intrinsics, column, row);
      eye.distances.at(column, row) = eye.view.nearest_m(part);
    }
  }
  eye.seen_from_W = snapshot.vehicle.pose() * eye.X_BC.translation();
}

void EventRig::take_region(Eye& eye, const Snapshot& snapshot, const Rect& region) {
  show(eye, snapshot, region, region_luminance_);
  ++regions_;
  const auto start = WallClock::now();
  eye.pixels.add_region(snapshot.t_us, region, picture(region_luminance_));
  emulate_s_ += seconds_since(start);
}

void EventRig::take_picture(Eye& eye, const Snapshot& snapshot) {
  show_whole(eye, snapshot);
  ++pictures_;
  const auto start = WallClock::now();
  events_.clear();
  eye.pixels.update(snapshot.t_us, picture(eye.luminance), events_);
  eye.hash.add(events_);
  eye.count += static_cast<std::int64_t>(events_.size());
  eye.packets.push(events_, snapshot.t_us, eye.pixels.causes());
  emulate_s_ += seconds_since(start);
}

std::int64_t EventRig::keys() const {
  std::int64_t drawn = 0;
  for (const auto& eye : eyes_) drawn += eye->view.drawn();
  return drawn;
}

std::int64_t EventRig::event_count(int camera) const {
  const auto i = static_cast<std::size_t>(camera);
  return i < eyes_.size() ? eyes_[i]->count : 0;
}

std::int64_t EventRig::lost_count(int camera) const {
  const auto i = static_cast<std::size_t>(camera);
  return i < eyes_.size() ? eyes_[i]->pixels.lost() : 0;
}

std::uint64_t EventRig::events_hash() const {
  std::uint64_t hash = 0;
  for (const auto& eye : eyes_) hash = hash * 1099511628211u + eye->hash.value();
  return hash;
}

const std::vector<float>& EventRig::luminance(int camera) const {
  return eyes_.at(static_cast<std::size_t>(camera))->luminance;
}

}  // namespace dodgesim

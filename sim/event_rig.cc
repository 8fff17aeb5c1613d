#include "sim/event_rig.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <stdexcept>
#include <string>

#include "sim/base/random.h"
#include "sim/events/event_log.h"
#include "sim/world/view_distance.h"

namespace dodgesim {

namespace {

using WallClock = std::chrono::steady_clock;

double seconds_since(WallClock::time_point start) {
  return std::chrono::duration<double>(WallClock::now() - start).count();
}

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

// The camera names that the noise streams carry.
std::string camera_name(int camera) { return camera == 0 ? "top" : "bottom"; }

}  // namespace

// A sample that waits until it can be shown.
struct EventRig::Look {
  Sample sample;
  Snapshot snapshot;  // of the sample's instant
};

// One camera.
struct EventRig::Eye {
  Eye(const World& world, const EventRigSetup& setup, int camera)
      : index(camera),
        X_BC(world.vehicle().X_BC.at(static_cast<std::size_t>(camera))),
        sampler(sampling_of(setup), setup.intrinsics, X_BC, object_radii(world)),
        pixels(setup.events, setup.intrinsics.width, setup.intrinsics.height, setup.seed,
               setup.throw_index, camera_name(camera)),
        packets(setup.packet_us),
        view(setup.intrinsics),
        before(setup.intrinsics, max_turn_px(setup)),
        now(setup.intrinsics, max_turn_px(setup)),
        luminance(static_cast<std::size_t>(setup.intrinsics.width) *
                  static_cast<std::size_t>(setup.intrinsics.height)) {}

  static int max_turn_px(const EventRigSetup& setup) {
    return static_cast<int>(std::ceil(setup.sampling.max_turn_px));
  }

  int index;
  Eigen::Isometry3d X_BC;
  Sampler sampler;
  EventCamera pixels;
  Packetizer packets;
  ViewDistance view;
  TurnedPicture before, now;  // the static scene at the last two keys
  TimeUs before_us = 0, now_us = 0;
  std::vector<Look> looks;  // not yet taken
  std::vector<float> luminance;
  EventHash hash;
  std::int64_t count = 0;
};

EventRig::EventRig(const World& world, const EventRigSetup& setup)
    : world_(world),
      setup_(setup),
      renderer_(world, TurnedPicture(setup.intrinsics, Eye::max_turn_px(setup)).intrinsics(),
                setup.render),
      flicker_phase_rad_(2 * std::numbers::pi *
                         RandomStream(setup.seed, setup.throw_index, "flicker").uniform()) {
  for (int i = 0; i < setup.cameras; ++i) {
    eyes_.push_back(std::make_unique<Eye>(world, setup, i));
  }
  region_luminance_.resize(eyes_.front()->luminance.size());
  const Intrinsics& wide = eyes_.front()->now.intrinsics();
  drawn_luminance_.resize(static_cast<std::size_t>(wide.width) *
                          static_cast<std::size_t>(wide.height));
}

EventRig::~EventRig() = default;

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

// A part of the view as it is, objects and all.
void EventRig::draw_region(const Eye& eye, const Snapshot& snapshot, const Rect& region,
                           std::vector<float>& luminance) {
  const int margin = eye.now.margin_px();
  const Rect part = {region.x0 + margin, region.y0 + margin, region.x1 + margin,
                     region.y1 + margin};
  renderer_.render(snapshot, snapshot.vehicle.pose() * eye.X_BC, part, drawn_luminance_.data(),
                   nullptr);
  const std::ptrdiff_t stride = eye.now.intrinsics().width;
  for (std::ptrdiff_t y = region.y0; y < region.y1; ++y) {
    std::copy_n(drawn_luminance_.begin() + (y + margin) * stride + part.x0, region.x1 - region.x0,
                luminance.begin() + y * setup_.intrinsics.width + region.x0);
  }
}

// Draws the objects over a picture of the static scene.
void EventRig::draw_objects(Eye& eye, const Snapshot& snapshot) {
  for (std::size_t i = 0; i < snapshot.objects.size(); ++i) {
    const Rect outline = eye.sampler.outline(snapshot, i);
    if (!outline.empty()) draw_region(eye, snapshot, outline, eye.luminance);
  }
}

// Draws the static scene of a key.
void EventRig::draw_key(Eye& eye, const Snapshot& snapshot) {
  const auto start = WallClock::now();
  std::swap(eye.before, eye.now);
  eye.before_us = eye.now_us;
  eye.now_us = snapshot.t_us;
  still_ = snapshot;
  still_.launched.assign(snapshot.launched.size(), false);
  const Eigen::Isometry3d X_WC = snapshot.vehicle.pose() * eye.X_BC;
  const Intrinsics& wide = eye.now.intrinsics();
  renderer_.render(still_, X_WC, {0, 0, wide.width, wide.height}, drawn_luminance_.data(), nullptr);
  eye.now.set(X_WC.linear(), drawn_luminance_);
  ++drawn_;
  render_s_ += seconds_since(start);
}

// The whole picture as it is at the last key, or follows from it alone.
void EventRig::show_last(Eye& eye, const Snapshot& snapshot) {
  const auto start = WallClock::now();
  if (snapshot.t_us == eye.now_us) {
    eye.now.copy_view(eye.luminance);
  } else {
    const Eigen::Isometry3d X_WC = snapshot.vehicle.pose() * eye.X_BC;
    turn(setup_.intrinsics, eye.now, X_WC.linear(), eye.luminance);
    ++turned_;
  }
  draw_objects(eye, snapshot);
  flicker(snapshot.t_us, whole(), eye.luminance);
  render_s_ += seconds_since(start);
}

// The whole picture of an instant between the last two keys.
void EventRig::show_between(Eye& eye, const Snapshot& snapshot) {
  const auto start = WallClock::now();
  const Eigen::Isometry3d X_WC = snapshot.vehicle.pose() * eye.X_BC;
  const double share = static_cast<double>(snapshot.t_us - eye.before_us) /
                       static_cast<double>(eye.now_us - eye.before_us);
  blend_turned(setup_.intrinsics, eye.before, eye.now, X_WC.linear(), share, region_luminance_,
               eye.luminance);
  draw_objects(eye, snapshot);
  flicker(snapshot.t_us, whole(), eye.luminance);
  ++turned_;
  render_s_ += seconds_since(start);
}

void EventRig::start() {
  const Snapshot& now = world_.snapshot();
  for (auto& eye : eyes_) {
    draw_key(*eye, now);
    show_last(*eye, now);
    eye->pixels.reset(now.t_us, eye->luminance.data());
    eye->sampler.reset(now.t_us);
    eye->packets.reset();
    eye->looks.clear();
  }
}

void EventRig::rebase() {
  for (auto& eye : eyes_) {
    if (!eye->looks.empty()) {
      throw std::logic_error("Event cameras are rebased at an instant that was required.");
    }
    show_last(*eye, world_.snapshot());
    eye->pixels.rebase(eye->luminance.data());
  }
}

void EventRig::require(TimeUs t_us) {
  for (auto& eye : eyes_) eye->sampler.require(t_us);
}

void EventRig::advance(const Snapshot& a, const Snapshot& b, const Sink& sink) {
  for (auto& eye : eyes_) {
    samples_.clear();
    eye->sampler.advance(a, b, eye->view.nearest_m(world_, b, eye->X_BC), samples_);
    for (const Sample& sample : samples_) {
      eye->looks.push_back({sample, interpolate(a, b, sample.t_us)});
      if (sample.is_key() || sample.due) take_looks(*eye, sink);
    }
  }
}

// Takes the samples that have waited for the last of them.
void EventRig::take_looks(Eye& eye, const Sink& sink) {
  const bool key = eye.looks.back().sample.is_key();
  if (key) draw_key(eye, eye.looks.back().snapshot);
  for (const Look& look : eye.looks) {
    const Rect region = eye.sampler.region(look.sample, look.snapshot);
    if (look.sample.object != Sample::kWholeImage) {
      if (!region.empty()) take_region(eye, region, look.snapshot);
      continue;
    }
    if (key && look.sample.turned) {
      show_between(eye, look.snapshot);
    } else {
      show_last(eye, look.snapshot);
    }
    take_picture(eye, look.sample.t_us);
    while (const std::optional<Packet> packet = eye.packets.take()) sink(eye.index, *packet);
  }
  eye.looks.clear();
}

void EventRig::take_region(Eye& eye, const Rect& region, const Snapshot& snapshot) {
  auto start = WallClock::now();
  draw_region(eye, snapshot, region, region_luminance_);
  flicker(snapshot.t_us, region, region_luminance_);
  ++regions_;
  render_s_ += seconds_since(start);
  start = WallClock::now();
  eye.pixels.add_region(snapshot.t_us, region, region_luminance_.data());
  emulate_s_ += seconds_since(start);
}

void EventRig::take_picture(Eye& eye, TimeUs t_us) {
  const auto start = WallClock::now();
  events_.clear();
  eye.pixels.update(t_us, eye.luminance.data(), events_);
  eye.hash.add(events_);
  eye.count += static_cast<std::int64_t>(events_.size());
  eye.packets.push(events_, t_us);
  emulate_s_ += seconds_since(start);
}

std::int64_t EventRig::event_count(int camera) const {
  const auto i = static_cast<std::size_t>(camera);
  return i < eyes_.size() ? eyes_[i]->count : 0;
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

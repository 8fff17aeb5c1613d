#include "sim/event_rig.h"

#include <chrono>
#include <string>

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
  for (int i = 0; i < world.object_count(); ++i) {
    radii.push_back(world.object(i).bounding_radius_m);
  }
  return radii;
}

// The camera names that the noise streams carry.
std::string camera_name(int camera) { return camera == 0 ? "top" : "bottom"; }

}  // namespace

// One camera.
struct EventRig::Eye {
  Eye(const World& world, const EventRigSetup& setup, int camera)
      : index(camera),
        X_BC(world.vehicle().X_BC.at(static_cast<std::size_t>(camera))),
        sampler(setup.sampling, setup.intrinsics, X_BC, object_radii(world)),
        pixels(setup.events, setup.intrinsics.width, setup.intrinsics.height, setup.seed,
               setup.throw_index, camera_name(camera)),
        packets(setup.packet_us),
        view(setup.intrinsics),
        luminance(static_cast<std::size_t>(setup.intrinsics.width) *
                  static_cast<std::size_t>(setup.intrinsics.height)) {}

  int index;
  Eigen::Isometry3d X_BC;
  Sampler sampler;
  EventCamera pixels;
  Packetizer packets;
  ViewDistance view;
  std::vector<float> luminance;
  EventHash hash;
  std::int64_t count = 0;
};

EventRig::EventRig(const World& world, const EventRigSetup& setup)
    : world_(world),
      setup_(setup),
      renderer_(world, setup.intrinsics, setup.render),
      region_luminance_(static_cast<std::size_t>(setup.intrinsics.width) *
                        static_cast<std::size_t>(setup.intrinsics.height)) {
  for (int i = 0; i < setup.cameras; ++i) {
    eyes_.push_back(std::make_unique<Eye>(world, setup, i));
  }
}

EventRig::~EventRig() = default;

void EventRig::draw(const Eye& eye, const Snapshot& snapshot, const Rect& region,
                    std::vector<float>& luminance) {
  const auto start = WallClock::now();
  renderer_.render(snapshot, snapshot.vehicle.pose() * eye.X_BC, region, luminance.data(), nullptr);
  render_s_ += seconds_since(start);
}

void EventRig::draw(Eye& eye, const Snapshot& snapshot) {
  draw(eye, snapshot, {0, 0, setup_.intrinsics.width, setup_.intrinsics.height}, eye.luminance);
  ++frames_;
}

void EventRig::start() {
  const Snapshot& now = world_.snapshot();
  for (auto& eye : eyes_) {
    draw(*eye, now);
    eye->pixels.reset(now.t_us, eye->luminance.data());
    eye->sampler.reset(now.t_us);
    eye->packets.reset();
  }
}

void EventRig::rebase() {
  for (auto& eye : eyes_) {
    draw(*eye, world_.snapshot());
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
      look(*eye, sample, interpolate(a, b, sample.t_us));
      while (const std::optional<Packet> packet = eye->packets.take()) sink(eye->index, *packet);
    }
  }
}

// Takes a sample.
void EventRig::look(Eye& eye, const Sample& sample, const Snapshot& snapshot) {
  const Rect region = eye.sampler.region(sample, snapshot);
  if (region.empty()) return;
  if (sample.object != Sample::kWholeImage) {
    draw(eye, snapshot, region, region_luminance_);
    ++regions_;
    const auto start = WallClock::now();
    eye.pixels.add_region(sample.t_us, region, region_luminance_.data());
    emulate_s_ += seconds_since(start);
    return;
  }
  draw(eye, snapshot);
  const auto start = WallClock::now();
  events_.clear();
  eye.pixels.update(sample.t_us, eye.luminance.data(), events_);
  eye.hash.add(events_);
  eye.count += static_cast<std::int64_t>(events_.size());
  eye.packets.push(events_, sample.t_us);
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

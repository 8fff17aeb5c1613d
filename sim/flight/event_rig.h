// The vehicle's event cameras: decides when each looks, shows it what there is to see, turns that
// into events and packs them for the USB link.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <vector>

#include "sim/events/event_camera.h"
#include "sim/events/packetizer.h"
#include "sim/events/sampler.h"
#include "sim/render/keyed_view.h"
#include "sim/render/luminance_renderer.h"
#include "sim/world/world.h"

namespace dodgesim {

struct EventRigSetup {
  Intrinsics intrinsics;
  RenderSpec render;
  KeySpec keys;
  EventCameraSpec events;
  SamplingSpec sampling;
  TimeUs packet_us = 1000;
  bool keep_causes = false;     // packets say why each event happened; the events are the same
  bool whole_pictures = false;  // for comparison: objects' regions are taken as whole pictures
  int cameras = 2;              // the first of the vehicle's
  std::uint64_t seed = 1;
  std::uint64_t throw_index = 0;
};

class EventRig {
 public:
  // What is done with a packet of events, at the instant at which it is complete.
  using Sink = std::function<void(int camera, const Packet& packet)>;

  // The world must outlive the rig.
  EventRig(const World& world, const EventRigSetup& setup);
  ~EventRig();

  // The first picture, of the world as it is: references are set, no events.
  void start();

  // The world has changed at the instant of the last sample, which was required, without any motion
  // (a thrown object has come into existence): no events either.
  void rebase();

  // Asks for a sample of every camera at t_us, which lies in the future.
  void require(TimeUs t_us);

  // Everything that the cameras see from `a` to `b`, one tick later.
  void advance(const Snapshot& a, const Snapshot& b, const Sink& sink);

  std::int64_t event_count(int camera) const;
  std::int64_t lost_count(int camera) const;           // events that the saturated readout lost
  std::uint64_t events_hash() const;                   // of all events of all cameras
  std::int64_t keys() const;                           // pictures of the room that were drawn
  std::int64_t pictures() const { return pictures_; }  // whole pictures that were shown
  std::int64_t regions() const { return regions_; }    // pictures of an object's region only
  double render_s() const { return render_s_; }        // wall clock, for reports only
  double emulate_s() const { return emulate_s_; }      // wall clock, for reports only

  // The last whole picture of a camera: width x height, linear luminance.
  const std::vector<float>& luminance(int camera) const;

 private:
  struct Eye;

  void show(Eye& eye, const Snapshot& snapshot, const Rect& region, std::vector<float>& luminance);
  void show_whole(Eye& eye, const Snapshot& snapshot);
  StaticDistances distances_until(const Eye& eye, const Snapshot& a, const Snapshot& b) const;
  void draw_objects(Eye& eye, const Snapshot& snapshot, const Eigen::Isometry3d& X_WC,
                    const Rect& region, std::vector<float>& luminance);
  void flicker(TimeUs t_us, const Rect& region, std::vector<float>& luminance) const;
  void clear_causes(const Rect& region);
  void mark_objects(const Rect& part, const Snapshot& snapshot, const Eigen::Vector3d& camera_W);
  Picture picture(const std::vector<float>& luminance) const;
  void take_picture(Eye& eye, const Snapshot& snapshot);
  void take_region(Eye& eye, const Snapshot& snapshot, const Rect& region);
  Rect whole() const { return {0, 0, setup_.intrinsics.width, setup_.intrinsics.height}; }

  const World& world_;
  EventRigSetup setup_;
  LuminanceRenderer renderer_;
  std::vector<std::unique_ptr<Eye>> eyes_;
  std::vector<Sample> samples_;
  std::vector<float> region_luminance_;   // width x height
  std::vector<std::int32_t> object_ids_;  // of the last picture, width x height
  std::vector<Cause> cause_;              // of the last picture, width x height
  std::vector<Event> events_;
  double flicker_phase_rad_;
  std::int64_t pictures_ = 0;
  std::int64_t regions_ = 0;
  double render_s_ = 0;
  double emulate_s_ = 0;
};

}  // namespace dodgesim

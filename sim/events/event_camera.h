// The event camera: turns luminance pictures into events. Its pixels (pixel_array.h) see the
// pictures and make events; so does the noise (noise.h); the readout (readout.h) gives them their
// time stamps.
//
// A sample is a whole picture or, in between, a region of one: only the pixels in it then have a
// sample.
#pragma once

#include <cstdint>
#include <string_view>
#include <vector>

#include "sim/base/time.h"
#include "sim/camera/camera.h"
#include "sim/events/cause.h"
#include "sim/events/event.h"
#include "sim/events/event_words.h"
#include "sim/events/noise.h"
#include "sim/events/pixel_array.h"
#include "sim/events/readout.h"
#include "sim/events/spec.h"
#include "sim/events/thresholds.h"

namespace dodgesim {

class EventCamera {
 public:
  static constexpr int kMaxSide = EventWords::kMaxSide;                 // of the image [px]
  static constexpr TimeUs kMaxIntervalUs = EventWords::kMaxTimeUs / 2;  // between two pictures

  // `name` tells the cameras of a vehicle apart. With `keep_causes`, every picture must say what
  // its pixels show, and causes() says why events happened. Throws std::invalid_argument for an
  // empty or too large picture.
  EventCamera(const EventCameraSpec& spec, int width, int height, std::uint64_t seed,
              std::uint64_t throw_index, std::string_view name, bool keep_causes = false);

  // The first picture, of the instant t_us: sets every reference to its signal or, with
  // a leak, as after a long rest.
  // Pictures: width x height, row-major from the top left, linear luminance, finite and >= 0.
  void reset(TimeUs t_us, const Picture& picture);
  void reset(TimeUs t_us, const float* luminance) { reset(t_us, Picture{luminance}); }

  // A part of the picture of the instant t_us, which is later than the last sample, be it a picture
  // or a region. The picture is width x height; only the pixels of `region`, which must lie in the
  // image, are read. The next update() gives their events.
  void add_region(TimeUs t_us, const Rect& region, const Picture& picture);
  void add_region(TimeUs t_us, const Rect& region, const float* luminance) {
    add_region(t_us, region, Picture{luminance});
  }

  // The next picture, of t_us later than the last sample. Appends the events with stamps in
  // (previous picture, t_us] in (t, y, x, polarity) order. Throws SimulationError for luminance
  // that is negative or not finite (so does add_region()); the camera must then be reset.
  void update(TimeUs t_us, const Picture& picture, std::vector<Event>& out);
  void update(TimeUs t_us, const float* luminance, std::vector<Event>& out) {
    update(t_us, Picture{luminance}, out);
  }

  // Another picture of the instant of the last picture, after a change that is no event of the
  // scene (a thrown object comes into existence). References move with it, so that it makes no
  // events. No region may have come since.
  void rebase(const Picture& picture);
  void rebase(const float* luminance) { rebase(Picture{luminance}); }

  int width() const { return width_; }
  int height() const { return height_; }
  PixelState pixel(int x, int y) const;
  // Why the events of the last update() happened, one by one.
  const std::vector<Cause>& causes() const { return causes_; }
  // Events that the saturated readout has lost since the reset.
  std::int64_t lost() const { return readout_.lost(); }
  // Events of the time until the last update whose stamps lie behind it.
  std::int64_t under_way() const { return readout_.under_way(); }

 private:
  EventCamera(const EventCameraSpec& spec, int width, int height, std::uint64_t seed,
              std::uint64_t throw_index, std::string_view name, bool keep_causes,
              const std::vector<Thresholds>& thresholds);

  void sample(TimeUs t_us, const Rect& region, const Picture& picture);
  void check_time(TimeUs t_us) const;

  int width_;
  int height_;
  bool keep_causes_;
  TimeUs t_us_ = 0;            // of the last picture
  TimeUs last_sample_us_ = 0;  // of it or the last region since
  PixelArray pixels_;
  Noise noise_;
  Readout readout_;
  EventWords words_;  // since the last picture
  std::vector<Cause> causes_;
};

}  // namespace dodgesim

// dodgesim emulate: video to events.
#include <cstdio>
#include <memory>
#include <numeric>

#include "sim/base/error.h"
#include "sim/base/formatted.h"
#include "sim/base/memory_limit.h"
#include "sim/base/progress.h"
#include "sim/base/wall_clock.h"
#include "sim/bench/timed_emulation.h"
#include "sim/config/event_camera_file.h"
#include "sim/events/light_between.h"
#include "sim/recordings/event_writer.h"
#include "sim/recordings/frame_reader.h"
#include "tools/commands/command.h"
#include "tools/commands/stop_signal.h"

namespace dodgesim {

namespace {

constexpr const char* kEmulateFooter =
    R"(CAMERA:
  ideal      an event at every change of L = ln(0.001 + I) by 0.2, ON or OFF, and nothing else:
             no mismatch, bandwidth, refractory period, noise, latency or limit of the readout
  sees1      the camera of the scenarios, 320 x 240 px in flight, but it takes any size
  noisy      a worn or badly biased one
  low_light  sees1 at 5 lux instead of 500
  FILE.yaml  keys of a scenario's sensors.events at its root, "preset: ideal" among them; or a
             scenario, whose camera is meant
I is the luminance; between frames L runs linearly. The first frame sets the references. With
a leak (leak_hz above 0: all but ideal) each starts below it, by a random share, from 0 to 1,
of the pixel's ON threshold, as after a long rest: the first ON events come sooner and the
first OFF later. So with any leak, however small, the first events, and with them those of
a short video, are not those of a camera without.

Scale of I: 1 is a white surface under illuminance_lux (500 by default). ideal does not care
about it beyond the 0.001; for the others it decides how slow the pixels are and how noisy.
uint8 values are divided by 255 and taken as linear: undo the gamma of ordinary video before.

EVENTS:
  .h5   as DSEC and RVT: events/x, y, t, p, height, width; ms_to_idx; t_offset (the first
        time stamp of T.npy, from which t counts); p 1 or 0; up to 71.6 minutes
  .npy  records t <i8, x <u2, y <u2, p |i1; p +1 or -1
  .txt  a line "t x y p" an event, t in whole microseconds, p 1 or 0
  .raw  Prophesee's EVT 2.0, for its programs; a line "% t_offset_us" of its header has the first
        time stamp of T.npy, from which t counts; up to 2048 rows and columns and 4.7 hours
  --causes adds events/cause, u8 (.h5), a field cause |u1 (.npy), a fifth column (.txt)
t of .npy and .txt is of the clock of T.npy. The recording ends with the last frame: what latency
or the readout would stamp later is not in it. The file appears when it is whole.

Frames have up to 4096 rows and columns, and are at most 1073 s apart. Between two frames a camera
is shown pictures along the straight line of L: one with leak or noise at least every 50 ms, and
about one for each fifth by which bandwidth or shot noise, which depend on the light, change.
Memory holds two frames and the events up to the next picture, however long the video is. The
speeds printed are of the emulation alone, beside cv::log of the same frames in the same run, on
one thread; with --causes none are printed.

Examples:
  dodgesim emulate video.npy --timestamps t.npy --camera ideal --out events.h5
  dodgesim explain sensors.events                   the keys of a camera's file)";

struct EmulateArguments {
  std::string frames;
  std::string times;
  std::string camera;
  std::string out;
  std::uint64_t seed = 1;
  std::uint64_t clip = 0;
  bool causes = false;
};

struct Counts {
  std::int64_t on = 0;
  std::int64_t off = 0;
};

// Makes a video's events and writes them to the file; notes their causes or else measures the time.
class Emulation {
 public:
  Emulation(EventCamera& camera, bool causes, TimedEmulation& timed, EventWriter& writer)
      : camera_(camera), causes_(causes), timed_(timed), writer_(writer) {}

  void begin(TimeUs t_us, const std::vector<float>& luminance) {
    shown_.assign(luminance.size(), kCauseScene);
    camera_.reset(t_us, {luminance.data(), shown_.data()});
  }

  // What it took to make the pictures that are shown.
  void add_preparation(double time_s) { timed_.add_preparation(time_s); }

  // `between`: a picture between two frames of the video.
  void show(TimeUs t_us, const std::vector<float>& luminance, bool between) {
    end_if_asked_to_stop();
    events_.clear();
    if (causes_) {
      camera_.update(t_us, {luminance.data(), shown_.data()}, events_);
    } else if (between) {
      timed_.update_between(t_us, luminance, events_);
    } else {
      timed_.update(t_us, luminance, events_);
    }
    for (const Event& event : events_) ++(event.polarity > 0 ? counts_.on : counts_.off);
    writer_.add(events_, camera_.causes());
  }

  const Counts& counts() const { return counts_; }

 private:
  EventCamera& camera_;
  bool causes_;
  TimedEmulation& timed_;
  EventWriter& writer_;
  std::vector<Cause> shown_;
  std::vector<Event> events_;
  Counts counts_;
};

// The commonest mistakes, which the events do not show at once.
void warn_of_luminance(const std::vector<float>& first, double illuminance_lux) {
  constexpr double kMostUsual = 10;
  const double mean =
      std::accumulate(first.begin(), first.end(), 0.0) / static_cast<double>(first.size());
  if (mean <= kMostUsual) return;
  std::fprintf(stderr,
               "The mean luminance of the first frame is %.3g, which is %.3g lux on white: is its "
               "scale 0 to 255 instead of 0 to 1?\n",
               mean, mean * illuminance_lux);
}

void warn_of_times(const FrameReader& video) {
  constexpr double kLeastUsualUs = 100;  // less: of s or ms
  constexpr double kMostUsualUs = 2e6;   // more: of ns
  const std::int64_t intervals = video.frame_count() - 1;
  if (intervals < 1) return;
  const double apart_us = static_cast<double>(video.duration_us()) / static_cast<double>(intervals);
  if (apart_us >= kLeastUsualUs && apart_us <= kMostUsualUs) return;
  std::fprintf(stderr, "The frames are %.3g us apart: are all times in microseconds?\n", apart_us);
}

void emulate(FrameReader& video, const EventCameraSpec& spec, Emulation& emulation) {
  LightBetween light(spec);
  Progress progress(video.frame_count(), "frames");
  TimeUs before_us = 0, t_us = 0;
  std::vector<float> before, luminance;
  video.next(t_us, luminance);
  warn_of_luminance(luminance, spec.illuminance_lux);
  warn_of_times(video);
  emulation.begin(t_us, luminance);
  std::int64_t frames = 1;
  for (;;) {
    std::swap(before, luminance);
    before_us = t_us;
    if (!video.next(t_us, luminance)) break;
    auto start = WallClock::now();
    const std::int64_t steps = light.steps(t_us - before_us, before, luminance);
    light.show_between(steps, before_us, before, t_us, luminance,
                       [&](TimeUs at_us, const auto& between) {
                         emulation.add_preparation(seconds_since(start));
                         emulation.show(at_us, between, true);
                         start = WallClock::now();
                       });
    emulation.add_preparation(seconds_since(start));
    emulation.show(t_us, luminance, false);
    progress.show(++frames);
  }
  progress.finish();
}

std::string rate_text(double per_s) {
  return per_s < 100 ? formatted("%.3g", per_s) : formatted("%.0f", per_s);
}

void report(const FrameReader& video, const EventCamera& camera, const Counts& counts,
            const TimedEmulation& timed) {
  const long long on = counts.on, off = counts.off;
  std::printf("events: %lld (%lld ON, %lld OFF)\n", on + off, on, off);
  if (camera.lost() > 0) {
    std::printf("lost: %lld events, because readout_max_hz was exceeded\n",
                static_cast<long long>(camera.lost()));
  }
  if (camera.under_way() > 0) {
    std::printf("not yet out at the end: %lld events, because of latency or readout\n",
                static_cast<long long>(camera.under_way()));
  }
  std::printf("video: %lld frames of %d x %d px, %.6f s\n",
              static_cast<long long>(video.frame_count()), video.width(), video.height(),
              seconds(video.duration_us()));
  if (timed.frames() == 0) return;  // nothing was measured
  const auto frames = static_cast<double>(timed.frames());
  std::printf("emulation: %s frames/s, %.2f Mev/s\n",
              rate_text(frames / timed.emulation_s()).c_str(),
              1e-6 * static_cast<double>(timed.events()) / timed.emulation_s());
  std::printf("cv::log: %s frames/s\n", rate_text(frames / timed.log_s()).c_str());
  std::printf("emulation takes %.3f of the time of cv::log\n", timed.emulation_s() / timed.log_s());
}

void emulate(const EmulateArguments& arguments) {
  if (arguments.causes && arguments.out.ends_with(".raw")) {
    throw ScenarioError("--causes: " + arguments.out +
                        " has no place for them; .h5, .npy and .txt have.");
  }
  watch_stop_signals();
  // All events between two pictures are held at once. With a limit, too many are an error; without,
  // the system would kill the program.
  limit_memory(physical_memory_mb());
  const EventCameraSpec spec = named_event_camera(arguments.camera);
  FrameReader video(arguments.frames, arguments.times);
  refuse_to_overwrite({arguments.frames, arguments.times}, arguments.out, "--out " + arguments.out);
  const auto writer = make_event_writer(
      arguments.out,
      {video.width(), video.height(), video.first_us(), video.duration_us(), arguments.causes});
  EventCamera camera(spec, video.width(), video.height(), arguments.seed, arguments.clip, "emulate",
                     arguments.causes);
  TimedEmulation timed(camera, spec.log_epsilon);
  Emulation emulation(camera, arguments.causes, timed, *writer);
  emulate(video, spec, emulation);
  writer->commit();
  report(video, camera, emulation.counts(), timed);
}

}  // namespace

void add_emulate_command(CLI::App& program, int& exit_code) {
  auto arguments = std::make_shared<EmulateArguments>();
  CLI::App* command = program.add_subcommand("emulate", "Turn a video into the events of a camera");
  command
      ->add_option("frames", arguments->frames,
                   "(N, H, W) float32 linear luminance, or uint8 of which 255 is luminance 1")
      ->required()
      ->type_name("FRAMES.npy");
  command->add_option("--timestamps", arguments->times, "(N) int64 microseconds, from any origin")
      ->required()
      ->type_name("T.npy");
  command
      ->add_option("--camera", arguments->camera,
                   "ideal, sees1, noisy, low_light or a YAML file; see below")
      ->required()
      ->type_name("CAMERA");
  command
      ->add_option("--out", arguments->out, "Where the events go: .h5 (DSEC), .npy, .txt or .raw")
      ->required()
      ->type_name("EVENTS");
  command->add_option("--seed", arguments->seed, "Of mismatch, hot and dead pixels, and noise")
      ->check(whole_number_between(0, UINT64_MAX))
      ->capture_default_str();
  command
      ->add_option("--clip", arguments->clip,
                   "Number of the video among those of one camera: other noise, the same pixels\n"
                   "(with the camera's key device: throw, each of another camera)")
      ->check(whole_number_between(0, UINT32_MAX))
      ->capture_default_str();
  command->add_flag(
      "--causes", arguments->causes,
      "Write the cause of each event, too: 0 a change of the light; 253 the leak, if\n"
      "more than half of the threshold is due to it; 254 shot noise; 255 a hot pixel.\n"
      "The events are the same");
  command->footer(kEmulateFooter);
  command->callback([arguments, &exit_code] {
    emulate(*arguments);
    exit_code = kOk;
  });
}

}  // namespace dodgesim

#include <memory>
#include <opencv2/core.hpp>
#include <utility>

#include "sim/base/wall_clock.h"
#include "sim/bench/bench_case.h"
#include "sim/bench/films.h"
#include "sim/bench/timed_emulation.h"
#include "sim/config/event_camera_file.h"

namespace dodgesim {

namespace {

constexpr int kWidth = 320;
constexpr int kHeight = 240;
constexpr int kPixels = kWidth * kHeight;
constexpr TimeUs kFrameUs = 1000;
constexpr int kFramesPerRun = 400;
constexpr double kTexturedPx = 0.098;  // speeds that make 3 and 0.3 events per 100 px and frame
constexpr double kDriftingPx = 0.0095;

struct Bench {
  MovingPicture film;
  EventCameraSpec spec;
  EventCamera camera;
  std::int64_t frame = 0;
  std::vector<float> luminance = std::vector<float>(kPixels);
  std::vector<Event> events;

  Bench(MovingPicture f, const EventCameraSpec& s)
      : film(std::move(f)), spec(s), camera(s, kWidth, kHeight, 1, 0, "bench") {
    film(0, luminance);
    camera.reset(0, luminance.data());
  }

  // The next stretch of the film.
  std::vector<double> run() {
    TimedEmulation timed(camera, spec.log_epsilon);
    for (int i = 0; i < kFramesPerRun; ++i) {
      film(++frame, luminance);
      events.clear();
      timed.update(frame * kFrameUs, luminance, events);
    }
    const auto frames = static_cast<double>(timed.frames());
    const auto count = static_cast<double>(timed.events());
    return {frames / timed.emulation_s(), 1e-6 * count / timed.emulation_s(),
            100 * count / (frames * kPixels), timed.emulation_s() / timed.log_s()};
  }
};

BenchCase emulator_case(const std::string& film_name, const std::string& camera,
                        const std::string& description, std::function<MovingPicture()> film) {
  const std::string name = "emulator." + film_name + "." + camera;
  const std::string what = "camera " + camera + ", " + description;
  BenchCase bench;
  bench.quantities = {
      {name + ".speed", "frames/s", "pictures of 320 x 240 px, " + what},
      {name + ".throughput", "Mev/s", "events put out meanwhile"},
      {name + ".rate", "ev/100px/frame", "events per 100 pixels and picture"},
      {name + ".time_to_log", "ratio", "time per picture over that of cv::log (float) on it"}};
  bench.prepare = [camera, film = std::move(film)](const BenchOptions&) -> BenchRun {
    auto state = std::make_shared<Bench>(film(), named_event_camera(camera));
    state->run();  // beyond the first events of every pixel, which come late
    return [state] { return state->run(); };
  };
  return bench;
}

// ns per pixel of one cv::log over a picture.
double log_ns(int type) {
  constexpr int kPasses = 200;
  cv::Mat picture(kHeight, kWidth, type), log(kHeight, kWidth, type);
  cv::theRNG().state = 1;
  cv::randu(picture, 0.01, 1.5);
  cv::log(picture, log);
  const auto start = WallClock::now();
  for (int i = 0; i < kPasses; ++i) cv::log(picture, log);
  return 1e9 * seconds_since(start) / kPasses / kPixels;
}

BenchCase log_case() {
  BenchCase bench;
  bench.quantities = {{"log.float", "ns/px", "cv::log of float, the measure of the emulator"},
                      {"log.double", "ns/px", "cv::log of double"}};
  bench.prepare = [](const BenchOptions&) -> BenchRun {
    return [] { return std::vector<double>{log_ns(CV_32F), log_ns(CV_64F)}; };
  };
  return bench;
}

}  // namespace

std::vector<BenchCase> emulator_cases() {
  std::vector<BenchCase> cases = {log_case()};
  for (const char* camera : {"ideal", "sees1"}) {
    cases.push_back(emulator_case("textured", camera, "a texture that moves at 98 px/s",
                                  [] { return drifting_texture(kWidth, kHeight, kTexturedPx); }));
    cases.push_back(emulator_case("drifting", camera, "a texture that moves at 9.5 px/s",
                                  [] { return drifting_texture(kWidth, kHeight, kDriftingPx); }));
    cases.push_back(emulator_case("quiet", camera, "a picture at rest that flickers by 1/255",
                                  [] { return quiet_texture(kWidth, kHeight); }));
  }
  return cases;
}

}  // namespace dodgesim

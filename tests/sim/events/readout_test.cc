#include "sim/events/readout.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <tuple>

#include "sim/base/random.h"
#include "tests/exponential.h"

namespace dodgesim {
namespace {

constexpr int kSensorWidth = 320;
constexpr int kSensorHeight = 240;
constexpr std::uint64_t kSensorPixels = kSensorWidth * kSensorHeight;

bool in_order(const Event& a, const Event& b) {
  return std::tie(a.t_us, a.y, a.x, a.polarity) < std::tie(b.t_us, b.y, b.x, b.polarity);
}

struct Request {
  TimeUs t_us;
  std::uint64_t pixel;
  bool on = true;
};

// The readout's answer to requests, in batches that end every period_us.
class Bench {
 public:
  explicit Bench(const EventCameraSpec& spec, TimeUs period_us = 1000)
      : readout(spec, kSensorWidth, kSensorHeight, RandomStream(1, 0, "test")),
        period_us_(period_us) {}

  std::vector<Event> serve(const std::vector<Request>& requests, TimeUs until_us,
                           TimeUs start_us = 0) {
    readout.reset(start_us);
    std::vector<Event> out;
    auto next = requests.begin();
    for (TimeUs origin_us = start_us; origin_us < until_us; origin_us += period_us_) {
      EventWords words;
      const TimeUs end_us = origin_us + period_us_;
      for (; next != requests.end() && next->t_us <= end_us; ++next) {
        words.push(next->t_us - origin_us,
                   EventWords::address(next->pixel % kSensorWidth, next->pixel / kSensorWidth),
                   next->on, kCauseScene);
      }
      const std::size_t known = out.size();
      readout.push(words, origin_us, end_us, out, nullptr);
      for (std::size_t i = known; i < out.size(); ++i) {
        EXPECT_GT(out[i].t_us, origin_us);
        EXPECT_LE(out[i].t_us, end_us);
      }
    }
    EXPECT_TRUE(std::is_sorted(out.begin(), out.end(), in_order));
    return out;
  }

  Readout readout;

 private:
  TimeUs period_us_;
};

EventCameraSpec only_arbiter(double max_hz) {
  EventCameraSpec spec = event_camera_preset("ideal");
  spec.readout_max_hz = max_hz;
  return spec;
}

// Random requests of a rate, of pixels that come again after `pixels` requests.
std::vector<Request> poisson(double rate_hz, double duration_s,
                             std::uint64_t pixels = kSensorPixels) {
  RandomStream random(2, 0, "requests");
  std::vector<Request> requests;
  double t_s = 0;
  while ((t_s += exponential(random, rate_hz)) < duration_s) {
    const auto t_us = static_cast<TimeUs>(std::ceil(1e6 * t_s));
    requests.push_back({t_us, 7919 * requests.size() % pixels, requests.size() % 3 == 0});
  }
  return requests;
}

TEST(Readout, PassesEventsOnWhereNothingHoldsThemUp) {
  Bench bench(event_camera_preset("ideal"));
  const auto requests = poisson(1e5, 0.1);
  const auto events = bench.serve(requests, 100000);
  ASSERT_EQ(events.size(), requests.size());
  for (std::size_t i = 0; i < events.size(); ++i) EXPECT_EQ(events[i].t_us, requests[i].t_us);
}

TEST(Readout, LatencyShiftsAllStamps) {
  EventCameraSpec spec = event_camera_preset("ideal");
  spec.latency_us = 2345;
  Bench bench(spec);
  const auto events = bench.serve({{1, 0}, {999, 1}, {1000, 2}}, 10000);
  ASSERT_EQ(events.size(), 3u);
  EXPECT_EQ(events[0].t_us, 2346);
  EXPECT_EQ(events[1].t_us, 3344);
  EXPECT_EQ(events[2].t_us, 3345);
}

TEST(Readout, JitterHasTheSetMeanAndSpread) {
  EventCameraSpec spec = event_camera_preset("ideal");
  spec.latency_us = 500;
  spec.jitter_us = 20;
  Bench bench(spec);
  std::vector<Request> requests;
  for (std::uint64_t i = 0; i < kSensorPixels; ++i) requests.push_back({10000, i});
  double mean = 0, square = 0, neighbours = 0, last = 0;
  std::map<std::uint64_t, double> late;
  for (const Event& event : bench.serve(requests, 20000)) {
    late[static_cast<std::uint64_t>(event.y) * kSensorWidth + event.x] =
        (static_cast<double>(event.t_us) - 10500) / 20;
  }
  ASSERT_EQ(late.size(), kSensorPixels);
  const double n = kSensorPixels;
  for (const auto& [pixel, sigmas] : late) {
    mean += sigmas / n;
    square += sigmas * sigmas / n;
    neighbours += sigmas * last / n;
    last = sigmas;
  }
  EXPECT_NEAR(mean, 0, 3 / std::sqrt(n));
  // Rounding to the microsecond adds a variance of 1/12.
  EXPECT_NEAR(square, 1 + 1 / (12 * 400.0), 3 * std::sqrt(2 / n) + 2e-3);
  EXPECT_NEAR(neighbours, 0, 3 / std::sqrt(n));
}

TEST(Readout, NoEventComesBeforeItsCauseHoweverStrongTheJitter) {
  EventCameraSpec spec = event_camera_preset("ideal");
  spec.latency_us = 10;
  spec.jitter_us = 1000;
  Bench bench(spec);
  std::vector<Request> requests;
  for (std::uint64_t i = 0; i < 1000; ++i) requests.push_back({5000, i});
  const auto events = bench.serve(requests, 20000);
  EXPECT_EQ(events.size(), requests.size());
  for (const Event& event : events) EXPECT_GE(event.t_us, 5000);
}

TEST(Readout, AFlashLeavesAtTheArbitersRateRowByRow) {
  Bench bench(only_arbiter(1e5));  // 10 us each
  std::vector<Request> requests;
  for (std::uint64_t i = 500; i-- > 0;) requests.push_back({700, 13 * i});
  const auto events = bench.serve(requests, 20000);
  ASSERT_EQ(events.size(), 500u);
  for (std::size_t k = 0; k < events.size(); ++k) {
    EXPECT_EQ(events[k].t_us, 700 + 10 * static_cast<TimeUs>(k));
    EXPECT_EQ(events[k].y * kSensorWidth + events[k].x, static_cast<int>(13 * k));
  }
  EXPECT_EQ(bench.readout.lost(), 0);
}

TEST(Readout, AnArbiterThatIsFastEnoughDelaysNothing) {
  Bench bench(only_arbiter(2e7));
  const std::vector<Request> requests = {{10, 1}, {10, 2}, {11, 3}, {500, 4}};
  const auto events = bench.serve(requests, 1000);
  ASSERT_EQ(events.size(), 4u);
  for (std::size_t i = 0; i < 4; ++i) EXPECT_EQ(events[i].t_us, requests[i].t_us);
}

TEST(Readout, RandomRequestsWaitAsQueueingTheorySays) {
  const double max_hz = 1e4;  // 100 us each
  for (const double load : {0.3, 0.7, 0.9}) {
    const double rate_hz = load * max_hz;
    const auto requests = poisson(rate_hz, 40);
    Bench bench(only_arbiter(max_hz));
    const auto events = bench.serve(requests, 41000000);
    ASSERT_EQ(events.size(), requests.size());
    double wait_us = 0;
    for (std::size_t i = 0; i < events.size(); ++i) {
      wait_us += static_cast<double>(events[i].t_us - requests[i].t_us);
    }
    wait_us /= static_cast<double>(events.size());
    const double expected_us = 1e6 * rate_hz / (2 * max_hz * (max_hz - rate_hz));
    EXPECT_NEAR(wait_us, expected_us, (load > 0.8 ? 0.1 : 0.03) * expected_us) << load;
    EXPECT_EQ(bench.readout.lost(), 0);
  }
}

TEST(Readout, UnderOverloadLosesOnlyWhatWaitingPixelsWouldSayAndCountsIt) {
  const double max_hz = 1e5;
  constexpr std::uint64_t kSome = 500;
  const auto requests = poisson(10 * max_hz, 0.2, kSome);  // 1 Mev/s
  Bench bench(only_arbiter(max_hz));
  const auto events = bench.serve(requests, 200000);
  // The arbiter is never idle once the line has formed.
  EXPECT_NEAR(static_cast<double>(events.size()), 0.2 * max_hz, 5);
  // What has neither left nor been lost waits, at most once for each pixel.
  const auto waiting =
      static_cast<std::int64_t>(requests.size() - events.size()) - bench.readout.lost();
  EXPECT_GT(waiting, 0);
  EXPECT_LE(waiting, static_cast<std::int64_t>(kSome));
  EXPECT_EQ(waiting, bench.readout.under_way());
  // It comes when the light has gone.
  auto later = bench.serve(requests, 300000);
  EXPECT_EQ(static_cast<std::int64_t>(later.size()),
            static_cast<std::int64_t>(events.size()) + waiting);
  // Every stamp is served once, and no pixel twice within the line.
  std::map<int, TimeUs> last;
  for (std::size_t i = 1; i < later.size(); ++i) EXPECT_EQ(later[i].t_us - later[i - 1].t_us, 10);
  for (const Event& event : later) {
    const auto [at, first] = last.try_emplace(event.y * kSensorWidth + event.x, event.t_us);
    if (!first) {
      EXPECT_GT(event.t_us - at->second, 1000);
      at->second = event.t_us;
    }
  }
}

TEST(Readout, StampsAreMultiplesOfTheResolutionNotBeforeTheEvent) {
  EventCameraSpec spec = event_camera_preset("ideal");
  for (const std::int64_t resolution_us : {2, 7, 1000, 2500}) {
    spec.stamp_resolution_us = resolution_us;
    Bench bench(spec);
    const TimeUs start_us = 123457;
    auto requests = poisson(1e5, 0.05);
    for (Request& request : requests) request.t_us += start_us;
    const auto events = bench.serve(requests, start_us + 60000, start_us);
    ASSERT_EQ(events.size(), requests.size());
    std::map<TimeUs, int> expected, stamps;
    for (const Request& request : requests) {
      ++expected[(request.t_us + resolution_us - 1) / resolution_us * resolution_us];
    }
    for (const Event& event : events) ++stamps[event.t_us];
    EXPECT_EQ(stamps, expected);
  }
}

TEST(Readout, GivesTheSameStreamHoweverTheEventsAreSplitIntoCalls) {
  EventCameraSpec spec;  // sees1
  spec.readout_max_hz = 3e5;
  spec.stamp_resolution_us = 5;
  const auto requests = poisson(4e5, 0.06, 3000);
  Bench whole(spec, 100000);
  const auto events = whole.serve(requests, 100000);
  EXPECT_GT(whole.readout.lost(), 100);
  for (const TimeUs period_us : {100, 1000, 50000}) {
    Bench bench(spec, period_us);
    EXPECT_EQ(bench.serve(requests, 100000), events);
    EXPECT_EQ(bench.readout.lost(), whole.readout.lost());
  }
}

TEST(Readout, ResetForgetsWhatWaits) {
  EventCameraSpec spec = event_camera_preset("ideal");
  spec.readout_max_hz = 1;
  spec.latency_us = 100000;
  Bench bench(spec);
  bench.serve({{1, 1}, {2, 2}, {3, 3}, {4, 3}}, 150000);
  EXPECT_TRUE(bench.serve({}, 10000000).empty());
  EXPECT_EQ(bench.readout.lost(), 0);
}

}  // namespace
}  // namespace dodgesim

// The study of the sampling, and the time statistics.
#include "sim/check/sampling_study.h"

#include <gtest/gtest.h>

#include <functional>

#include <cmath>

#include "sim/check/prescribed_throw.h"
#include "sim/check/time_statistics.h"
#include "sim/flight/setup.h"

namespace dodgesim {
namespace {

constexpr const char* kModels = DODGESIM_SOURCE_DIR "/models";

SamplingOptions options_of(int throws, std::uint64_t seed, TimeUs film_us) {
  SamplingOptions options;
  options.models_dir = kModels;
  options.throws = throws;
  options.seed = seed;
  options.film_us = film_us;
  return options;
}

TEST(SamplingStudy, FindsNoDifferenceBetweenTheReferenceAndItself) {
  const SamplingOptions options = options_of(1, 5, 2500);
  SamplingVariant coarse{"coarse"};
  coarse.sampling.max_displacement_px = 4;
  int reported = 0;
  const auto results = study_sampling(options, {sampling_reference(), coarse},
                                      [&](int finished) { reported = finished; });
  EXPECT_EQ(reported, 1);
  ASSERT_EQ(results.size(), 2u);
  for (const SamplingAccuracy& a : {results[0].object, results[0].scene}) {
    EXPECT_EQ(a.count_ratio(), 1);
    EXPECT_EQ(a.worst_count, 0);
  }
  EXPECT_GT(results[0].scene.events, 1000);
  EXPECT_EQ(results[0].scene.worst_median_us, 0);
  EXPECT_LT(results[1].scene.count_ratio(), 0.97);
  EXPECT_GT(results[1].scene.median_us, 50);
  EXPECT_LT(8 * results[1].pictures, results[0].pictures);
  const std::string table = sampling_table(results);
  EXPECT_NE(table.find("| reference | +0.00 % |"), std::string::npos) << table;
}

// A few throws of what `dodgesim check-sensor --sampling 50` measures.
TEST(SamplingStudy, FindsTheDefaultsWithinTheirLimits) {
  const SamplingOptions options = options_of(3, 1, 5000);
  const auto results = study_sampling(options, {sampling_variants().front()}, [](int) {});
  EXPECT_GT(results[0].object.reference_events, 1000);
  EXPECT_GT(results[0].scene.reference_events, 10000);
  EXPECT_FALSE(judge(results).failed()) << sampling_table(results);
}

TEST(SamplingStudy, ThrowsWhatItIsTold) {
  SamplingOptions options = options_of(1, 5, 1000);
  const auto events = [&](const char* object) {
    options.object = object;
    return study_sampling(options, {SamplingVariant{}}, [](int) {})[0].object.reference_events;
  };
  EXPECT_NE(events("ball"), events("box"));
}

TEST(SamplingStudy, VariesWhatItIsGiven) {
  SamplingSpec sampling;
  sampling.max_displacement_px = 3;
  KeySpec keys;
  keys.supersampling = 1;
  const auto variants = sampling_variants(sampling, keys);
  EXPECT_EQ(variants.front().sampling.max_displacement_px, 3);
  EXPECT_EQ(variants.front().keys.supersampling, 1);
  EXPECT_EQ(variants.back().keys.supersampling, 1);
}

SamplingResult good_result() {
  SamplingResult result;
  result.object = {995, 1000, 0.02, 10, 30, 60};
  result.scene = {100900, 100000, 0.01, 10, 40, 45};
  return result;
}

TEST(SamplingStudy, FailsBeyondItsLimits) {
  EXPECT_FALSE(judge({good_result()}).failed());
  const auto fails = [](const std::function<void(SamplingResult&)>& spoil) {
    SamplingResult bad = good_result();
    spoil(bad);
    EXPECT_FALSE(judge({good_result(), bad}).failed());  // the first variant counts
    return judge({bad}).failed();
  };
  EXPECT_TRUE(
      fails([](SamplingResult& r) { r.object.events = 0.985 * r.object.reference_events; }));
  EXPECT_TRUE(fails([](SamplingResult& r) { r.object.median_us = 51; }));
  EXPECT_TRUE(fails([](SamplingResult& r) { r.scene.events = 0.985 * r.scene.reference_events; }));
  EXPECT_TRUE(fails([](SamplingResult& r) { r.scene.median_us = 51; }));
  EXPECT_FALSE(fails([](SamplingResult& r) { r.object = {}; }));  // there was nothing to judge
}

TEST(PrescribedThrow, MovesAsItsVelocitiesSay) {
  const World world({kModels, "room", "qav_rxl", {}});
  const auto toss = PrescribedThrow::random(3, 5, world.vehicle().X_BC.front());
  const Snapshot a = toss.at(10000), b = toss.at(10100);
  for (const auto& [p, q] : {std::pair{a.vehicle, b.vehicle}, {a.objects[0], b.objects[0]}}) {
    EXPECT_LT((q.p_W - p.p_W - 1e-4 * p.v_W).norm(), 1e-12);
    const Eigen::AngleAxisd turn(q.q_W * p.q_W.conjugate());
    EXPECT_LT((turn.angle() * turn.axis() - 1e-4 * p.w_W).norm(), 1e-9);
  }
}

TEST(PrescribedThrow, TurnsFastInHalfOfThemAndBringsHalfOfTheBallsFromTheSide) {
  const World world({kModels, "room", "qav_rxl", {}});
  const Eigen::Isometry3d X_BC = world.vehicle().X_BC.front();
  const Intrinsics camera = intrinsics(CameraSpec{});
  int fast = 0, beside = 0;
  for (int k = 0; k < 40; ++k) {
    const Snapshot start = PrescribedThrow::random(1, k, X_BC).at(0);
    fast += std::abs(start.vehicle.w_W.norm() - 5) < 1e-9 ? 1 : 0;
    const Eigen::Vector3d p_C = (start.vehicle.pose() * X_BC).inverse() * start.objects[0].p_W;
    const double x = camera.project(p_C).x();
    beside += x < 0 || x > camera.width ? 1 : 0;
  }
  EXPECT_EQ(fast, 20);
  EXPECT_EQ(beside, 20);
}

TEST(TimeStatistics, NeedMoreDynamicThanStaticPixelsAboveTheThreshold) {
  TimeStatistics statistics;
  statistics.threshold = 0.1;
  const auto region = [](int low, int high) {
    std::vector<PixelTime> pixels(static_cast<std::size_t>(low), PixelTime{0, 0});
    pixels.resize(pixels.size() + static_cast<std::size_t>(high), PixelTime{0.3, 0.2});
    return pixels;
  };
  statistics.hovering = {region(900, 100), region(700, 300)};
  const Check good = judge(statistics);
  EXPECT_FALSE(good.failed());
  ASSERT_EQ(good.lines.size(), 2u);
  EXPECT_EQ(good.lines[0].measured, "30.00 %");
  EXPECT_EQ(good.lines[1].outcome, Outcome::kOff);  // nothing was seen while evading
  std::swap(statistics.hovering.fixed, statistics.hovering.dynamic);
  EXPECT_TRUE(judge(statistics).failed());
}

TEST(TimeStatistics, OfAThrowHaveBothRegions) {
  const Scenario scenario = parse_scenario(
      "mission: {start_m: [-2, 0, 2]}\n"
      "throw: {distance_m: 3, speed_mps: 6, size_m: 0.3, launch_height_m: 1.7, launch_s: 0.1}\n"
      "after_s: 0.1\n",
      "test.yaml", kModels);
  const TimeStatistics statistics = measure_time_statistics(scenario, 0);
  EXPECT_EQ(statistics.threshold, scenario.dodger.time_image.threshold_b);
  EXPECT_GT(statistics.hovering.fixed.size(), 300u);
  EXPECT_GT(statistics.hovering.dynamic.size(), 300u);
  EXPECT_FALSE(judge(statistics).failed());
}

}  // namespace
}  // namespace dodgesim

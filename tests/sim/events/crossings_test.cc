#include "sim/events/crossings.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>

#include "sim/base/random.h"
#include "sim/base/vector_level.h"

namespace dodgesim {
namespace {

constexpr double kRefractoryUs = 100;

// The curve as its header states it, by libm.
double signal_at(const Crossings::Pixel& p, double t_us) {
  const double line = p.s0 + p.rise_per_us * t_us;
  if (p.decay_per_us == 0) return p.s0 + (p.s1 - p.s0) * t_us / p.dt_us;
  const double left = std::exp(-p.decay_per_us * p.dt_us);
  const double amplitude = (p.s0 + p.rise_per_us * p.dt_us - p.s1) / (1 - left);
  return line - amplitude * (1 - std::exp(-p.decay_per_us * t_us));
}

// What a pixel does that looks 20000 times between the samples.
struct Watched {
  int events = 0;
  double first_us = 0;
  bool on = false;  // the first of them
  double reference = 0;
  bool held = false;
};

Watched watch(const Crossings::Pixel& p, double refractory_us) {
  constexpr int kLooks = 20000;
  Watched seen;
  seen.reference = p.reference;
  seen.held = p.held_us > 0;
  double held_until_us = p.held_us;
  for (int k = 1; k <= kLooks; ++k) {
    const double t_us = p.dt_us * k / kLooks;
    if (seen.held && t_us < held_until_us) continue;
    if (seen.held) {
      seen.reference = signal_at(p, held_until_us);
      seen.held = false;
    }
    const double s = signal_at(p, t_us) - seen.reference;
    if (s > p.off && s < p.on) continue;
    if (seen.events++ == 0) {
      seen.first_us = t_us;
      seen.on = s >= p.on;
    }
    seen.reference += s >= p.on ? p.on : p.off;
    held_until_us = t_us + refractory_us;
    seen.held = refractory_us > 0;
  }
  return seen;
}

// A pixel behind a low-pass whose input runs straight from a place near its reference to anywhere.
Crossings::Pixel random_pixel(RandomStream& random) {
  Crossings::Pixel p{};
  p.dt_us = random.uniform(50, 3000);
  p.held_us = random.uniform() < 0.5 ? 0 : random.uniform(0, 200);
  p.reference = random.uniform(-3, 3);
  p.on = random.uniform(0.05, 0.3);
  p.off = -random.uniform(0.05, 0.3);
  p.s0 = p.reference + random.uniform(0.95 * p.off, 0.95 * p.on);
  p.decay_per_us = random.uniform() < 0.2 ? 0 : std::exp(random.uniform(-9, -3));
  const double u0 = p.s0 + random.uniform(-0.4, 0.4);
  p.rise_per_us = random.uniform(-0.5, 0.5) / p.dt_us;
  // dS/dt = decay (u - S), solved for S(dt) with u = u0 + rise t.
  const double left = std::exp(-p.decay_per_us * p.dt_us);
  const double lag = p.decay_per_us > 0 ? p.rise_per_us / p.decay_per_us : 0;
  p.s1 = u0 + p.rise_per_us * p.dt_us - lag + (p.s0 - u0 + lag) * left;
  if (p.decay_per_us == 0) p.s1 = p.s0 + p.rise_per_us * p.dt_us;
  return p;
}

TEST(Crossings, AreWhereAPixelThatLooksAllTheTimeFiresFirst) {
  RandomStream random(1, 0, "crossings");
  for (const double refractory_us : {0.0, kRefractoryUs}) {
    std::array<int, 6> count{};
    for (int trial = 0; trial < 2000; ++trial) {
      const Crossings::Pixel p = random_pixel(random);
      Crossings crossings;
      crossings.begin(3);
      crossings.add(p);
      crossings.solve(refractory_us);
      const Crossings::Answer answer = crossings.answer(0);
      ++count[answer];
      const Watched seen = watch(p, refractory_us);
      if (answer == Crossings::kUnknown) continue;
      if (answer == Crossings::kAgain) {
        ASSERT_GE(seen.events, 1) << trial;
        EXPECT_NEAR(crossings.crossing_us(0), seen.first_us, 1e-4 * p.dt_us) << trial;
        EXPECT_EQ(crossings.on(0), seen.on) << trial;
        continue;
      }
      const bool event = answer == Crossings::kHeld || answer == Crossings::kArmed;
      ASSERT_EQ(seen.events, event ? 1 : 0) << trial;
      if (answer == Crossings::kNothing) {
        EXPECT_EQ(seen.held, p.held_us > 0) << trial;
        continue;
      }
      EXPECT_EQ(seen.held, answer == Crossings::kHeld) << trial;
      if (event) {
        EXPECT_NEAR(crossings.crossing_us(0), seen.first_us, 1e-4 * p.dt_us) << trial;
        EXPECT_EQ(crossings.on(0), seen.on) << trial;
      }
      // The reference of the watched pixel is as late as its looks.
      const double slope = std::abs(signal_at(p, p.dt_us) - signal_at(p, 0.999 * p.dt_us));
      EXPECT_NEAR(crossings.reference_after(0), seen.reference, 1e-3 + slope) << trial;
    }
    EXPECT_GT(count[Crossings::kNothing], 200);
    EXPECT_GT(count[Crossings::kRearmed], 200);
    EXPECT_GT(count[Crossings::kArmed], 300);
    EXPECT_GT(count[Crossings::kHeld], refractory_us > 0 ? 30 : -1);
    EXPECT_GT(count[Crossings::kAgain], refractory_us > 0 ? 200 : -1);
    EXPECT_LT(count[Crossings::kUnknown], refractory_us > 0 ? 600 : 900);  // most are known
  }
}

TEST(Crossings, OfStraightLinesAreExact) {
  Crossings crossings;
  crossings.begin(3);
  crossings.add({1.0, 1.3, 300, 0, 0, 0, 0.95, -0.2, 0.25});  // reaches 1.2 after two thirds
  crossings.add({1.0, 0.7, 300, 0, 0, 0, 1.05, -0.2, 0.25});  // reaches 0.85 after half
  crossings.add({1.0, 1.1, 300, 0, 0, 0, 0.95, -0.2, 0.25});
  crossings.solve(0);
  EXPECT_EQ(crossings.answer(0), Crossings::kArmed);
  EXPECT_NEAR(crossings.crossing_us(0), 200, 1e-9);
  EXPECT_NEAR(crossings.reference_after(0), 1.2, 1e-15);
  EXPECT_TRUE(crossings.on(0));
  EXPECT_EQ(crossings.answer(1), Crossings::kArmed);
  EXPECT_NEAR(crossings.crossing_us(1), 150, 1e-9);
  EXPECT_FALSE(crossings.on(1));
  EXPECT_EQ(crossings.answer(2), Crossings::kNothing);
}

TEST(Crossings, OfSeveralEventsTheFirstIsAnsweredIfTheyAreApart) {
  Crossings crossings;
  crossings.begin(3);
  crossings.add({0, 0.7, 300, 0, 0, 0, 0, -0.2, 0.2});
  crossings.solve(0);
  EXPECT_EQ(crossings.answer(0), Crossings::kUnknown);
  crossings.solve(kRefractoryUs);
  EXPECT_EQ(crossings.answer(0), Crossings::kAgain);
  EXPECT_NEAR(crossings.crossing_us(0), 300 * 0.2 / 0.7, 1e-9);
}

TEST(Crossings, ADeadPixelMakesNoEvent) {
  constexpr double kNever = std::numeric_limits<double>::infinity();
  Crossings crossings;
  crossings.begin(3);
  for (const double s1 : {-5.0, 5.0}) crossings.add({0, s1, 300, 0, 0.01, 0, 0, -kNever, kNever});
  crossings.solve(kRefractoryUs);
  EXPECT_EQ(crossings.answer(0), Crossings::kNothing);
  EXPECT_EQ(crossings.answer(1), Crossings::kNothing);
}

TEST(Crossings, AreTheSameBytesAtEveryVectorLevel) {
  RandomStream random(2, 0, "crossings");
  Crossings narrow, wide;
  narrow.begin(1003);
  wide.begin(1003);
  for (int i = 0; i < 1003; ++i) {
    const Crossings::Pixel p = random_pixel(random);
    narrow.add(p);
    wide.add(p);
  }
  narrow.solve(kRefractoryUs, kPortable);
  for (int level = kPortable + 1; level <= widest_vector_level(); ++level) {
    wide.solve(kRefractoryUs, level);
    for (std::size_t i = 0; i < narrow.size(); ++i) {
      ASSERT_EQ(wide.answer(i), narrow.answer(i)) << i;
      ASSERT_EQ(wide.crossing_us(i), narrow.crossing_us(i)) << i;
      ASSERT_EQ(wide.reference_after(i), narrow.reference_after(i)) << i;
    }
  }
}

}  // namespace
}  // namespace dodgesim

#include "sim/events/photoreceptor.h"

#include <gtest/gtest.h>

#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numbers>
#include <vector>

#include "sim/base/random.h"
#include "sim/base/vector_level.h"
#include "sim/events/spec.h"

namespace dodgesim {
namespace {

constexpr double kTurnRad = 2 * std::numbers::pi;

EventCameraSpec slow(double photoreceptor_hz, double follower_hz) {
  EventCameraSpec spec = event_camera_preset("ideal");
  spec.photoreceptor_hz = photoreceptor_hz;
  spec.follower_hz = follower_hz;
  return spec;
}

// The two low-passes, integrated in small steps (Runge-Kutta, fourth order).
Charge integrated(const Charge& before, double w1, double w2, double u1, double dt_s, double t_s) {
  constexpr int kSteps = 4000;
  const double h = t_s / kSteps;
  const auto u = [&](double t) { return before.u + (u1 - before.u) * t / dt_s; };
  double y = before.y, z = before.z;
  for (int i = 0; i < kSteps; ++i) {
    const double t = i * h;
    const auto dy = [&](double at, double y_at) { return w1 * (u(at) - y_at); };
    const auto dz = [&](double y_at, double z_at) { return w2 * (y_at - z_at); };
    const double a = dy(t, y), p = dz(y, z);
    const double b = dy(t + h / 2, y + h / 2 * a), q = dz(y + h / 2 * a, z + h / 2 * p);
    const double c = dy(t + h / 2, y + h / 2 * b), r = dz(y + h / 2 * b, z + h / 2 * q);
    const double d = dy(t + h, y + h * c), s = dz(y + h * c, z + h * r);
    y += h / 6 * (a + 2 * b + 2 * c + d);
    z += h / 6 * (p + 2 * q + 2 * r + s);
  }
  return {u(t_s), y, z};
}

TEST(Photoreceptor, CutOffIsProportionalToTheLight) {
  EventCameraSpec spec = slow(3000, 0);
  spec.photoreceptor_dark_hz = 100;
  for (const double lux : {5.0, 500.0, 1000.0, 1e5}) {
    spec.illuminance_lux = lux;
    const Photoreceptor photoreceptor(spec);
    for (const double luminance : {0.0, 0.1, 1.0, 2.0}) {
      EXPECT_NEAR(photoreceptor.cutoff_rad_s(luminance) / kTurnRad, 100 + 3 * lux * luminance,
                  1e-6);
    }
  }
}

TEST(Photoreceptor, AnswersAStepWithAnExponential) {
  const Photoreceptor photoreceptor(slow(3000, 0));
  const Charge before = {0.7, -0.4, 0};  // the light has been at 0.7 since the last sample
  for (const double luminance : {0.0, 0.05, 0.5, 3.0}) {
    const double w = photoreceptor.cutoff_rad_s(luminance);
    for (const double taus : {1e-6, 0.1, 1.0, 5.0, 40.0}) {
      const double t_s = taus / w;
      const Charge after = photoreceptor.at(before, luminance, 0.7, 50 / w, t_s);
      EXPECT_NEAR(after.y, 0.7 - 1.1 * std::exp(-taus), 1e-10);
      EXPECT_EQ(after.z, after.y);
    }
  }
}

TEST(Photoreceptor, LagsARampByItsTimeConstant) {
  const Photoreceptor photoreceptor(slow(3000, 0));
  const double w = photoreceptor.cutoff_rad_s(0.3), rate = 400, dt_s = 30 / w;
  const Charge after = photoreceptor.at({0, 0, 0}, 0.3, rate * dt_s, dt_s, dt_s);
  EXPECT_NEAR(after.y, rate * (dt_s - 1 / w), 1e-8);
}

TEST(Photoreceptor, OfSecondOrderAnswersAStepAndARampAsTheDifferentialEquations) {
  RandomStream random(3, 0, "charges");
  for (const double follower_hz : {30.0, 490.0, 549.9, 550.0, 550.001, 554.0, 560.0, 5000.0}) {
    const Photoreceptor photoreceptor(slow(3000, follower_hz));
    const double w1 = photoreceptor.cutoff_rad_s(0.3);  // 550 Hz
    const double w2 = kTurnRad * follower_hz;
    for (const double dt_s : {20e-6, 300e-6, 3e-3}) {
      for (const bool step : {true, false}) {
        const Charge before = {random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1)};
        const double u1 = step ? before.u : random.uniform(-1, 1);
        const double t_s = random.uniform(0.1, 1) * dt_s;
        const Charge after = photoreceptor.at(before, 0.3, u1, dt_s, t_s);
        const Charge expected = integrated(before, w1, w2, u1, dt_s, t_s);
        EXPECT_NEAR(after.u, expected.u, 1e-12);
        EXPECT_NEAR(after.y, expected.y, 5e-9);
        EXPECT_NEAR(after.z, expected.z, 2e-6);
      }
    }
  }
}

// A row of random pixels, with what the kernel makes of it.
struct Pixels {
  Pixels(std::size_t size, std::uint64_t seed) {
    RandomStream random(seed, 0, "pixels");
    for (std::size_t i = 0; i < size; ++i) {
      for (std::vector<float>* light : {&light0, &luminance}) {
        light->push_back(static_cast<float>(std::exp(random.uniform(-9, 3))));
      }
      dt_s.push_back(static_cast<float>(std::exp(random.uniform(-13, -3))));
      for (std::vector<float>* charge : {&u0, &y0, &z0}) {
        charge->push_back(static_cast<float>(random.uniform(-7, 2)));
      }
      low.push_back(static_cast<float>(random.uniform(-8, 0)));
      high.push_back(low.back() + static_cast<float>(random.uniform(0, 6)));
    }
    for (std::vector<float>* was : {&was_light, &was_u, &was_y, &was_z}) was->resize(size);
    may_fire.resize(size);
  }

  Photoreceptor::Row row(bool own_time) {
    light1 = light0;
    u1 = u0;
    y1 = y0;
    z1 = z0;
    return {luminance.size(),
            luminance.data(),
            own_time ? dt_s.data() : nullptr,
            1e-3f,
            light1.data(),
            u1.data(),
            y1.data(),
            z1.data(),
            was_light.data(),
            was_u.data(),
            was_y.data(),
            was_z.data(),
            low.data(),
            high.data(),
            0.01f,
            0.02f,
            may_fire.data()};
  }

  Charge before(std::size_t i) const { return {u0[i], y0[i], z0[i]}; }
  // Between the samples.
  double light(std::size_t i) const {
    return 0.5 * (static_cast<double>(light0[i]) + luminance[i]);
  }

  std::vector<float> luminance, dt_s, low, high;
  std::vector<float> light0, u0, y0, z0;              // of the last sample
  std::vector<float> light1, u1, y1, z1;              // of the new one
  std::vector<float> was_light, was_u, was_y, was_z;  // what the kernel says they were
  std::vector<unsigned char> may_fire;
};

TEST(Photoreceptor, RowsAgreeWithSinglePixels) {
  for (const auto& [photoreceptor_hz, follower_hz] :
       {std::pair{0.0, 0.0}, {3000.0, 0.0}, {3000.0, 1000.0}}) {
    EventCameraSpec spec = slow(photoreceptor_hz, follower_hz);
    for (const auto& [linear_below, own_time] :
         {std::pair{0.0, false}, {0.0, true}, {0.01, false}, {0.01, true}}) {
      spec.linear_below = linear_below;
      const Photoreceptor photoreceptor(spec);
      Pixels p(999, 4);
      photoreceptor.advance(p.row(own_time));
      for (std::size_t i = 0; i < 999; ++i) {
        const double u1 = Response(spec.log_epsilon, spec.linear_below).at(p.luminance[i]);
        const double dt_s = own_time ? p.dt_s[i] : 1e-3f;
        const Charge before = p.before(i);
        const Charge after = photoreceptor.at(before, p.light(i), u1, dt_s, dt_s);
        EXPECT_NEAR(p.u1[i], after.u, 2e-6);
        const double swing = std::abs(before.u - u1) + std::abs(before.u - before.y);
        if (photoreceptor.order() > 0) {
          EXPECT_NEAR(p.y1[i], after.y, 1e-6 * swing + 2e-6);
        }
        if (photoreceptor.order() > 1) {
          EXPECT_NEAR(p.z1[i], after.z, 2e-5 * (swing + std::abs(before.u - before.z)) + 2e-6);
        }
      }
    }
  }
}

// From a tenth of a microsecond to pictures that are tens of time constants apart, and with
// cut-offs that are far apart, nearly equal and equal.
TEST(Photoreceptor, RowsAnswerAsTheDifferentialEquationsOverAnyInterval) {
  RandomStream random(9, 0, "intervals");
  for (const double follower_hz : {30.0, 880.0, 893.0, 899.0, 899.99, 900.0, 900.3, 907.0, 2e4}) {
    const Photoreceptor photoreceptor(slow(3000, follower_hz));
    const double w1 = photoreceptor.cutoff_rad_s(0.3F), w2 = kTurnRad * follower_hz;  // 900 Hz
    Pixels p(40, 10);
    std::fill(p.light0.begin(), p.light0.end(), 0.3F);
    std::fill(p.luminance.begin(), p.luminance.end(), 0.3F);
    for (float& dt_s : p.dt_s) {
      dt_s = static_cast<float>(std::exp(random.uniform(std::log(1e-3), std::log(60))) /
                                std::max(w1, w2));
    }
    photoreceptor.advance(p.row(true));
    for (std::size_t i = 0; i < p.u0.size(); ++i) {
      const double dt_s = p.dt_s[i];
      const Charge expected = integrated(p.before(i), w1, w2, p.u1[i], dt_s, dt_s);
      EXPECT_NEAR(p.y1[i], expected.y, 5e-6) << dt_s * w1;
      EXPECT_NEAR(p.z1[i], expected.z, 5e-5) << follower_hz << " " << dt_s * w1;
    }
  }
}

TEST(Photoreceptor, RowsFlagEveryPixelWhoseOutputMayLeaveItsBounds) {
  const Photoreceptor photoreceptor(slow(3000, 1000));
  Pixels p(2000, 5);
  photoreceptor.advance(p.row(true));
  int quiet = 0;
  for (std::size_t i = 0; i < p.luminance.size(); ++i) {
    if (p.may_fire[i] != 0) continue;
    ++quiet;
    const double u1 = photoreceptor.response(p.luminance[i]);
    for (int part = 0; part <= 20; ++part) {
      const double t_s = static_cast<double>(p.dt_s[i]) * part / 20;
      const Charge then = photoreceptor.at(p.before(i), p.light(i), u1, p.dt_s[i], t_s);
      EXPECT_GT(then.z + 0.01, p.low[i]);
      EXPECT_LT(then.z + 0.02, p.high[i]);
    }
  }
  EXPECT_GT(quiet, 20);
}

TEST(Photoreceptor, RowsAreTheSameBytesAtEveryVectorLevel) {
  const float inf = std::numeric_limits<float>::infinity();
  const std::array<float, 10> odd = {0.0f,
                                     -0.0f,
                                     -1.0f,
                                     std::numeric_limits<float>::quiet_NaN(),
                                     inf,
                                     -inf,
                                     std::numeric_limits<float>::max(),
                                     std::numeric_limits<float>::denorm_min(),
                                     1e-40f,
                                     1e-30f};
  const auto same = [](const std::vector<float>& a, const std::vector<float>& b) {
    for (std::size_t i = 0; i < a.size(); ++i) {
      // Which of many NaNs comes out is not said.
      if (std::isnan(a[i]) && std::isnan(b[i])) continue;
      if (std::bit_cast<std::uint32_t>(a[i]) != std::bit_cast<std::uint32_t>(b[i])) return false;
    }
    return true;
  };
  for (const auto& [photoreceptor_hz, follower_hz] :
       {std::pair{0.0, 0.0}, {3000.0, 0.0}, {3000.0, 900.0}}) {
    EventCameraSpec spec = slow(photoreceptor_hz, follower_hz);
    for (const std::size_t size : {1u, 7u, 16u, 31u, 64u, 333u}) {
      for (const auto& [linear_below, own_time] :
           {std::pair{0.0, false}, {0.0, true}, {0.01, false}, {0.01, true}}) {
        spec.linear_below = linear_below;
        const Photoreceptor photoreceptor(spec);
        Pixels portable(size, 6), wide(size, 6);
        for (std::size_t i = 0; i < size; i += 3) {
          portable.luminance[i] = wide.luminance[i] = odd[i / 3 % odd.size()];
        }
        photoreceptor.advance(portable.row(own_time), kPortable);
        for (std::size_t i = 0; i < size; ++i) {
          if (!(portable.luminance[i] >= 0 && portable.luminance[i] < inf)) {
            EXPECT_EQ(portable.may_fire[i], 1) << portable.luminance[i];
          }
        }
        for (int level = kAvx2; level <= widest_vector_level(); ++level) {
          photoreceptor.advance(wide.row(own_time), level);
          EXPECT_TRUE(same(portable.u1, wide.u1));
          EXPECT_TRUE(same(portable.y1, wide.y1));
          EXPECT_TRUE(same(portable.z1, wide.z1));
          EXPECT_EQ(portable.may_fire, wide.may_fire);
          EXPECT_EQ(wide.was_u, wide.u0);
          if (photoreceptor.order() == 0) continue;
          EXPECT_EQ(wide.was_y, wide.y0);
          EXPECT_EQ(wide.was_light, wide.light0);
          EXPECT_TRUE(same(wide.light1, wide.luminance));
          if (photoreceptor.order() > 1) {
            EXPECT_EQ(wide.was_z, wide.z0);
          }
        }
      }
    }
  }
}

// A low-pass that is all but closed keeps what it holds.
TEST(Photoreceptor, RowsWithNextToNoBandwidthStayWhereTheyAre) {
  for (const double follower_hz : {1e-9, 1e-30, 1e-39, 1e-60}) {
    const Photoreceptor photoreceptor(slow(0, follower_hz));
    Pixels p(50, 11);
    photoreceptor.advance(p.row(true));
    for (std::size_t i = 0; i < 50; ++i) EXPECT_NEAR(p.y1[i], p.y0[i], 2e-6) << follower_hz;
  }
}

TEST(Photoreceptor, PiecesFollowTheCurveToWithinTheTolerance) {
  constexpr double kTolerance = 0.004;
  RandomStream random(8, 0, "curves");
  for (const double follower_hz : {200.0, 2000.0}) {
    const Photoreceptor photoreceptor(slow(3000, follower_hz));
    for (int n = 0; n < 300; ++n) {
      const double luminance = std::exp(random.uniform(-6, 1));
      const double dt_s = std::exp(random.uniform(-10, -4));
      const Charge before = {random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1)};
      const double u1 = random.uniform(-1, 1);
      const auto z = [&](double t_s) {
        return photoreceptor.at(before, luminance, u1, dt_s, t_s).z;
      };
      const double slope_1s = (u1 - before.u) / dt_s;
      double start_s = 0, farthest = 0;
      for (int pieces = 0; start_s < dt_s; ++pieces) {
        ASSERT_LT(pieces, 100);
        const Charge then = photoreceptor.at(before, luminance, u1, dt_s, start_s);
        const double end_s = std::min(
            start_s + photoreceptor.straight_s(then, luminance, slope_1s, kTolerance), dt_s);
        for (int k = 1; k < 20; ++k) {
          const double share = k / 20.0;
          const double chord = (1 - share) * z(start_s) + share * z(end_s);
          farthest = std::max(farthest, std::abs(z(start_s + share * (end_s - start_s)) - chord));
        }
        start_s = end_s;
      }
      EXPECT_LT(farthest, 1.01 * kTolerance) << follower_hz << " " << luminance << " " << dt_s;
    }
  }
}

// In so short a time a slow pixel's output cannot move; differences of nearly equal numbers could.
TEST(Photoreceptor, AnswersToNothingWithinAMicrosecondHoweverDarkItIs) {
  for (const double dark_hz : {0.01, 0.1, 1.0, 999.0, 1000.0}) {
    EventCameraSpec spec;
    spec.follower_hz = 1000;
    spec.photoreceptor_dark_hz = dark_hz;
    const Photoreceptor photoreceptor(spec);
    const float black = 0;
    const float before = photoreceptor.response(0.4f);
    float light = 0.4f, u = before, y = before, z = before;
    float was_light = 0, was_u = 0, was_y = 0, was_z = 0;
    unsigned char may_fire = 0;
    const float low = -100, high = 100;
    photoreceptor.advance({.size = 1,
                           .luminance = &black,
                           .dt_s = nullptr,
                           .same_dt_s = 1e-6f,
                           .light = &light,
                           .u = &u,
                           .y = &y,
                           .z = &z,
                           .light0 = &was_light,
                           .u0 = &was_u,
                           .y0 = &was_y,
                           .z0 = &was_z,
                           .low = &low,
                           .high = &high,
                           .leaked_before = 0,
                           .leaked = 0,
                           .may_fire = &may_fire});
    EXPECT_NEAR(z, before, 1e-3) << dark_hz;
  }
}

}  // namespace
}  // namespace dodgesim

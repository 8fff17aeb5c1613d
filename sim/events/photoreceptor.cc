#include "sim/events/photoreceptor.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

#include "sim/base/vector_level.h"
#include "sim/events/spec.h"

namespace dodgesim {

namespace {

constexpr double kReferenceLux = 1000;

// Longer intervals in units of tau are taken as this; the polynomial below stays finite.
constexpr float kMostTaus = 1e4f;

// Two low-passes are taken as equal when their cut-offs differ by less than this share.
constexpr double kEqualShare = 0.01;

// What is left of a transient after this many tau is not followed in pieces.
constexpr double kTransientTaus = 6;
constexpr int kMostPieces = 64;

// How a low-pass answers over an interval of x tau: exp(-x), and its mean over the interval.
template <class Number>
struct Decay {
  Number k, m;
};

// exp(x) by its series up to x^8: exp(-x) to within 3e-4 for any x >= 0.
[[gnu::always_inline]] inline Decay<float> decay(float x) {
  x = x < kMostTaus ? x : kMostTaus;
  float q = 1.0f / 40320;
  q = q * x + 1.0f / 5040;
  q = q * x + 1.0f / 720;
  q = q * x + 1.0f / 120;
  q = q * x + 1.0f / 24;
  q = q * x + 1.0f / 6;
  q = q * x + 0.5f;
  q = q * x + 1.0f;
  const float k = 1.0f / (1.0f + x * q);
  return {k, q * k};
}

Decay<double> decay(double x) { return {std::exp(-x), x > 0 ? -std::expm1(-x) / x : 1}; }

// What a unit of y's transient at the start leaves in z: the follower's answer to exp(-t/tau).
template <class Number>
[[gnu::always_inline]] inline Number passed_on(Number x1, Number k1, Number x2, Number k2) {
  const Number difference = x2 - x1;
  const Number apart = difference < 0 ? -difference : difference;
  const bool equal = apart < static_cast<Number>(kEqualShare) * x2;
  return equal ? x2 * k2 : (k1 - k2) * x2 / (equal ? Number{1} : difference);
}

struct Constants {
  float epsilon, linear_below, slope, knee;
  float rad_s, dark_rad_s, follower_rad_s;
};

// What the vectoriser needs to know: the arrays of a row do not overlap, and what is the same for
// all pixels is at hand.
template <int kOrder, bool kOwnTime>
[[gnu::always_inline]] inline void advance_row(Constants c, Photoreceptor::Row row) {
  constexpr float kMax = std::numeric_limits<float>::max();
#pragma GCC ivdep
  for (std::size_t i = 0; i < row.size; ++i) {
    const float light = row.luminance[i];
    const float log = natural_log(c.epsilon + light);
    const float line = c.knee + c.slope * (light - c.linear_below);
    const float u1 = light < c.linear_below ? line : log;
    const float u0 = row.u[i];
    row.u1[i] = u1;
    float least = u0 < u1 ? u0 : u1;
    float most = u0 < u1 ? u1 : u0;
    if constexpr (kOrder > 0) {
      const float dt_s = kOwnTime ? row.dt_s[i] : row.same_dt_s;
      const float y0 = row.y[i];
      const float x1 = (c.dark_rad_s + c.rad_s * light) * dt_s;
      const Decay<float> first = decay(x1);
      row.y1[i] = u1 + first.k * (y0 - u0) - first.m * (u1 - u0);
      least = y0 < least ? y0 : least;
      most = y0 > most ? y0 : most;
      if constexpr (kOrder > 1) {
        const float z0 = row.z[i];
        const float x2 = c.follower_rad_s * dt_s;
        const Decay<float> second = decay(x2);
        const float g = passed_on(x1, first.k, x2, second.k);
        row.z1[i] = u1 + second.k * (z0 - u0) + g * (y0 - u0) -
                    (second.m + (1 - second.k - g) / x1) * (u1 - u0);
        least = z0 < least ? z0 : least;
        most = z0 > most ? z0 : most;
      }
    }
    const bool quiet = (least + row.leaked_before > row.low[i]) &
                       (most + row.leaked < row.high[i]) & (light >= 0) & (light <= kMax);
    row.may_fire[i] = static_cast<unsigned char>(!quiet);
  }
}

using Kernel = void (*)(const Constants&, const Photoreceptor::Row&);

template <int kOrder, bool kOwnTime>
void advance_portable(const Constants& c, const Photoreceptor::Row& row) {
  advance_row<kOrder, kOwnTime>(c, row);
}
template <int kOrder, bool kOwnTime>
DODGESIM_TARGET_AVX2 void advance_avx2(const Constants& c, const Photoreceptor::Row& row) {
  advance_row<kOrder, kOwnTime>(c, row);
}
template <int kOrder, bool kOwnTime>
DODGESIM_TARGET_AVX512 void advance_avx512(const Constants& c, const Photoreceptor::Row& row) {
  advance_row<kOrder, kOwnTime>(c, row);
}

template <int kOrder, bool kOwnTime>
constexpr std::array<Kernel, kVectorLevels> kKernels = {advance_portable<kOrder, kOwnTime>,
                                                        advance_avx2<kOrder, kOwnTime>,
                                                        advance_avx512<kOrder, kOwnTime>};

Kernel kernel_for(int order, bool own_time, int level) {
  const auto i = static_cast<std::size_t>(level);
  if (order == 0) return kKernels<0, false>[i];
  if (order == 1) return own_time ? kKernels<1, true>[i] : kKernels<1, false>[i];
  return own_time ? kKernels<2, true>[i] : kKernels<2, false>[i];
}

}  // namespace

Photoreceptor::Photoreceptor(const EventCameraSpec& spec)
    : response_(spec.log_epsilon, spec.linear_below),
      order_(spec.photoreceptor_hz <= 0 ? 0 : (spec.follower_hz > 0 ? 2 : 1)),
      rad_s_(2 * std::numbers::pi * spec.photoreceptor_hz * spec.illuminance_lux / kReferenceLux),
      dark_rad_s_(2 * std::numbers::pi * spec.photoreceptor_dark_hz),
      follower_rad_s_(2 * std::numbers::pi * spec.follower_hz) {}

Charge Photoreceptor::at(const Charge& before, double luminance, double u1, double dt_s,
                         double t_s) const {
  const double change = (u1 - before.u) * (dt_s > 0 ? t_s / dt_s : 1);
  Charge out;
  out.u = before.u + change;
  out.y = out.u;
  if (order_ > 0) {
    const double x1 = cutoff_rad_s(luminance) * t_s;
    const Decay<double> first = decay(x1);
    out.y = out.u + first.k * (before.y - before.u) - first.m * change;
    out.z = out.y;
    if (order_ > 1) {
      const double x2 = follower_rad_s_ * t_s;
      const Decay<double> second = decay(x2);
      const double g = passed_on(x1, first.k, x2, second.k);
      out.z = out.u + second.k * (before.z - before.u) + g * (before.y - before.u) -
              (second.m + (1 - second.k - g) / x1) * change;
    }
  } else {
    out.z = out.y;
  }
  return out;
}

Photoreceptor::Pieces Photoreceptor::pieces(const Charge& before, double luminance, double u1,
                                            double dt_s, double tolerance) const {
  if (order_ == 0) return {0, 0};
  const double w1 = cutoff_rad_s(luminance);
  const double slope = (u1 - before.u) / dt_s;
  // z is a straight line plus p exp(-w1 t) plus, behind a follower, q exp(-w2 t).
  double p = before.y - before.u + slope / w1;
  double curvature = std::abs(p) * w1 * w1;
  double slowest = w1;
  if (order_ > 1) {
    const double w2 = follower_rad_s_;
    const double apart = std::max(std::abs(w2 - w1), kEqualShare * w2);
    p *= w2 / apart;
    const double q = std::abs(before.z - before.u + slope * (1 / w1 + 1 / w2)) + std::abs(p);
    curvature = std::abs(p) * w1 * w1 + q * w2 * w2;
    slowest = std::min(w1, w2);
  }
  const double span_s = std::min(dt_s, kTransientTaus / slowest);
  // A chord over h strays by up to curvature h^2/8, but by no more than the transient itself.
  const double count = std::ceil(span_s * std::sqrt(curvature / (8 * tolerance)));
  if (order_ == 1 && std::abs(p) < tolerance) return {0, 0};
  const int whole = static_cast<int>(std::min<double>(count, kMostPieces));
  if (whole <= 1 && span_s >= dt_s) return {0, 0};
  return {whole, span_s / std::max(whole, 1)};
}

void Photoreceptor::advance(const Row& row) const {
  static const int level = widest_vector_level();
  advance(row, level);
}

void Photoreceptor::advance(const Row& row, int vector_level) const {
  const Constants constants = {static_cast<float>(response_.epsilon()),
                               static_cast<float>(response_.linear_below()),
                               static_cast<float>(response_.slope()),
                               static_cast<float>(response_.knee()),
                               static_cast<float>(rad_s_),
                               static_cast<float>(dark_rad_s_),
                               static_cast<float>(follower_rad_s_)};
  kernel_for(order_, row.dt_s != nullptr, vector_level)(constants, row);
}

}  // namespace dodgesim

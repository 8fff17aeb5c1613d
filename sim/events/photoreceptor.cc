#include "sim/events/photoreceptor.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numbers>
#include <type_traits>

#include "sim/base/vector_level.h"
#include "sim/events/spec.h"

namespace dodgesim {

namespace {

constexpr double kReferenceLux = 1000;

// Two low-passes are taken as equal when their cut-offs differ by less than this share: the
// difference of nearly equal numbers would be worse than the mean of both ends.
template <class Number>
constexpr Number kEqualShare = std::is_same_v<Number, float> ? Number(0.01) : Number(0.001);

// How a low-pass answers over an interval of x tau: exp(-x), and its mean over the interval.
template <class Number>
struct Decay {
  Number k, m;
};

// Both to within 3e-7. x = n ln 2 + r with |r| <= ln(2)/2, and exp(-r) = 1 - r q by its series.
[[gnu::always_inline]] inline Decay<float> decay(float x) {
  constexpr float kMost = 80;                     // after so long nothing is left
  constexpr float kRound = 12582912.0f;           // 1.5 * 2^23: adding it rounds to an integer
  constexpr float kLn2High = 0.693145751953125f;  // 16 bits: n * kLn2High is exact
  constexpr float kLn2Low = 1.42860677e-06f;
  constexpr std::uint32_t kOne = 0x3f800000u;
  const float within = x < kMost ? x : kMost;
  const float shifted = within * 1.44269504f + kRound;
  const float n = shifted - kRound;
  const float r = (within - n * kLn2High) - n * kLn2Low;
  float q = 1.0f / 5040;
  q = q * r - 1.0f / 720;
  q = q * r + 1.0f / 120;
  q = q * r - 1.0f / 24;
  q = q * r + 1.0f / 6;
  q = q * r - 0.5f;
  q = q * r + 1.0f;
  // The lowest bits of `shifted` are those of n.
  const float halved = std::bit_cast<float>(kOne - (std::bit_cast<std::uint32_t>(shifted) << 23));
  const float k = halved * (1.0f - r * q);
  return {k, n == 0 ? q : (1.0f - k) / x};
}

// To within 1e-9, and the same on every machine, which libm's exp is not.
[[gnu::always_inline]] inline Decay<double> decay(double x) {
  constexpr double kSmall = 0.01;  // below, a series
  if (x < kSmall) {
    const double m = 1 - x * (1.0 / 2 - x * (1.0 / 6 - x * (1.0 / 24 - x * (1.0 / 120))));
    return {1 - x * m, m};
  }
  const double k = transient_left(x);
  return {k, (1 - k) / x};
}

// What z keeps of each at the end of an interval.
template <class Number>
struct Kept {
  Number z;     // of its own distance from u at the start
  Number y;     // of y's: the follower's answer to exp(-t/tau)
  Number rise;  // of u's rise over the interval, which is missing
};

// With x1, x2 the interval in units of both time constants:
//   y = x2 (k1 - k2)/(x2 - x1) and rise = m2 + x2 (m1 - m2)/(x2 - x1),
// where k and m fall with x by themselves and by (m - k)/x. To within 3e-5 in single precision.
template <class Number>
[[gnu::always_inline]] inline Kept<Number> kept(Number x1, Decay<Number> first, Number x2,
                                                Decay<Number> second) {
  const Number difference = x2 - x1;
  const Number apart = difference < 0 ? -difference : difference;
  const bool equal = apart < kEqualShare<Number> * x2;
  const Number sum = x1 + x2;
  const Number part = x2 / (equal ? sum : difference);
  const Number y = part * (equal ? sum * (first.k + second.k) / 2 : first.k - second.k);
  const Number lag = part * (equal ? (first.m - first.k) + (second.m - second.k)  //
                                   : first.m - second.m);
  return {second.k, y, second.m + lag};
}

struct Constants {
  ResponseOf<float> response;
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
    const float u0 = row.u[i];  // not from the light before: a logarithm costs more than to read it
    const float u1 = c.response.at(light);
    row.u1[i] = u1;
    float least = u0 < u1 ? u0 : u1;
    float most = u0 < u1 ? u1 : u0;
    if constexpr (kOrder > 0) {
      const float dt_s = kOwnTime ? row.dt_s[i] : row.same_dt_s;
      const float y0 = row.y[i];
      const float x1 =
          (c.dark_rad_s + c.rad_s * (0.5f * row.luminance_before[i] + 0.5f * light)) * dt_s;
      const Decay<float> first = decay(x1);
      const float y1 = u1 + first.k * (y0 - u0) - first.m * (u1 - u0);
      row.y1[i] = y1;
      // Where y stays on one side of u it only rises or only falls; where it meets u, it turns.
      const bool apart = (y0 - u0) * (y1 - u1) > 0;
      least = apart ? y1 : least;
      most = apart ? y1 : most;
      least = y0 < least ? y0 : least;
      most = y0 > most ? y0 : most;
      if constexpr (kOrder > 1) {
        const float z0 = row.z[i];
        const float x2 = c.follower_rad_s * dt_s;
        const Kept<float> left = kept(x1, first, x2, decay(x2));
        row.z1[i] = u1 + left.z * (z0 - u0) + left.y * (y0 - u0) - left.rise * (u1 - u0);
        least = z0 < least ? z0 : least;
        most = z0 > most ? z0 : most;
      }
    }
    const bool quiet = (least + row.leaked_before > row.low[i]) &
                       (most + row.leaked < row.high[i]) & (light >= 0) & (light <= kMax);
    row.may_fire[i] = static_cast<unsigned char>(!quiet);
  }
}

auto kernel_for(int order, bool own_time, int level) {
  if (order == 0) return compiled_for<advance_row<0, false>>(level);
  if (order == 1) {
    return own_time ? compiled_for<advance_row<1, true>>(level)
                    : compiled_for<advance_row<1, false>>(level);
  }
  return own_time ? compiled_for<advance_row<2, true>>(level)
                  : compiled_for<advance_row<2, false>>(level);
}

}  // namespace

Photoreceptor::Photoreceptor(const EventCameraSpec& spec)
    : response_(spec.log_epsilon, spec.linear_below),
      order_((spec.photoreceptor_hz > 0 ? 1 : 0) + (spec.follower_hz > 0 ? 1 : 0)),
      rad_s_(2 * std::numbers::pi * spec.photoreceptor_hz * spec.illuminance_lux / kReferenceLux),
      dark_rad_s_(2 * std::numbers::pi *
                  (spec.photoreceptor_hz > 0 ? spec.photoreceptor_dark_hz : spec.follower_hz)),
      follower_rad_s_(2 * std::numbers::pi * spec.follower_hz) {}

Charge Photoreceptor::at(const Charge& before, double luminance, double u1, double dt_s,
                         double t_s) const {
  if (t_s <= 0) return before;
  const double change = (u1 - before.u) * t_s / dt_s;
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
      const Kept<double> left = kept(x1, first, x2, decay(x2));
      out.z = out.u + left.z * (before.z - before.u) + left.y * (before.y - before.u) -
              left.rise * change;
    }
  } else {
    out.z = out.y;
  }
  return out;
}

double Photoreceptor::straight_s(const Charge& now, double luminance, double slope_1s,
                                 double tolerance) const {
  const double w1 = cutoff_rad_s(luminance), w2 = follower_rad_s_;
  // y is a straight line plus p exp(-w1 t).
  const double p_w1 = std::abs(w1 * (now.y - now.u) + slope_1s);
  const double from_line = std::abs(now.z - now.u + slope_1s * (1 / w1 + 1 / w2));
  if (p_w1 / w1 + from_line < tolerance) return std::numeric_limits<double>::infinity();
  // z'' = w2 (y' - z'), and (y' - z')' = y'' - w2 (y' - z').
  const double apart = std::abs(w1 * (now.u - now.y) - w2 * (now.y - now.z));
  const double curvature = w2 * (apart + p_w1 * (w1 / std::max(w1, w2)));
  // A chord over h strays by up to curvature h^2/8, and the curvature only falls.
  return std::sqrt(8 * tolerance / curvature);
}

void Photoreceptor::advance(const Row& row) const {
  static const int level = widest_vector_level();
  advance(row, level);
}

void Photoreceptor::advance(const Row& row, int vector_level) const {
  const Constants constants = {response_, static_cast<float>(rad_s_),
                               static_cast<float>(dark_rad_s_),
                               static_cast<float>(follower_rad_s_)};
  kernel_for(order_, row.dt_s != nullptr, vector_level)(constants, row);
}

}  // namespace dodgesim

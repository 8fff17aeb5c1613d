#include "sim/events/photoreceptor.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numbers>
#include <type_traits>

#include "sim/base/branchless.h"
#include "sim/events/spec.h"

namespace dodgesim {

namespace {

// Two low-passes are taken as equal when their cut-offs differ by less than this share: the
// difference of nearly equal numbers would be worse than the mean of both ends.
template <class Number>
constexpr Number kEqualShare = std::is_same_v<Number, float> ? Number(0.01) : Number(0.001);

// For numbers that are not negative, whose order is that of their bits: when the numbers themselves
// are compared, compilers compute everything that follows for both outcomes.
[[gnu::always_inline]] inline float at_most(float x, float most) {
  return std::bit_cast<float>(
      std::min(std::bit_cast<std::uint32_t>(x), std::bit_cast<std::uint32_t>(most)));
}
[[gnu::always_inline]] inline float at_least(float x, float least) {
  return std::bit_cast<float>(
      std::max(std::bit_cast<std::uint32_t>(x), std::bit_cast<std::uint32_t>(least)));
}

// How a low-pass answers over an interval of x tau: exp(-x), and its mean over the interval.
template <class Number>
struct Decay {
  Number k, m;
};

// Both to within 3e-7. x = n ln 2 + r with |r| <= ln(2)/2, and exp(-r) = 1 - r q, where q is fitted
// so that the greatest error is least (3e-8).
[[gnu::always_inline]] inline Decay<float> decay(float x) {
  constexpr float kLeast = 1e-30f;       // in so short a time nothing happens
  constexpr float kMost = 80;            // after so long nothing is left
  constexpr float kRound = 12582912.0f;  // 1.5 * 2^23: adding it rounds to an integer
  constexpr float kLn2 = 0.693147181f;
  constexpr std::uint32_t kOne = 0x3f800000u;
  const float some = at_least(x, kLeast), within = at_most(some, kMost);
  const float shifted = within * 1.44269504f + kRound;
  const float r = within - (shifted - kRound) * kLn2;
  // Summed in pairs and with the division on its own, so that nothing waits long for anything.
  const float r2 = r * r;
  const float low = 1.0f - r * 0.5f;
  const float middle = 0.166665046f - r * 0.041666239f;
  const float high = 0.00836922227f - r * 0.00139487038f;
  const float q = low + r2 * (middle + r2 * high);
  // 2^-n: the lowest bits of `shifted` are those of n.
  const float halved = std::bit_cast<float>(kOne - (std::bit_cast<std::uint32_t>(shifted) << 23));
  const float fallen = (halved * r) * q;
  return {halved - fallen, ((1.0f - halved) + fallen) * (1.0f / some)};
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

// -1 where a and b are on different sides of 0, else 0.
[[gnu::always_inline]] inline std::int32_t apart(float a, float b) {
  return (std::bit_cast<std::int32_t>(a) ^ std::bit_cast<std::int32_t>(b)) >> 31;
}

// Positive, or +0, and finite.
[[gnu::always_inline]] inline bool is_plain(float x) {
  constexpr std::uint32_t kInfinity = 0x7f800000u;
  return std::bit_cast<std::uint32_t>(x) < kInfinity;
}

// What the vectoriser needs to know: the arrays of a row do not overlap, and what is the same for
// all pixels is at hand.
template <int kOrder, bool kOwnTime, bool kLinear>
[[gnu::always_inline]] inline void advance_row(Constants c, Photoreceptor::Row row) {
#pragma GCC ivdep
  for (std::size_t i = 0; i < row.size; ++i) {
    const float light1 = row.luminance[i];
    const float u0 = row.u[i];  // not from the light before: a logarithm costs more than to read it
    const float u1 = kLinear ? c.response.at(light1) : c.response.logarithm(light1);
    float least{}, most{};  // of the output from sample to sample
    if constexpr (kOrder == 0) {
      least = smaller(u0, u1);
      most = larger(u0, u1);
    } else {
      const float light0 = row.light[i], y0 = row.y[i];
      const float dt_s = kOwnTime ? row.dt_s[i] : row.same_dt_s;
      const float x1 = (c.dark_rad_s + c.rad_s * (0.5f * light0 + 0.5f * light1)) * dt_s;
      const Decay<float> first = decay(x1);
      const float from0 = y0 - u0, rise = u1 - u0;
      const float from1 = first.k * from0 - first.m * rise;
      const float y1 = u1 + from1;
      // Where y stays on one side of u it only rises or only falls; where it meets u it turns, and
      // u comes from u0.
      const float farthest = chosen(apart(from0, from1), u0, y1);
      least = smaller(smaller(y0, y1), farthest);
      most = larger(larger(y0, y1), farthest);
      if constexpr (kOrder > 1) {
        const float z0 = row.z[i];
        const float x2 = c.follower_rad_s * dt_s;
        const Kept<float> left = kept(x1, first, x2, decay(x2));
        row.z0[i] = z0;
        const float z1 = u1 + left.z * (z0 - u0) + left.y * from0 - left.rise * rise;
        row.z[i] = z1;
        // z follows y, but for rounding.
        least = smaller(smaller(z0, z1), least);
        most = larger(larger(z0, z1), most);
      }
      row.light0[i] = light0;
      row.light[i] = light1;
      row.y0[i] = y0;
      row.y[i] = y1;
    }
    row.u0[i] = u0;
    row.u[i] = u1;
    const bool quiet = (least + row.leaked_before > row.low[i]) &
                       (most + row.leaked < row.high[i]) & is_plain(light1);
    row.may_fire[i] = static_cast<unsigned char>(!quiet);
  }
}

template <int kOrder, bool kOwnTime>
auto kernel_for(bool linear, int level) {
  return linear ? compiled_for<advance_row<kOrder, kOwnTime, true>>(level)
                : compiled_for<advance_row<kOrder, kOwnTime, false>>(level);
}

auto kernel_for(int order, bool own_time, bool linear, int level) {
  if (order == 0) return kernel_for<0, false>(linear, level);
  if (order == 1) {
    return own_time ? kernel_for<1, true>(linear, level) : kernel_for<1, false>(linear, level);
  }
  return own_time ? kernel_for<2, true>(linear, level) : kernel_for<2, false>(linear, level);
}

}  // namespace

Photoreceptor::Photoreceptor(const EventCameraSpec& spec)
    : response_(spec.log_epsilon, spec.linear_below),
      order_((spec.photoreceptor_hz > 0 ? 1 : 0) + (spec.follower_hz > 0 ? 1 : 0)),
      rad_s_(2 * std::numbers::pi * spec.photoreceptor_hz * spec.illuminance_lux / kBrightLux),
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

void Photoreceptor::advance(const Row& row, int level) const {
  const Constants constants = {response_, static_cast<float>(rad_s_),
                               static_cast<float>(dark_rad_s_),
                               static_cast<float>(follower_rad_s_)};
  const bool linear = response_.linear_somewhere();
  kernel_for(order_, row.dt_s != nullptr, linear, level)(constants, row);
}

}  // namespace dodgesim

#include "sim/events/photoreceptor.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "sim/base/vector_level.h"
#include "sim/events/spec.h"

namespace dodgesim {

namespace {

constexpr double kReferenceLux = 1000;

// Longer intervals in units of tau are taken as this; the polynomial below stays finite.
constexpr float kLongest = 1e4f;

// Two low-passes are taken as equal when their cut-offs differ by less than this share.
constexpr double kEqualShare = 0.01;

// How a low-pass answers over an interval of x tau: exp(-x), and its mean over the interval.
template <class Number>
struct Decay {
  Number k, m;
};

// exp(x) by its series up to x^8: exp(-x) to within 5e-4 for any x >= 0.
[[gnu::always_inline]] inline Decay<float> decay(float x) {
  x = x < kLongest ? x : kLongest;
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

// To within 1e-9, and the same on every machine, which libm's exp is not.
Decay<double> decay(double x) {
  constexpr double kSmall = 0.01;  // below, a series
  if (x < kSmall) {
    const double m = 1 - x * (1.0 / 2 - x * (1.0 / 6 - x * (1.0 / 24 - x * (1.0 / 120))));
    return {1 - x * m, m};
  }
  const double k = transient_left(x);
  return {k, (1 - k) / x};
}

// What a unit of y's transient at the start leaves in z: the follower's answer to exp(-t/tau).
template <class Number>
[[gnu::always_inline]] inline Number passed_on(Number x1, Number k1, Number x2, Number k2) {
  const Number difference = x2 - x1;
  const Number apart = difference < 0 ? -difference : difference;
  const bool equal = apart < static_cast<Number>(kEqualShare) * x2;
  return equal ? x2 * k2 : (k1 - k2) * x2 / (equal ? Number{1} : difference);
}

// What a unit of u's rise over the interval takes from z because y lags behind u:
// (1 - k2 - passed_on)/x1, written so that small x1 and x2 cancel nothing.
template <class Number>
[[gnu::always_inline]] inline Number lagged(Number x1, Number m1, Number x2, Number m2, Number k2) {
  constexpr auto kSmall = static_cast<Number>(0.05);  // below, a series
  const Number difference = x2 - x1;
  const Number apart = difference < 0 ? -difference : difference;
  const bool equal = apart < static_cast<Number>(kEqualShare) * x2;
  const Number series = x2 * (Number{1} / 2 - x2 * (Number{1} / 3 - x2 * (Number{1} / 8)));
  const Number same = x2 < kSmall ? series : m2 - k2;
  return equal ? same : x2 * (m1 - m2) / (equal ? Number{1} : difference);
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
        const Decay<float> second = decay(x2);
        const float g = passed_on(x1, first.k, x2, second.k);
        row.z1[i] = u1 + second.k * (z0 - u0) + g * (y0 - u0) -
                    (second.m + lagged(x1, first.m, x2, second.m, second.k)) * (u1 - u0);
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
      const Decay<double> second = decay(x2);
      const double g = passed_on(x1, first.k, x2, second.k);
      out.z = out.u + second.k * (before.z - before.u) + g * (before.y - before.u) -
              (second.m + lagged(x1, first.m, x2, second.m, second.k)) * change;
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

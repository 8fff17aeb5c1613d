#include <algorithm>
#include <cmath>

#include "sim/events/photoreceptor.h"
#include "sim/events/pixel_signal.h"

namespace dodgesim {

namespace {

constexpr double kSecondsPerUs = 1e-6;

// The bounds are rounded to float; this keeps them on the safe side.
constexpr double kBoundMargin = 1e-6;

class FilteredSignal : public PixelSignal {
 public:
  FilteredSignal(const EventCameraSpec& spec, std::size_t pixels, double leak_per_s,
                 double tolerance)
      : photoreceptor_(spec),
        order_(photoreceptor_.order()),
        leak_per_us_(leak_per_s * kSecondsPerUs),
        tolerance_(tolerance),
        u_(pixels),
        light_(order_ > 0 ? pixels : 0),
        y_(order_ > 0 ? pixels : 0),
        z_(order_ > 1 ? pixels : 0),
        low_(pixels),
        high_(pixels) {}

  void reset(const float* luminance) override {
    for (std::size_t i = 0; i < u_.size(); ++i) u_[i] = photoreceptor_.response(luminance[i]);
    std::copy_n(luminance, light_.size(), light_.begin());
    if (order_ > 0) y_ = u_;
    if (order_ > 1) z_ = u_;
  }

  void begin() override { curves_.clear(); }

  void scan(const RowPart& part, unsigned char* may_fire) override {
    for (auto* const before : {&light0_, &u0_, &y0_, &z0_}) before->resize(part.size);
    Photoreceptor::Row row{};
    row.size = part.size;
    row.luminance = part.luminance;
    if (part.last_us != nullptr) {
      dt_s_.resize(part.size);
      for (std::size_t i = 0; i < part.size; ++i) dt_s_[i] = interval_s(part.t_us, part.last_us[i]);
      row.dt_s = dt_s_.data();
    } else {
      row.same_dt_s = interval_s(part.t_us, part.same_last_us);
    }
    row.light = order_ > 0 ? light_.data() + part.first : nullptr;
    row.u = u_.data() + part.first;
    row.y = order_ > 0 ? y_.data() + part.first : nullptr;
    row.z = order_ > 1 ? z_.data() + part.first : nullptr;
    row.light0 = light0_.data();
    row.u0 = u0_.data();
    row.y0 = y0_.data();
    row.z0 = z0_.data();
    row.low = low_.data() + part.first;
    row.high = high_.data() + part.first;
    // The leak only raises S, and no pixel's last sample is older than that of all.
    row.leaked_before = static_cast<float>(leak_per_us_ * part.same_last_us);
    row.leaked = static_cast<float>(leak_per_us_ * part.t_us);
    row.may_fire = may_fire;
    photoreceptor_.advance(row);
  }

  void take(const RowPart& part, std::span<const std::uint32_t> places,
            std::vector<Candidate>& candidates) override {
    for (const std::uint32_t i : places) {
      const std::size_t index = part.first + i;
      const double dt_s = kSecondsPerUs * (part.t_us - part.last_sample_us(i));
      const Charge before = charge(u0_, y0_, z0_, i), after = charge(u_, y_, z_, index);
      Candidate candidate{};
      candidate.index = static_cast<std::uint32_t>(index);
      candidate.curve = static_cast<std::uint32_t>(curves_.size());
      candidate.t0_us = part.last_sample_us(i);
      candidate.s0 = before.z + leak_per_us_ * candidate.t0_us;
      candidate.s1 = after.z + leak_per_us_ * part.t_us;
      const double slope_1s = (after.u - before.u) / dt_s;
      const double light = order_ > 0 ? 0.5 * (static_cast<double>(light0_[i]) + light_[index]) : 0;
      candidate.rise_per_us = kSecondsPerUs * slope_1s + leak_per_us_;
      candidate.decay_per_us = decay_per_us(light);
      candidates.push_back(candidate);
      if (order_ > 1) curves_.push_back({before, light, after.u, dt_s, slope_1s});
    }
  }

  void finish(std::span<Candidate>) override {}

  void knots(const Candidate& candidate, double t1_us, std::vector<Knot>& knots) const override {
    const Curve& c = curves_[candidate.curve];
    Charge now = c.before;
    double t_s = photoreceptor_.straight_s(now, c.luminance, c.slope_1s, tolerance_);
    while (t_s < c.dt_s) {
      now = photoreceptor_.at(c.before, c.luminance, c.u1, c.dt_s, t_s);
      const double t_us = std::min(candidate.t0_us + t_s / kSecondsPerUs, t1_us);
      knots.push_back({t_us, now.z + leak_per_us_ * t_us});
      t_s += photoreceptor_.straight_s(now, c.luminance, c.slope_1s, tolerance_);
    }
    knots.push_back({t1_us, candidate.s1});
  }

  void set_bounds(std::span<const SignalBounds> bounds) override {
    // What is never reached is infinite.
    const auto rounded = [](double bound, double inward) {
      const double margin = std::isinf(bound) ? 0 : kBoundMargin * (1 + std::abs(bound));
      return static_cast<float>(bound + inward * margin);
    };
    for (const SignalBounds& b : bounds) {
      low_[b.index] = rounded(b.low, 1);
      high_[b.index] = rounded(b.high, -1);
    }
  }

  double value(std::size_t index, double t_us) const override {
    return charge(u_, y_, z_, index).z + leak_per_us_ * t_us;
  }

  double settles_in_us(std::size_t index, double rest) const override {
    if (order_ == 0) return 0;
    // What two low-passes in a row still miss falls below this much of the most that either misses,
    // times exp(-t / sum of their time constants): 2 / sqrt(e), when they are alike.
    constexpr double kOfTwo = 1.2131;
    const Charge now = charge(u_, y_, z_, index);
    double missing = std::abs(now.u - now.z);
    if (order_ > 1) missing = kOfTwo * std::max(missing, std::abs(now.u - now.y));
    if (missing <= rest) return 0;
    return natural_log(missing / rest) * photoreceptor_.lag_s(light_[index]) / kSecondsPerUs;
  }

  double rebase(std::size_t index, float luminance) override {
    const float u = photoreceptor_.response(luminance);
    const float change = u - u_[index];
    const double before = charge(u_, y_, z_, index).z;
    u_[index] = u;
    if (order_ > 0) light_[index] = luminance;
    if (order_ > 0) y_[index] += change;
    if (order_ > 1) z_[index] += change;
    return charge(u_, y_, z_, index).z - before;
  }

 private:
  // Of a candidate.
  struct Curve {
    Charge before;
    double luminance, u1, dt_s;  // the light between the samples, u at the second
    double slope_1s;             // of u
  };

  double decay_per_us(double luminance) const {
    if (order_ == 0) return 0;
    return order_ == 1 ? kSecondsPerUs * photoreceptor_.cutoff_rad_s(luminance) : -1;
  }

  Charge charge(const std::vector<float>& u, const std::vector<float>& y,
                const std::vector<float>& z, std::size_t i) const {
    Charge out;
    out.u = u[i];
    out.y = order_ > 0 ? y[i] : out.u;
    out.z = order_ > 1 ? z[i] : out.y;
    return out;
  }

  static float interval_s(double t_us, double last_us) {
    return static_cast<float>(kSecondsPerUs * (t_us - last_us));
  }

  Photoreceptor photoreceptor_;
  int order_;
  double leak_per_us_;
  double tolerance_;
  // At each pixel's last sample; y_, z_ as far as the order goes, light_ if there is a low-pass.
  std::vector<float> u_, light_, y_, z_;
  std::vector<float> low_, high_;
  std::vector<float> dt_s_;
  // What they were at the sample before, of the part that was scanned last.
  std::vector<float> light0_, u0_, y0_, z0_;
  std::vector<Curve> curves_;
};

}  // namespace

std::unique_ptr<PixelSignal> make_filtered_signal(const EventCameraSpec& spec, std::size_t pixels,
                                                  double leak_per_s, double tolerance) {
  return std::make_unique<FilteredSignal>(spec, pixels, leak_per_s, tolerance);
}

}  // namespace dodgesim

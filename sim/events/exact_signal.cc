#include <algorithm>

#include "sim/base/vector_level.h"
#include "sim/events/luminance_bounds.h"
#include "sim/events/pixel_signal.h"
#include "sim/events/response.h"

namespace dodgesim {

namespace {

// In place.
template <double (Response::*kFunction)(double) const>
[[gnu::always_inline]] inline void apply(const Response& response, double* values,
                                         std::size_t size) {
  for (std::size_t i = 0; i < size; ++i) values[i] = (response.*kFunction)(values[i]);
}

class ExactSignal : public PixelSignal {
 public:
  ExactSignal(const EventCameraSpec& spec, std::size_t pixels)
      : response_(spec.log_epsilon, spec.linear_below),
        luminance_(pixels),
        bounds_(pixels, spec.log_epsilon) {}

  void reset(const float* luminance) override {
    std::copy_n(luminance, luminance_.size(), luminance_.begin());
  }

  void begin() override { values_.clear(); }

  void scan(const RowPart& part, unsigned char* may_fire) override {
    bounds_.scan(part.first, part.size, part.luminance, may_fire);
  }

  void take(const RowPart& part, std::span<const std::uint32_t> places,
            std::vector<Candidate>& candidates) override {
    float* const last = luminance_.data() + part.first;
    for (const std::uint32_t i : places) {
      candidates.push_back(
          {static_cast<std::uint32_t>(part.first) + i, 0, part.last_sample_us(i), 0, 0, 0, 0});
      values_.push_back(last[i]);
      values_.push_back(part.luminance[i]);
    }
    std::copy_n(part.luminance, part.size, last);
  }

  void finish(std::span<Candidate> candidates) override {
    const auto respond = compiled_for<apply<&Response::at>>(vector_level());
    respond(response_, values_.data(), values_.size());
    for (std::size_t i = 0; i < candidates.size(); ++i) {
      candidates[i].s0 = values_[2 * i];
      candidates[i].s1 = values_[2 * i + 1];
    }
  }

  void set_bounds(std::span<const SignalBounds> bounds) override {
    const auto invert = compiled_for<apply<&Response::inverse>>(vector_level());
    limits_.resize(2 * bounds.size());
    for (std::size_t i = 0; i < bounds.size(); ++i) {
      limits_[2 * i] = bounds[i].low;
      limits_[2 * i + 1] = bounds[i].high;
    }
    invert(response_, limits_.data(), limits_.size());
    for (std::size_t i = 0; i < bounds.size(); ++i) {
      bounds_.set(bounds[i].index, limits_[2 * i], limits_[2 * i + 1]);
    }
  }

  double value(std::size_t index, double) const override { return response_.at(luminance_[index]); }

  double rebase(std::size_t index, float luminance) override {
    const double before = response_.at(luminance_[index]);
    luminance_[index] = luminance;
    return response_.at(luminance) - before;
  }

 private:
  Response response_;
  std::vector<float> luminance_;  // at each pixel's last sample
  LuminanceBounds bounds_;
  std::vector<double> values_;  // of the candidates: before and now
  std::vector<double> limits_;  // of bounds that are set
};

}  // namespace

std::unique_ptr<PixelSignal> make_exact_signal(const EventCameraSpec& spec, std::size_t pixels) {
  return std::make_unique<ExactSignal>(spec, pixels);
}

}  // namespace dodgesim

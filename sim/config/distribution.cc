#include "sim/config/distribution.h"

#include <algorithm>
#include <utility>

#include "sim/base/normal_distribution.h"

namespace dodgesim {

namespace {

std::size_t choose(double p, std::size_t count) {
  return std::min(static_cast<std::size_t>(p * static_cast<double>(count)), count - 1);
}

// Quantile of the normal cut at lo <= mean <= hi.
double cut_normal_quantile(double p, double mean, double sd, double lo, double hi) {
  const double a = (lo - mean) / sd;
  const double b = (hi - mean) / sd;
  const double p_a = normal_cdf(a);
  const double q = p_a + p * (normal_cdf(b) - p_a);
  if (q <= 0) return lo;
  if (q >= 1) return hi;
  return std::clamp(mean + sd * normal_quantile(q), lo, hi);
}

}  // namespace

Distribution Distribution::constant(double value) { return {Kind::kConstant, {value}, 0, 0}; }

Distribution Distribution::uniform(double lo, double hi) {
  return {Kind::kUniform, {lo, hi}, 0, 0};
}

Distribution Distribution::normal(double mean, double sd, double lo, double hi) {
  return {Kind::kNormal, {mean, sd}, lo, hi};
}

Distribution Distribution::choice(std::vector<double> values) {
  return {Kind::kChoice, std::move(values), 0, 0};
}

double Distribution::largest() const {
  return kind == Kind::kNormal ? hi : *std::ranges::max_element(values);
}

double Distribution::quantile(double p) const {
  switch (kind) {
    case Kind::kConstant:
      return values[0];
    case Kind::kUniform:
      return values[0] + p * (values[1] - values[0]);
    case Kind::kNormal:
      return cut_normal_quantile(p, values[0], values[1], lo, hi);
    case Kind::kChoice:
      return values[choose(p, values.size())];
  }
  return values[0];
}

const Distribution& Components::part(int i) const {
  return parts.size() == 1 ? parts[0] : parts[static_cast<std::size_t>(i)];
}

const std::string& NameChoice::draw(RandomStream& stream) const {
  return names[choose(stream.uniform(), names.size())];
}

}  // namespace dodgesim

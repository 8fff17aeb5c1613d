#include "sim/config/resolve_throw.h"

#include <cmath>
#include <numbers>
#include <string>

namespace dodgesim {

namespace {

class Draws {
 public:
  // Of one of the objects of throw `index`.
  Draws(std::uint64_t seed, int index, std::size_t object)
      : seed_(seed),
        index_(static_cast<std::uint64_t>(index)),
        prefix_(object == 0 ? "throw/" : "throw" + std::to_string(object) + "/") {}

  double number(const std::string& key, const Distribution& distribution) const {
    RandomStream stream = named(key);
    return distribution.draw(stream);
  }

  double component(const std::string& key, const Components& components, int i) const {
    return number(key + "/" + std::to_string(i), components.part(i));
  }

  RandomStream named(const std::string& key) const { return {seed_, index_, prefix_ + key}; }

 private:
  std::uint64_t seed_;
  std::uint64_t index_;
  std::string prefix_;
};

// Uniform on the unit sphere (Archimedes: the height is uniform).
Eigen::Vector3d random_direction(RandomStream& stream) {
  const double z = stream.uniform(-1, 1);
  const double angle = stream.uniform(0, 2 * std::numbers::pi);
  const double r = std::sqrt(1 - z * z);
  return {r * std::cos(angle), r * std::sin(angle), z};
}

Eigen::Vector3d draw_spin(const Draws& draws, const Components& spin) {
  if (spin.parts.size() == 1) {
    RandomStream axis = draws.named("spin_axis");
    // Plus zero: what does not spin has no direction, not even a zero's sign.
    return draws.number("spin_radps", spin.parts[0]) * random_direction(axis) +
           Eigen::Vector3d::Zero();
  }
  return {draws.component("spin_radps", spin, 0), draws.component("spin_radps", spin, 1),
          draws.component("spin_radps", spin, 2)};
}

TimeUs whole_ticks_us(double time_s) {
  return static_cast<TimeUs>(std::llround(time_s * 1e6 / static_cast<double>(kTickUs))) * kTickUs;
}

Throw resolve(const ThrowSpec& spec, const Draws& draws) {
  Throw toss;
  RandomStream object = draws.named("object");
  toss.object.kind = spec.object.draw(object);
  toss.object.size_m = draws.number("size_m", spec.size_m);
  toss.speed_mps = draws.number("speed_mps", spec.speed_mps);
  toss.distance_m = draws.number("distance_m", spec.distance_m);
  toss.bearing_deg = draws.number("bearing_deg", spec.bearing_deg);
  toss.aim_offset_m = {draws.component("aim_offset_m", spec.aim_offset_m, 0),
                       draws.component("aim_offset_m", spec.aim_offset_m, 1)};
  toss.spin_radps = draw_spin(draws, spec.spin_radps);
  toss.launch_height_m = draws.number("launch_height_m", spec.launch_height_m);
  toss.launch_us = whole_ticks_us(draws.number("launch_s", spec.launch_s));
  return toss;
}

}  // namespace

std::vector<Throw> resolve_throws(const Scenario& scenario, int index) {
  std::vector<Throw> throws;
  for (const ThrowSpec& spec : scenario.throw_specs()) {
    const std::size_t first = throws.size();
    for (int k = 0; k < spec.count; ++k) {
      throws.push_back(resolve(spec, Draws(scenario.seed, index, throws.size())));
      throws.back().launch_us = throws[first].launch_us + whole_ticks_us(k * spec.interval_s);
    }
  }
  return throws;
}

}  // namespace dodgesim

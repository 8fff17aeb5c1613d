// What a key of `throw` may be: a number, or a distribution from which every throw draws its own.
// Each draw takes exactly one uniform number and maps it through the quantile function, so that two
// scenarios with the same seed share their draws where they share the distribution, and vary
// together (common random numbers) where they do not.
#pragma once

#include <string>
#include <vector>

#include "sim/base/random.h"

namespace dodgesim {

struct Distribution {
  enum class Kind { kConstant, kUniform, kNormal, kChoice };

  static Distribution constant(double value);
  static Distribution uniform(double lo, double hi);  // lo <= hi
  // sd > 0, cut at lo <= mean <= hi.
  static Distribution normal(double mean, double sd, double lo, double hi);
  static Distribution choice(std::vector<double> values);  // not empty

  Kind kind = Kind::kConstant;
  std::vector<double> values = {0.0};  // constant {x}, uniform {lo, hi}, normal {mean, sd}, choice
  double lo = 0, hi = 0;               // of a normal: the values are cut here (no mass outside)

  double largest() const;
  double quantile(double p) const;  // p in [0, 1)
  double draw(RandomStream& stream) const { return quantile(stream.uniform()); }

  bool operator==(const Distribution&) const = default;
};

// A vector of independent components. One part stands for all components, each with its own draw.
struct Components {
  int count = 1;
  std::vector<Distribution> parts = {Distribution{}};  // 1 or `count`

  const Distribution& part(int i) const;
  bool operator==(const Components&) const = default;
};

// A name, or several of which every throw draws one.
struct NameChoice {
  std::vector<std::string> names;  // not empty

  const std::string& draw(RandomStream& stream) const;
  bool operator==(const NameChoice&) const = default;
};

}  // namespace dodgesim

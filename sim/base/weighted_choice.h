// Draws one of many things, each as often as its weight says, in the same time however many there
// are: Walker's alias method (1977), set up as Vose (1991) does.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

namespace dodgesim {

class WeightedChoice {
 public:
  WeightedChoice() = default;
  // Weights are finite and not negative, and not all are 0; at least one, at most 2^32 - 1.
  explicit WeightedChoice(std::span<const double> weights);

  // The number of the thing that 64 random bits choose. One of weight 0 never is.
  std::uint32_t pick(std::uint32_t bits, std::uint32_t more_bits) const;

 private:
  // Of the draws that meet the place of a thing, a share goes to that thing, the rest to another.
  struct Place {
    double own_share = 1;
    std::uint32_t other = 0;
  };
  std::vector<Place> places_;
};

}  // namespace dodgesim

// Named counter-based random streams (Philox4x32-10). A stream is a pure function of (seed, throw
// index, name, counter): independent of the order in which streams are read, of threads and shards.
#pragma once

#include <array>
#include <cstdint>
#include <string_view>

namespace dodgesim {

class RandomStream {
 public:
  // seed 0 is a seed like any other.
  RandomStream(std::uint64_t seed, std::uint64_t throw_index, std::string_view name);

  // Sequential draws.
  std::uint32_t next_u32();
  double uniform();  // in [0, 1), 53 bits
  double uniform(double lo, double hi) { return lo + (hi - lo) * uniform(); }
  double normal();  // mean 0, standard deviation 1 (inverse CDF, portable)

  // Random access: the 128-bit block number `counter` of this stream. Does not disturb the
  // sequential draws (which use a counter range of their own).
  std::array<std::uint32_t, 4> block(std::uint64_t counter) const;

 private:
  std::array<std::uint32_t, 4> philox(std::uint64_t low, std::uint32_t high) const;

  std::uint64_t key_;
  std::uint32_t throw_index_;
  std::uint64_t next_block_ = 0;
  std::array<std::uint32_t, 4> buffer_{};
  int buffered_ = 0;
};

// Random bits of the number `counter` under a key (SplitMix64, Steele et al. 2014): for the many
// small draws for which a block of a stream costs too much. Take the key from a stream.
inline std::uint64_t mixed_bits(std::uint64_t key, std::uint64_t counter) {
  std::uint64_t bits = key + counter * 0x9e3779b97f4a7c15u;
  bits = (bits ^ (bits >> 30)) * 0xbf58476d1ce4e5b9u;
  bits = (bits ^ (bits >> 27)) * 0x94d049bb133111ebu;
  return bits ^ (bits >> 31);
}

// Maps 32 random bits to (0, 1), never 0 and never 1.
inline double unit_interval(std::uint32_t bits) {
  return (static_cast<double>(bits) + 0.5) * (1.0 / 4294967296.0);
}

}  // namespace dodgesim

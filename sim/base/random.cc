#include "sim/base/random.h"

#include <Random123/philox.h>
#include <xxhash.h>

#include <stdexcept>

#include "sim/base/normal_distribution.h"

namespace dodgesim {

RandomStream::RandomStream(std::uint64_t seed, std::uint64_t throw_index, std::string_view name)
    : key_(XXH64(name.data(), name.size(), seed)),
      throw_index_(static_cast<std::uint32_t>(throw_index)) {
  if (throw_index > 0xffffffffu) throw std::invalid_argument("The throw index exceeds 32 bits.");
}

std::array<std::uint32_t, 4> RandomStream::philox(std::uint64_t low, std::uint32_t high) const {
  const r123::Philox4x32::ctr_type counter = {
      {static_cast<std::uint32_t>(low), static_cast<std::uint32_t>(low >> 32), throw_index_, high}};
  const r123::Philox4x32::key_type key = {
      {static_cast<std::uint32_t>(key_), static_cast<std::uint32_t>(key_ >> 32)}};
  const auto out = r123::Philox4x32{}(counter, key);
  return {out[0], out[1], out[2], out[3]};
}

std::array<std::uint32_t, 4> RandomStream::block(std::uint64_t counter) const {
  return philox(counter, 1);
}

std::uint32_t RandomStream::next_u32() {
  if (buffered_ == 0) {
    buffer_ = philox(next_block_++, 0);
    buffered_ = 4;
  }
  return buffer_[static_cast<std::size_t>(--buffered_)];
}

double RandomStream::uniform() {
  const std::uint64_t high = next_u32() >> 5;
  const std::uint64_t low = next_u32() >> 6;
  return static_cast<double>((high << 26) | low) * (1.0 / 9007199254740992.0);
}

double RandomStream::normal() {
  // 52 bits, centred in their cells: never 0 and never 1, where the quantile is infinite.
  const std::uint64_t high = next_u32() >> 6;
  const std::uint64_t low = next_u32() >> 6;
  const double cell = static_cast<double>((high << 26) | low);
  return normal_quantile((cell + 0.5) * (1.0 / 4503599627370496.0));
}

}  // namespace dodgesim

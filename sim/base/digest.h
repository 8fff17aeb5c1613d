// How digests are written.
#pragma once

#include <cinttypes>
#include <cstdint>
#include <string>

#include "sim/base/formatted.h"

namespace dodgesim {

// 16 hexadecimal digits.
inline std::string digits_of(std::uint64_t digest) { return formatted("%016" PRIx64, digest); }

}  // namespace dodgesim

// UTF-8 (RFC 3629).
#pragma once

#include <cstddef>
#include <string_view>

namespace dodgesim {

// Length of the well-formed sequence at the start of `text`, which is not empty, or 0.
std::size_t utf8_length(std::string_view text);

}  // namespace dodgesim

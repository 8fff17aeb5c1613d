// Numbers in sentences.
#pragma once

#include <string>

namespace dodgesim {

// What printf would print, however long it is. (GCC 12 has no std::format.)
[[gnu::format(printf, 1, 2)]] std::string formatted(const char* format, ...);

}  // namespace dodgesim

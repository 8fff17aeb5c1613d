#include "sim/base/formatted.h"

#include <cstdarg>
#include <cstdio>

namespace dodgesim {

std::string formatted(const char* format, ...) {
  // clang-tidy believes them uninitialised, but only when it is given several files.
  // NOLINTBEGIN(clang-analyzer-valist.Uninitialized)
  va_list values;
  va_start(values, format);
  const int size = std::vsnprintf(nullptr, 0, format, values);
  va_end(values);
  std::string text(static_cast<std::size_t>(size > 0 ? size : 0), '\0');
  va_start(values, format);
  std::vsnprintf(text.data(), text.size() + 1, format, values);
  va_end(values);
  // NOLINTEND(clang-analyzer-valist.Uninitialized)
  return text;
}

}  // namespace dodgesim

// State of the process that foreign code may change and our numbers depend on.
#pragma once

#include <locale.h>

#include <cfenv>

namespace dodgesim {

// Saves the floating-point environment (rounding, denormal numbers) and restores it on destruction.
class KeptRounding {
 public:
  KeptRounding() { std::fegetenv(&environment_); }
  ~KeptRounding() { std::fesetenv(&environment_); }
  KeptRounding(const KeptRounding&) = delete;
  KeptRounding& operator=(const KeptRounding&) = delete;

 private:
  std::fenv_t environment_;
};

// From here on the C functions of this thread read and write numbers with a point, whatever
// setlocale() is told; streams follow std::locale::global().
inline void keep_decimal_point() {
  static const locale_t c_locale = ::newlocale(LC_ALL_MASK, "C", nullptr);
  if (c_locale != nullptr) ::uselocale(c_locale);
}

}  // namespace dodgesim

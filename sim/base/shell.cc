#include "sim/base/shell.h"

#include <algorithm>
#include <cctype>
#include <string_view>

namespace dodgesim {

std::string shell_quoted(const std::string& word) {
  constexpr std::string_view kPlain = "_-./=+,:";
  const bool plain = std::ranges::all_of(word, [&](unsigned char c) {
    return std::isalnum(c) != 0 || kPlain.find(static_cast<char>(c)) != std::string_view::npos;
  });
  if (plain && !word.empty()) return word;
  std::string quoted = "'";
  for (const char c : word) quoted += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return quoted + "'";
}

}  // namespace dodgesim

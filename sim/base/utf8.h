// UTF-8 (RFC 3629).
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace dodgesim {

// Length of the well-formed sequence at the start of `text`, which is not empty, or 0.
std::size_t utf8_length(std::string_view text);

inline constexpr std::string_view kReplacement = "\xef\xbf\xbd";  // U+FFFD

// What is no UTF-8 of the text becomes U+FFFD.
std::string valid_utf8(std::string_view text);

// The text as it may be shown in a terminal: control characters, and what is no UTF-8, as \x07.
std::string printable(std::string_view text);

// The first character beyond ASCII, which may look like a space or a letter of ASCII, as "U+00A0";
// empty if there is none or it is no UTF-8.
std::string beyond_ascii(std::string_view text);

}  // namespace dodgesim

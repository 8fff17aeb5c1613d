// Numbers as text, exact in both directions and independent of the locale.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace dodgesim {

// Text that reads back as the same double, as short as possible or nearly so: 0.0001 rather than
// 1e-04. Finite values only.
std::string to_text(double value);
inline std::string to_text(int value) { return std::to_string(value); }
inline std::string to_text(std::int64_t value) { return std::to_string(value); }
inline std::string to_text(std::uint64_t value) { return std::to_string(value); }

// What a plain YAML scalar is when a number is wanted. Stricter than YAML: a number written with
// leading zeros (octal in some readers), in hexadecimal, .nan or .inf is not one.
enum class NumberForm { kDecimal, kInteger, kLeadingZero, kNotFinite, kNone };
NumberForm number_form(std::string_view text);

// Requires number_form kDecimal or kInteger. Empty when beyond the range of double.
std::optional<double> parse_double(std::string_view text);

// The text as a number; empty if it is none, or beyond the range of double.
std::optional<double> as_number(std::string_view text);

// The text, but a number in the spelling of to_text(), however it is written: 0.10 is 0.1.
std::string with_one_spelling(const std::string& text);

// Requires number_form kInteger. Empty when beyond the range of the type.
template <class Integer>
std::optional<Integer> parse_integer(std::string_view text);

}  // namespace dodgesim

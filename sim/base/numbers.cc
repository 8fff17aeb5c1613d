#include "sim/base/numbers.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>

#include "sim/base/contains.h"

namespace dodgesim {

namespace {

bool is_digit(char c) { return c >= '0' && c <= '9'; }

std::string_view without_sign(std::string_view text) {
  if (!text.empty() && (text[0] == '+' || text[0] == '-')) text.remove_prefix(1);
  return text;
}

std::size_t count_digits(std::string_view text) {
  std::size_t n = 0;
  while (n < text.size() && is_digit(text[n])) ++n;
  return n;
}

bool names_no_finite_number(std::string_view body) {
  std::string lower(body);
  std::transform(lower.begin(), lower.end(), lower.begin(), [](char c) {
    return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
  });
  static constexpr std::array kNames = {".nan", ".inf", "nan", "inf", "infinity"};
  return contains(kNames, lower);
}

// std::from_chars takes no plus sign.
std::string_view without_plus(std::string_view text) {
  if (!text.empty() && text[0] == '+') text.remove_prefix(1);
  return text;
}

}  // namespace

std::string to_text(double value) {
  std::array<char, 32> shortest, fixed;
  const auto a = std::to_chars(shortest.data(), shortest.data() + shortest.size(), value);
  std::string text(shortest.data(), a.ptr);
  const auto b =
      std::to_chars(fixed.data(), fixed.data() + fixed.size(), value, std::chars_format::fixed);
  if (b.ec != std::errc()) return text;
  const std::string plain(fixed.data(), b.ptr);
  // 100000 rather than 1e+05, but 1e-12.
  constexpr std::size_t kWorthReading = 3;
  return plain.size() <= text.size() + kWorthReading ? plain : text;
}

NumberForm number_form(std::string_view text) {
  std::string_view rest = without_sign(text);
  if (names_no_finite_number(rest)) return NumberForm::kNotFinite;
  const std::size_t whole = count_digits(rest);
  const bool leading_zero = whole > 1 && rest[0] == '0';
  rest.remove_prefix(whole);
  if (rest.empty() && whole > 0) {
    return leading_zero ? NumberForm::kLeadingZero : NumberForm::kInteger;
  }
  std::size_t fraction = 0;
  if (!rest.empty() && rest[0] == '.') {
    rest.remove_prefix(1);
    fraction = count_digits(rest);
    rest.remove_prefix(fraction);
  }
  if (whole + fraction == 0) return NumberForm::kNone;
  if (!rest.empty() && (rest[0] == 'e' || rest[0] == 'E')) {
    rest = without_sign(rest.substr(1));
    const std::size_t exponent = count_digits(rest);
    if (exponent == 0) return NumberForm::kNone;
    rest.remove_prefix(exponent);
  }
  if (!rest.empty()) return NumberForm::kNone;
  return leading_zero ? NumberForm::kLeadingZero : NumberForm::kDecimal;
}

std::optional<double> parse_double(std::string_view text) {
  text = without_plus(text);
  double value = 0;
  const auto result = std::from_chars(text.data(), text.data() + text.size(), value);
  // Below the smallest double from_chars reports an error too, although zero would do.
  if (result.ec != std::errc() || !std::isfinite(value)) return std::nullopt;
  return value;
}

std::optional<double> as_number(std::string_view text) {
  const NumberForm form = number_form(text);
  if (form != NumberForm::kDecimal && form != NumberForm::kInteger) return std::nullopt;
  return parse_double(text);
}

template <class Integer>
std::optional<Integer> parse_integer(std::string_view text) {
  text = without_plus(text);
  Integer value = 0;
  const auto result = std::from_chars(text.data(), text.data() + text.size(), value);
  if (result.ec != std::errc() || result.ptr != text.data() + text.size()) return std::nullopt;
  return value;
}

template std::optional<int> parse_integer<int>(std::string_view);
template std::optional<std::int64_t> parse_integer<std::int64_t>(std::string_view);
template std::optional<std::uint64_t> parse_integer<std::uint64_t>(std::string_view);

std::string with_one_spelling(const std::string& text) {
  const std::optional<double> number = as_number(text);
  return number ? to_text(*number) : text;
}

}  // namespace dodgesim

#include "sim/base/numbers.h"

#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <limits>
#include <utility>

#include "sim/base/random.h"

namespace dodgesim {
namespace {

TEST(Numbers, EveryDoubleReadsBackAsItself) {
  RandomStream stream(3, 0, "doubles");
  for (int i = 0; i < 100000; ++i) {
    const std::uint64_t high = stream.next_u32();
    const auto value = std::bit_cast<double>((high << 32) | stream.next_u32());
    if (!std::isfinite(value) || std::fpclassify(value) == FP_SUBNORMAL) continue;
    const std::optional<double> again = parse_double(to_text(value));
    ASSERT_TRUE(again.has_value()) << to_text(value);
    EXPECT_EQ(std::bit_cast<std::uint64_t>(*again), std::bit_cast<std::uint64_t>(value));
  }
}

TEST(Numbers, TextIsShortAndEasyToRead) {
  EXPECT_EQ(to_text(100000.0), "100000");
  EXPECT_EQ(to_text(0.0007), "0.0007");
  EXPECT_EQ(to_text(1e-12), "1e-12");
  EXPECT_EQ(to_text(1e300), "1e+300");
  EXPECT_EQ(to_text(0.1), "0.1");
  EXPECT_EQ(to_text(3.0), "3");
  EXPECT_EQ(to_text(-0.30000000000000004), "-0.30000000000000004");
}

TEST(Numbers, FormsAreToldApart) {
  using enum NumberForm;
  const std::pair<const char*, NumberForm> forms[] = {{"0", kInteger},
                                                      {"-12", kInteger},
                                                      {"+7", kInteger},
                                                      {"1.", kDecimal},
                                                      {".5", kDecimal},
                                                      {"1e-3", kDecimal},
                                                      {"-1.5E+10", kDecimal},
                                                      {"0.5", kDecimal},
                                                      {"010", kLeadingZero},
                                                      {"-00", kLeadingZero},
                                                      {"01.5", kLeadingZero},
                                                      {".nan", kNotFinite},
                                                      {"-.INF", kNotFinite},
                                                      {"Infinity", kNotFinite},
                                                      {"", kNone},
                                                      {"-", kNone},
                                                      {".", kNone},
                                                      {"1e", kNone},
                                                      {"0x10", kNone},
                                                      {"1_000", kNone},
                                                      {"1 2", kNone},
                                                      {"e5", kNone},
                                                      {"1,5", kNone},
                                                      {"++1", kNone}};
  for (const auto& [text, form] : forms) EXPECT_EQ(number_form(text), form) << text;
}

TEST(Numbers, WhatDoesNotFitIsEmpty) {
  EXPECT_FALSE(parse_double("1e999").has_value());
  EXPECT_FALSE(parse_integer<int>("2147483648").has_value());
  EXPECT_FALSE(parse_integer<std::uint64_t>("-1").has_value());
  EXPECT_EQ(parse_integer<std::int64_t>("-9223372036854775808"),
            std::numeric_limits<std::int64_t>::min());
  EXPECT_EQ(parse_integer<int>("+5"), 5);
}

TEST(Numbers, TextIsANumberAsAWholeOrNotAtAll) {
  EXPECT_EQ(as_number("-0.5"), -0.5);
  EXPECT_EQ(as_number("+12"), 12);
  for (const char* text : {"", "12 m", "010", ".inf", "1e999", "0x10"}) {
    EXPECT_FALSE(as_number(text).has_value()) << text;
  }
}

}  // namespace
}  // namespace dodgesim

#include "sim/render/key_kernels.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <vector>

#include "sim/base/random.h"
#include "sim/base/vector_level.h"

namespace dodgesim {
namespace {

constexpr float kInf = std::numeric_limits<float>::infinity();
constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
constexpr float kSmallestFloat = std::numeric_limits<float>::denorm_min();
constexpr float kSmallestNormalHalf = 0x1p-14f, kSmallestHalf = 0x1p-24f;

template <class T>
bool same_bytes(const std::vector<T>& a, const std::vector<T>& b) {
  return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof(T)) == 0;
}

// Which of many NaNs comes out is not said.
bool same_numbers(std::vector<float> a, std::vector<float> b) {
  for (auto* const numbers : {&a, &b}) {
    std::replace_if(
        numbers->begin(), numbers->end(), [](float x) { return std::isnan(x); }, kNan);
  }
  return same_bytes(a, b);
}

// Each function of the kernels over some inputs, one after the other.
struct Results {
  std::vector<std::uint16_t> halves;
  std::vector<float> means, sharp, largest, places, spans, read;
};

// Coordinates of a row of cells.
struct Coordinates {
  std::vector<float> first, step;

  explicit Coordinates(int cells) : first(static_cast<std::size_t>(cells)), step(first.size()) {}
  CellRow row() { return {first.data(), step.data()}; }
};

// From a number drawn within the limits to another one, cell by cell.
Coordinates scattered(int cells, double limit, RandomStream& random) {
  Coordinates out(cells);
  for (std::size_t i = 0; i < out.first.size(); ++i) {
    const double first = random.uniform(0, limit), last = random.uniform(0, limit);
    out.first[i] = static_cast<float>(first);
    out.step[i] = static_cast<float>((last - first) / kKeyCellPx);
  }
  return out;
}

Coordinates on_a_line(int cells, float from, float step) {
  Coordinates out(cells);
  for (std::size_t i = 0; i < out.first.size(); ++i) {
    out.first[i] = from + step * static_cast<float>(kKeyCellPx * i);
    out.step[i] = step;
  }
  return out;
}

std::vector<float> luminances(int size, RandomStream& random) {
  const float special[] = {0,
                           -0.0f,
                           -1,
                           kNan,
                           kInf,
                           -kInf,
                           65504,
                           65519.9f,
                           65520,
                           65536,
                           1e30f,
                           kSmallestHalf,
                           6e-5f,
                           kSmallestFloat,
                           1e-39f,
                           1.00048f,
                           1,
                           1.0005f,
                           kSmallestNormalHalf};
  std::vector<float> values;
  for (int i = 0; i < size; ++i) {
    const auto kind = static_cast<std::size_t>(random.uniform(0, 3 * std::size(special)));
    values.push_back(kind < std::size(special)
                         ? special[kind]
                         : static_cast<float>(std::exp(random.uniform(-20, 12))));
  }
  return values;
}

constexpr int kStride = 37, kRows = 29;

std::vector<float> depths(RandomStream& random) {
  std::vector<float> inverse_depth;
  for (int i = 0; i < kStride * kRows; ++i) {
    const double kind = random.uniform();
    inverse_depth.push_back(kind < 0.2    ? 0.0f
                            : kind < 0.21 ? kSmallestFloat
                                          : static_cast<float>(random.uniform(0, 3)));
  }
  return inverse_depth;
}

// The kernels that take three rows of numbers.
void take_rows(const KeyKernels& kernels, int size, RandomStream& random, Results& out) {
  constexpr int kRows = 3;
  const int stride = kRows * size + 5;
  const auto rows = luminances(kRows * stride, random);
  std::vector<float> scratch(static_cast<std::size_t>(stride)), row(scratch.size());
  const auto keep = [&row](int count, std::vector<float>& results) {
    results.insert(results.end(), row.begin(), row.begin() + count);
  };
  kernels.means(rows.data(), stride, kRows, size + kRows - 1, scratch.data(), row.data());
  keep(size, out.means);
  const float* const middle = rows.data() + stride;
  kernels.sharpen(rows.data(), middle, middle + stride, size, scratch.data(), row.data());
  keep(size, out.sharp);
  kernels.largest(rows.data(), stride, kRows, size, row.data());
  keep(size, out.largest);
}

Results results(const KeyKernels& kernels, int size) {
  Results out;
  RandomStream random(7, static_cast<std::uint64_t>(size), "kernels");
  for (int trial = 0; trial < 20; ++trial) {
    take_rows(kernels, size, random, out);
    const auto means = luminances(size, random);
    std::vector<std::uint16_t> halves(static_cast<std::size_t>(size));
    kernels.halve(means.data(), size, halves.data());
    out.halves.insert(out.halves.end(), halves.begin(), halves.end());

    const auto inverse_depth = depths(random);
    KeyMap map{};
    for (float& d : map.direction) d = static_cast<float>(random.uniform(-0.05, 0.05));
    map.direction[8] = 1;
    for (float& t : map.t) t = static_cast<float>(random.uniform(-0.2, 0.2));
    map.f = 20, map.cx = 18, map.cy = 14;
    map.last_column = kStride - 1, map.last_row = kRows - 1;
    map.inverse_depth = inverse_depth.data();
    map.stride = kStride;
    if (trial % 4 == 1) map.direction[static_cast<std::size_t>(trial) % 9] = kNan;
    if (trial % 4 == 2) map.t[trial % 3] = trial % 8 < 4 ? kInf : kNan;
    if (trial % 4 == 3) map.direction[8] = -1;
    std::vector<float> x(static_cast<std::size_t>(size)), y(x.size());
    kernels.place(map, static_cast<float>(trial), 8, 3, size, x.data(), y.data());
    out.places.insert(out.places.end(), x.begin(), x.end());
    out.places.insert(out.places.end(), y.begin(), y.end());

    std::vector<float> above, below;
    for (int i = 0; i <= size; ++i) {
      above.push_back(static_cast<float>(random.uniform(0, 600)));
      below.push_back(static_cast<float>(random.uniform(0, 600)));
    }
    Coordinates span(size);
    kernels.span(above.data(), below.data(), 0.375f, size, span.row());
    out.spans.insert(out.spans.end(), span.first.begin(), span.first.end());
    out.spans.insert(out.spans.end(), span.step.begin(), span.step.end());

    const int wide = 3 * kKeyCellPx * size + 2, high = 90;
    std::vector<std::uint16_t> picture(
        static_cast<std::size_t>(wide * (high + kKeySpareRows) + kKeySpareMeans));
    std::vector<float> read(static_cast<std::size_t>(kKeyCellPx * size));
    const auto bright = luminances(wide * high, random);
    kernels.halve(bright.data(), wide * high, picture.data());
    // Scattered, or along lines as a camera reads them: level, rolled a little, a lot, backwards.
    const bool backwards = trial % 8 == 1;
    const float right = static_cast<float>(random.uniform(1, 2.9)) * (backwards ? -1 : 1);
    const auto steep = static_cast<float>(random.uniform(-0.4, 0.4));
    const auto pixels = static_cast<float>(kKeyCellPx * size);
    const float down =
        trial % 4 == 2 ? 0 : steep * std::min(1.0f, 2 * static_cast<float>(high - 2) / pixels);
    const auto last_u = static_cast<float>(wide) - 1.01f, last_v = static_cast<float>(high) - 1.01f;
    Coordinates u = trial % 4 ? on_a_line(size, backwards ? last_u : 0, right)
                              : scattered(size, last_u, random);
    Coordinates v =
        trial % 4 ? on_a_line(size, down > 0 ? 0 : last_v, down) : scattered(size, last_v, random);
    kernels.read(picture.data(), wide, u.row(), v.row(), size, read.data());
    out.read.insert(out.read.end(), read.begin(), read.end());
  }
  return out;
}

struct Way {
  int level;
  bool gathers;
};

// All but the portable one.
std::vector<Way> every_way() {
  std::vector<Way> ways;
  for (int level = kPortable + 1; level <= widest_vector_level(); ++level) {
    ways.push_back({level, true});
    if (level == kAvx512) ways.push_back({level, false});
  }
  return ways;
}

TEST(KeyKernels, GiveTheSameBytesAtEveryVectorWidth) {
  for (const auto& [level, gathers] : every_way()) {
    for (const int size : {1, 2, 7, 8, 15, 16, 17, 31, 33, 64, 101}) {
      const Results narrow = results(key_kernels(kPortable), size);
      const Results wide = results(key_kernels(level, gathers), size);
      EXPECT_TRUE(same_numbers(wide.means, narrow.means)) << level << ", " << size;
      EXPECT_TRUE(same_numbers(wide.sharp, narrow.sharp)) << level << ", " << size;
      EXPECT_TRUE(same_numbers(wide.largest, narrow.largest)) << level << ", " << size;
      EXPECT_TRUE(same_bytes(wide.halves, narrow.halves)) << level << ", " << size;
      EXPECT_TRUE(same_bytes(wide.places, narrow.places)) << level << ", " << size;
      EXPECT_TRUE(same_bytes(wide.spans, narrow.spans)) << level << ", " << size;
      EXPECT_TRUE(same_bytes(wide.read, narrow.read)) << level << ", " << size;
    }
  }
}

TEST(KeyKernels, TheDefaultIsOfTheWidestLevelThatTheProcessorHas) {
  const int level = widest_vector_level();
  EXPECT_TRUE(&key_kernels() == &key_kernels(level, true) ||
              &key_kernels() == &key_kernels(level, false));
}

// What is read in a picture of 2 x 2 such means.
float read_alone(std::uint16_t half) {
  const std::uint16_t means[4 + 2 * kKeySpareRows + kKeySpareMeans] = {half, half, half, half};
  float zero = 0;
  float out[kKeyCellPx] = {-1};
  key_kernels().read(means, 2, {&zero, &zero}, {&zero, &zero}, 1, out);
  return out[0];
}

std::uint16_t half_of(float value) {
  std::uint16_t half = 0;
  key_kernels().halve(&value, 1, &half);
  return half;
}

float round_trip(float value) { return read_alone(half_of(value)); }

TEST(KeyKernels, HalfPrecisionKeepsElevenBits) {
  RandomStream random(1, 0, "half");
  for (int i = 0; i < 20000; ++i) {
    const auto value = static_cast<float>(std::exp2(random.uniform(-13.99, 15.99)));
    ASSERT_LE(std::abs(round_trip(value) - value), 0x1p-11f * value) << value;
  }
}

TEST(KeyKernels, HalfPrecisionIsThatOfTheStandard) {
  // IEEE 754: binary16 of 1 is 0x3c00, of the largest number 0x7bff, of the smallest normal 0x0400.
  const struct {
    float value;
    std::uint16_t half;
  } values[] = {
      {0, 0x0000},     {1, 0x3c00},   {0.5f, 0x3800},           {1.0009765625f, 0x3c01},
      {65504, 0x7bff}, {2.5, 0x4100}, {0.333251953125, 0x3555}, {kSmallestNormalHalf, 0x0400}};
  for (const auto& [value, half] : values) {
    EXPECT_EQ(half_of(value), half) << value;
    EXPECT_EQ(round_trip(value), value);
  }
}

TEST(KeyKernels, EveryHalfIsReadAsItIsPacked) {
  for (std::uint32_t half = 0; half <= 0x7bff; ++half) {
    const float value = read_alone(static_cast<std::uint16_t>(half));
    const double mantissa = half & 0x3ff;
    const int exponent = static_cast<int>(half >> 10);
    const double expected =
        exponent == 0 ? std::ldexp(mantissa, -24) : std::ldexp(1024 + mantissa, exponent - 25);
    ASSERT_EQ(value, expected) << half;
    ASSERT_EQ(round_trip(value), value) << half;
  }
}

TEST(KeyKernels, WhatHalfPrecisionCannotHoldIsBounded) {
  EXPECT_EQ(round_trip(65504), 65504);
  for (const float large : {65505.0f, 65520.0f, 70000.0f, 1e38f, kInf}) {
    EXPECT_EQ(round_trip(large), 65504) << large;
  }
  for (const float none : {-0.0f, -1.0f, -kInf, kSmallestFloat, 0.49f * kSmallestHalf}) {
    EXPECT_EQ(round_trip(none), 0) << none;
  }
  EXPECT_EQ(round_trip(kNan), 0);
  // Denormal halves keep their steps.
  EXPECT_EQ(round_trip(kSmallestHalf), kSmallestHalf);
  EXPECT_NEAR(round_trip(5e-5f), 5e-5f, 0.5 * kSmallestHalf);
}

TEST(KeyKernels, ReadLinearlyBetweenFourMeans) {
  // Two rows of three, and room for the pixels of a cell that are not looked at.
  std::vector<float> values = {1, 2, 4, 8, 16, 32};
  values.resize(values.size() + std::size_t{3} * kKeySpareRows + kKeySpareMeans);
  std::vector<std::uint16_t> means(values.size());
  key_kernels().halve(values.data(), static_cast<int>(values.size()), means.data());
  float u[] = {0.25f, 0, 1.5f}, v[] = {0.5f, 0.75f, 0.25f}, none[] = {0, 0, 0};
  float out[3 * kKeyCellPx];
  key_kernels().read(means.data(), 3, {u, none}, {v, none}, 3, out);
  for (int i = 0; i < kKeyCellPx; ++i) {
    EXPECT_EQ(out[i], 0.5f * (1.25f + 10));
    EXPECT_EQ(out[kKeyCellPx + i], 0.25f * 1 + 0.75f * 8);
    EXPECT_EQ(out[2 * kKeyCellPx + i], 0.75f * 3 + 0.25f * 24);
  }
  // Along the row.
  float first = 0.25f, step = 0.125f, level = 0;
  key_kernels().read(means.data(), 3, {&first, &step}, {&level, none}, 1, out);
  for (int i = 0; i < kKeyCellPx; ++i) {
    const float at = first + step * static_cast<float>(i);
    EXPECT_EQ(out[i], at < 1 ? 1 + at : 2 + 2 * (at - 1));
  }
}

TEST(KeyKernels, SpanIsBilinearInACell) {
  const float above[] = {3, 11, 5}, below[] = {7, 31, 1};
  Coordinates span(2);
  key_kernels().span(above, below, 0.25f, 2, span.row());
  for (std::size_t cell = 0; cell < 2; ++cell) {
    for (int i = 0; i < kKeyCellPx; ++i) {
      const float right = static_cast<float>(i) / kKeyCellPx;
      const float left_end = 0.75f * above[cell] + 0.25f * below[cell];
      const float right_end = 0.75f * above[cell + 1] + 0.25f * below[cell + 1];
      EXPECT_NEAR(span.first[cell] + span.step[cell] * static_cast<float>(i),
                  left_end + right * (right_end - left_end), 1e-5f);
    }
  }
}

// A fronto-parallel wall at 1/rho, and a key without rotation: the closed form of a translation.
TEST(KeyKernels, PlaceMovesAPointByItsDepth) {
  const float rho = 0.5f;
  const std::vector<float> wall(kStride * kRows, rho);
  KeyMap map{{0.05f, 0, -0.9f, 0, 0.05f, -0.7f, 0, 0, 1},
             {0.1f, -0.2f, 0.3f},
             20,
             18,
             14,
             kStride - 1,
             kRows - 1,
             wall.data(),
             kStride};
  float x[5], y[5];
  key_kernels().place(map, 2, 8, 5, 5, x, y);
  for (int i = 0; i < 5; ++i) {
    const double dx = 0.05 * (2 + 8 * i) - 0.9, dy = 0.05 * 5 - 0.7;
    const double length = 1 / 0.5 - 0.3;  // along the axis, from the camera to the wall
    EXPECT_NEAR(x[i], 20 * (dx * length + 0.1) * 0.5 + 18, 1e-4);
    EXPECT_NEAR(y[i], 20 * (dy * length - 0.2) * 0.5 + 14, 1e-4);
  }
}

TEST(KeyKernels, PlaceLeavesOutWhatLiesBehindTheKey) {
  const std::vector<float> sky(kStride * kRows, 0.0f);
  KeyMap map{{0.05f, 0, -0.9f, 0, 0.05f, -0.7f, 0, 0, -1},
             {0, 0, 0},
             20,
             18,
             14,
             kStride - 1,
             kRows - 1,
             sky.data(),
             kStride};
  float x[3], y[3];
  key_kernels().place(map, 2, 8, 5, 3, x, y);
  for (const float value : x) EXPECT_LT(value, 0);
}

}  // namespace
}  // namespace dodgesim

#include "sim/render/key_picture.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <numeric>

#include "sim/base/random.h"
#include "tests/sim/render/key_picture_views.h"

namespace dodgesim {
namespace {

using namespace testing;  // NOLINT(google-build-using-namespace)
using Eigen::Isometry3d;
using Eigen::Vector3d;

constexpr double kHalfPrecision = 0x1p-11;  // largest relative error

bool shows(KeyPicture& key, const Isometry3d& X_WC) {
  std::vector<float> out = blank(small_view());
  const bool done = key.show(X_WC, whole(small_view()), out.data());
  EXPECT_EQ(done, out != blank(small_view()));  // all or nothing
  return done;
}

TEST(KeyPicture, SeenFromWhereItWasDrawnIsTheMeanOverEachPixelsAperture) {
  for (int n = 1; n <= 4; ++n) {
    KeySpec spec;
    spec.supersampling = n;
    spec.max_misplacement_px = 0;  // every picture is drawn, and shown as it is
    KeyPicture key(small_view(), spec);
    const Intrinsics fine = key.intrinsics();
    RandomStream random(1, static_cast<std::uint64_t>(n), "noise");
    std::vector<float> noise(pixels_of(fine)), wall(pixels_of(fine), 0.5f);
    for (float& value : noise) value = static_cast<float>(random.uniform(0, 1));
    const Isometry3d X_WC = pose(turn(1, {1, 2, 3}), {1, 2, 3});
    key.set(X_WC, noise, wall);
    const auto out = shown(key, X_WC);
    const int margin = static_cast<int>(spec.margin_px);
    double largest = 0;
    for (int y = 0; y < 120; ++y) {
      for (int x = 0; x < 160; ++x) {
        double sum = 0;
        for (int k = 0; k < n * n; ++k) {
          const int column = n * (x + margin) + k % n, row = n * (y + margin) + k / n;
          sum += noise[index_of(fine, column, row)];
        }
        const double mean = sum / (n * n);
        const double error = out[index_of(small_view(), x, y)] - mean;
        largest = std::max(largest, std::abs(error) - kHalfPrecision * mean);
      }
    }
    EXPECT_LT(largest, 2e-4) << n;  // places are right to some 1e-5 px of white noise
  }
}

// Of waves of amplitude a and wave number k [1/px], read between means that are h px apart, each of
// h-spaced rays: (kh)^2/8 in each direction, and by k^2 (1/24 - 1/32) in each for the means.
double reading_error(double amplitude, double wavelength_px, double h) {
  const double k = 2 * M_PI / wavelength_px;
  const double misplaced_px = 0.02;  // the map runs straight between nodes
  return amplitude * (2 * k * k * h * h / 8 + 2 * k * k * h * h / 24 + k * misplaced_px) +
         kHalfPrecision;
}

TEST(KeyPicture, SeesWhatATurnedCameraSees) {
  const double wavelength_px = 12;
  const AnalyticScene scene = sky_waves(wavelength_px);
  const Isometry3d drawn = pose(turn(0.1, {1, 1, 0}));
  KeyPicture key = key_of(scene, drawn);
  // Up to 30 px in the corners.
  const struct {
    Vector3d axis;
    double rad;
  } turns[] = {{{1, 0, 0}, 0.13},  {{1, 0, 0}, -0.06}, {{0, 1, 0}, 0.12},
               {{0, 1, 0}, -0.03}, {{0, 0, 1}, 0.3},   {{0, 0, 1}, -0.2},
               {{1, -1, 0}, 0.1},  {{1, 2, 3}, -0.13}, {{-1, 0.5, 2}, 0.001}};
  for (const auto& [axis, rad] : turns) {
    const Isometry3d X_WC = drawn * pose(turn(rad, axis));
    const auto truth = photograph(scene, small_view(), X_WC);
    const auto out = shown(key, X_WC);
    EXPECT_LT(largest_difference(out, truth), reading_error(0.2, wavelength_px, 0.5))
        << axis.transpose() << ", " << rad;
    if (std::abs(rad) > 0.02) {
      EXPECT_GT(largest_difference(out, photograph(scene, small_view(), drawn)), 0.1);
    }
  }
}

TEST(KeyPicture, IsTheMoreExactTheFinerItIsDrawn) {
  const AnalyticScene scene = sky_waves(8);
  const Isometry3d X_WC = pose(turn(0.0637, {1, 2, 3}));
  const auto truth = photograph(scene, small_view(), X_WC);
  double before = std::numeric_limits<double>::infinity();
  for (const int n : {1, 2, 4}) {
    KeySpec spec;
    spec.supersampling = n;
    KeyPicture key = key_of(scene, kAtOrigin, spec);
    const double error = largest_difference(shown(key, X_WC), truth);
    EXPECT_LT(error, reading_error(0.2, 8, 1.0 / n));
    EXPECT_LT(error, 0.5 * before);
    before = error;
  }
}

TEST(KeyPicture, SeesATiltedWallAsACameraSeesItThatHasMoved) {
  // 2 to 5 m away; waves of no less than 12 px where it is nearest.
  const AnalyticScene wall = plane(Vector3d(0.4, -0.2, 1).normalized(), 2.8, 0.3);
  KeySpec spec;
  spec.max_zoom = 1;
  KeyPicture key = key_of(wall, kAtOrigin, spec);
  const Vector3d shifts[] = {
      {0.2, 0, 0}, {0, -0.2, 0}, {0, 0, 0.2}, {0, 0, -0.2}, {-0.15, 0.1, 0.1}};
  for (const Vector3d& shift : shifts) {
    for (const double rad : {0.0, 0.05}) {
      const Isometry3d X_WC = pose(turn(rad, {1, 2, -1}), shift);
      const auto truth = photograph(wall, small_view(), X_WC);
      const auto out = shown(key, X_WC);
      EXPECT_LT(largest_difference(out, truth), reading_error(0.2, 12, 0.5)) << shift.transpose();
      EXPECT_GT(largest_difference(out, photograph(wall, small_view(), kAtOrigin)), 0.02);
    }
  }
}

TEST(KeyPicture, TheSkyDoesNotMoveWithTheCamera) {
  KeyPicture key = key_of(sky_waves(12), kAtOrigin);
  const auto before = shown(key, kAtOrigin);
  EXPECT_EQ(shown(key, pose(Eigen::Matrix3d::Identity(), {50, -80, 1000})), before);
}

TEST(KeyPicture, ShowsNothingUntilItIsSet) {
  KeyPicture key(small_view(), {});
  EXPECT_FALSE(shows(key, kAtOrigin));
  const Drawn drawn = draw(sky_waves(12), key.intrinsics(), kAtOrigin);
  key.set(kAtOrigin, drawn.luminance, drawn.inverse_depth);
  EXPECT_TRUE(shows(key, kAtOrigin));
}

// The key reaches margin_px beyond the view; what lies right of the view's last node, one pixel
// beyond its last column, must be in it.
TEST(KeyPicture, ShowsNothingOnceTheViewLeavesIt) {
  KeyPicture key = key_of(sky_waves(12), kAtOrigin);
  const double f = kFocalPx;
  const double f_key = key.intrinsics().f / static_cast<double>(KeySpec{}.supersampling);
  const struct {
    Vector3d axis;
    double limit_rad;
  } turns[] = {
      {{0, 1, 0}, std::atan((80.5 + 31) / f_key) - std::atan(80.5 / f)},
      {{0, -1, 0}, std::atan((79.5 + 32) / f_key) - std::atan(79.5 / f)},
      {{1, 0, 0}, std::atan((59.5 + 32) / f_key) - std::atan(59.5 / f)},
      {{-1, 0, 0}, std::atan((60.5 + 31) / f_key) - std::atan(60.5 / f)},
  };
  for (const auto& [axis, limit_rad] : turns) {
    EXPECT_TRUE(shows(key, pose(turn(0.995 * limit_rad, axis)))) << axis.transpose();
    EXPECT_FALSE(shows(key, pose(turn(1.005 * limit_rad, axis)))) << axis.transpose();
  }
  EXPECT_TRUE(shows(key, kAtOrigin));
  EXPECT_FALSE(shows(key, pose(turn(M_PI, {0, 1, 0}))));  // to the back
  EXPECT_FALSE(shows(key, pose(turn(1.6, {1, 0, 0}))));
}

// Were one view sharper than others, a new key would make a burst of events.
TEST(KeyPicture, IsAsSharpFromEveryPose) {
  KeyPicture key = key_of(sky_waves(6), kAtOrigin);
  double least = 1e9, most = 0;
  for (int step = 0; step < 8; ++step) {
    const double shift_rad = step / 8.0 / kFocalPx;
    const auto out = shown(key, pose(turn(shift_rad, {1, 1, 0})));
    double sum = 0, squares = 0;
    for (const float value : out) {
      sum += value;
      squares += value * value;
    }
    const auto n = static_cast<double>(out.size());
    const double contrast = std::sqrt(squares / n - sum / n * sum / n);
    least = std::min(least, contrast);
    most = std::max(most, contrast);
  }
  EXPECT_LT(most, 1.01 * least);
}

TEST(KeyPicture, DrawsEveryPictureIfNothingMayBeMisplaced) {
  KeySpec spec;
  spec.max_misplacement_px = 0;
  KeyPicture key(small_view(), spec);
  const Drawn drawn = draw(sky_waves(12), key.intrinsics(), kAtOrigin);
  key.set(kAtOrigin, drawn.luminance, drawn.inverse_depth);
  EXPECT_TRUE(shows(key, kAtOrigin));
  EXPECT_FALSE(shows(key, pose(turn(1e-5, {0, 1, 0}))));
  EXPECT_FALSE(shows(key, pose(Eigen::Matrix3d::Identity(), {0, 1e-6, 0})));
}

// As a region and the whole picture of the same instant must show the same.
TEST(KeyPicture, ARegionIsOnlyShownWhereTheWholeViewMayBe) {
  KeyPicture key = key_of(sky_waves(12), kAtOrigin);
  std::vector<float> out = blank(small_view());
  for (const double rad : {0.1, 0.15, 0.2}) {
    const Isometry3d right = pose(turn(rad, {0, 1, 0}));
    EXPECT_EQ(key.show(right, {10, 20, 90, 80}, out.data()), shows(key, right)) << rad;
  }
}

// A turned camera of a short focal length bends the picture between the nodes by up to 2 px.
TEST(KeyPicture, AWideViewIsShownWhereItIsOrNotAtAll) {
  const Intrinsics wide{64, 48, 18.5};  // 120 degrees
  const AnalyticScene scene = sky_waves(12 * kFocalPx / wide.f);
  KeyPicture key = key_of(scene, kAtOrigin, {}, wide);
  int shows = 0, refuses = 0;
  for (int step = 0; step < 60; ++step) {
    const double rad = 0.01 * step;
    const Isometry3d X_WC = pose(turn(rad, {1, 2, 0.5}));
    std::vector<float> out = blank(wide);
    if (!key.show(X_WC, whole(wide), out.data())) {
      ++refuses;
      continue;
    }
    ++shows;
    EXPECT_LT(largest_difference(out, photograph(scene, wide, X_WC)),
              reading_error(0.2, 12, 0.5) + 0.2 * 2 * M_PI / 12 * 0.1)
        << rad;
  }
  EXPECT_GT(shows, 1);
  EXPECT_GT(refuses, 1);
}

TEST(KeyPicture, ShowsNothingOnceTheCameraIsTooNearToWhatIsNear) {
  KeySpec spec;
  spec.max_zoom = 0.07;
  KeyPicture key = key_of(plane({0, 0, 1}, 3, 1), kAtOrigin, spec);
  for (const Vector3d& direction : {Vector3d(0, 0, 1), Vector3d(0, 0, -1), Vector3d(1, 0, 0)}) {
    const double limit_m = 0.07 * 3;
    EXPECT_TRUE(shows(key, pose(turn(0, {1, 0, 0}), 0.99 * limit_m * direction)));
    EXPECT_FALSE(shows(key, pose(turn(0, {1, 0, 0}), 1.01 * limit_m * direction)));
  }
}

// Of corner_of_a_wall(): an edge of inverse depth h is misplaced by at most
// f h |t| / cos(angle to the optical axis).
constexpr double kStep = 1.0 - 1.0 / 4;

double misplacement_limit_m(const KeySpec& spec, const Intrinsics& wide) {
  const double secant = std::hypot(1, wide.cx() / wide.f, wide.cy() / wide.f);
  return spec.max_misplacement_px / (kFocalPx * kStep * secant);
}

TEST(KeyPicture, ShowsNothingOnceAnEdgeOfSomethingNearMightBeMisplaced) {
  for (const double limit_px : {0.5, 1.0, 3.0}) {
    KeySpec spec;
    spec.max_misplacement_px = limit_px;
    spec.max_zoom = 1;
    KeyPicture key = key_of(corner_of_a_wall(), kAtOrigin, spec);
    const double limit_m = misplacement_limit_m(spec, {224, 184, kFocalPx});
    for (const Vector3d& direction : {Vector3d(1, 0, 0), Vector3d(0, -0.6, 0.8)}) {
      // Where the step lies between nodes decides what counts of it: all of it, up to twice.
      EXPECT_TRUE(shows(key, pose(turn(0.1, {1, 0, 0}), 0.47 * limit_m * direction)));
      // The rays of the corners count for no more than 1.25.
      EXPECT_FALSE(shows(key, pose(turn(0.1, {1, 0, 0}), 1.3 * limit_m * direction)));
    }
  }
}

// Where the dark wall behind begins in a row, by its mean.
double edge_column(const std::vector<float>& picture, int row) {
  const auto first = picture.begin() + std::ptrdiff_t{row} * 160;
  const double sum = std::accumulate(first, first + 160, 0.0);
  const double bright = *first, dark = *(first + 159);
  return (sum - 160 * dark) / (bright - dark) - 0.5;
}

TEST(KeyPicture, TheEdgeOfSomethingNearIsNoFartherFromItsPlaceThanAllowed) {
  KeySpec spec;
  spec.supersampling = 4;  // one ray each: edges are off by 0.125 px
  spec.max_zoom = 1;
  double largest = 0;
  for (const double start_m : {-0.31, -0.2, 0.0, 0.004, 0.011, 0.016, 0.021, 0.27}) {
    KeyPicture key = key_of(corner_of_a_wall(), pose(turn(0, {1, 0, 0}), {start_m, 0, 0}), spec);
    for (const double sign : {-1.0, 1.0}) {
      for (double x_m = start_m;; x_m += 0.0005 * sign) {
        std::vector<float> out = blank(small_view());
        const Isometry3d X_WC = pose(turn(0, {1, 0, 0}), {x_m, 0, 0});
        if (!key.show(X_WC, whole(small_view()), out.data())) break;
        const double truth = small_view().cx() + kFocalPx * (0.011 - x_m) / 1;
        for (const int row : {0, 33, 119}) {
          largest = std::max(largest, std::abs(edge_column(out, row) - truth));
        }
      }
    }
  }
  EXPECT_LT(largest, spec.max_misplacement_px + 0.2);
  EXPECT_GT(largest, 0.5 * spec.max_misplacement_px);  // the limit is not idle
}

TEST(KeyPicture, ARegionHasTheBitsOfTheWholeView) {
  KeySpec spec;
  spec.max_zoom = 1;
  KeyPicture key = key_of(plane(Vector3d(0.4, -0.2, 1).normalized(), 2.8, 0.3), kAtOrigin, spec);
  const Isometry3d X_WC = pose(turn(0.05, {1, 2, -1}), {0.1, 0.05, -0.1});
  const auto all = shown(key, X_WC);
  for (const Rect& r : {Rect{0, 0, 1, 1}, Rect{7, 9, 8, 100}, Rect{8, 8, 16, 16},
                        Rect{13, 5, 42, 31}, Rect{100, 50, 160, 120}, Rect{0, 119, 160, 120}}) {
    std::vector<float> part = blank(small_view());
    ASSERT_TRUE(key.show(X_WC, r, part.data()));
    for (int y = 0; y < 120; ++y) {
      for (int x = 0; x < 160; ++x) {
        const std::size_t i = index_of(small_view(), x, y);
        const bool inside = x >= r.x0 && x < r.x1 && y >= r.y0 && y < r.y1;
        ASSERT_EQ(part[i], inside ? all[i] : -1.0f) << x << ", " << y;
      }
    }
  }
  std::vector<float> nothing = blank(small_view());
  EXPECT_TRUE(key.show(X_WC, {5, 5, 5, 9}, nothing.data()));
  EXPECT_EQ(nothing, blank(small_view()));
}

TEST(KeyPicture, AViewWhoseSizeIsNoMultipleOfACellIsShownWhole) {
  const Intrinsics view{93, 61, kFocalPx};
  const AnalyticScene scene = sky_waves(12);
  KeyPicture key = key_of(scene, kAtOrigin, {}, view);
  const Isometry3d X_WC = pose(turn(0.05, {1, 2, 1}));
  EXPECT_LT(largest_difference(shown(key, X_WC, view), photograph(scene, view, X_WC)),
            reading_error(0.2, 12, 0.5));
}

TEST(KeyPicture, ANewOneReplacesTheOld) {
  const AnalyticScene near = plane({0, 0, 1}, 2, 0.3), far = sky_waves(12);
  KeyPicture key = key_of(near, kAtOrigin);
  const Drawn drawn = draw(far, key.intrinsics(), kAtOrigin);
  key.set(kAtOrigin, drawn.luminance, drawn.inverse_depth);
  EXPECT_TRUE(shows(key, pose(turn(0, {1, 0, 0}), {5, 0, 0})));
  EXPECT_EQ(key.nearest_m(whole(small_view())), std::numeric_limits<double>::infinity());
}

TEST(KeyPicture, WhatIsNotANumberOrTooBrightIsShownAsANumber) {
  KeyPicture key(small_view(), {});
  std::vector<float> bright(pixels_of(key.intrinsics()), 1e30f), sky(bright.size(), 0.0f);
  key.set(kAtOrigin, bright, sky);
  for (const float value : shown(key, kAtOrigin)) ASSERT_EQ(value, 65504);
}

}  // namespace
}  // namespace dodgesim

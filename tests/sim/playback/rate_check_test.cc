#include "sim/playback/rate_check.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "sim/base/body_axes.h"
#include "sim/base/random.h"

namespace dodgesim {
namespace {

constexpr TimeUs kStepUs = 1000;

dodge::CameraModel forward_camera() {
  dodge::CameraModel camera;
  camera.width = 240;
  camera.height = 180;
  camera.fx = camera.fy = 200;
  camera.cx = 119.5;
  camera.cy = 89.5;
  camera.X_BC.linear() = *axes_named("right down forward");
  return camera;
}

// A camera that turns back and forth among far points, about each axis of the body with an
// amplitude of its own [rad/s]. Each point makes an event every few milliseconds.
struct Film {
  std::vector<Event> events;
  std::vector<ImuReading> rates;  // in B
};

Film film(const Eigen::Vector3d& amplitude_radps, double duration_s = 2) {
  const dodge::CameraModel camera = forward_camera();
  RandomStream random(7, 0, "points");
  std::vector<Eigen::Vector3d> points;
  for (int i = 0; i < 400; ++i) {
    points.push_back(Eigen::Vector3d(1, random.uniform(-1, 1), random.uniform(-0.8, 0.8)));
  }
  Film film;
  Eigen::Quaterniond q_WB = Eigen::Quaterniond::Identity();
  for (TimeUs t_us = 0; seconds(t_us) < duration_s; t_us += kStepUs) {
    Eigen::Vector3d w;
    for (int i = 0; i < 3; ++i) {
      w[i] = amplitude_radps[i] * std::cos(2 * std::numbers::pi * (1.3 + 0.4 * i) * seconds(t_us));
    }
    film.rates.push_back({t_us, w});
    const Eigen::Matrix3d R_CW =
        camera.X_BC.linear().transpose() * q_WB.toRotationMatrix().transpose();
    for (const Eigen::Vector3d& point : points) {
      if (random.uniform(0, 1) > 0.2) continue;
      const Eigen::Vector3d d = R_CW * point;
      const double u = std::round(camera.fx * d.x() / d.z() + camera.cx);
      const double v = std::round(camera.fy * d.y() / d.z() + camera.cy);
      if (d.z() <= 0 || u < 0 || v < 0 || u >= camera.width || v >= camera.height) continue;
      film.events.push_back(
          {t_us, static_cast<std::uint16_t>(u), static_cast<std::uint16_t>(v), 1});
    }
    const Eigen::Vector3d turn = seconds(kStepUs) * w;
    q_WB = q_WB * Eigen::Quaterniond(Eigen::AngleAxisd(turn.norm(), turn.stableNormalized()));
  }
  return film;
}

// As a log says it whose sensor has the axes R_BG, with stamps that are too early by `late_us`, and
// is taken to have the axes `taken`.
RateCheck::Fit fit(const Film& film, const Eigen::Matrix3d& R_BG, const Eigen::Matrix3d& taken,
                   TimeUs late_us = 0) {
  std::vector<ImuReading> rates = film.rates;
  for (ImuReading& rate : rates) {
    rate.t_us -= late_us;
    rate.w_B_radps = taken * R_BG.transpose() * rate.w_B_radps;
  }
  RateCheck check(forward_camera(), rates, taken);
  // In portions, as cycles bring them.
  const std::span<const Event> all(film.events);
  for (std::size_t first = 0; first < all.size(); first += 150) {
    check.add(all.subspan(first, std::min<std::size_t>(150, all.size() - first)));
  }
  return check.fit();
}

const Eigen::Vector3d kTurning(3, 2, 2.5);

TEST(RateCheck, FindsNothingBetterThanTheRightRates) {
  const Eigen::Matrix3d axes = *axes_named("forward left up");
  const RateCheck::Fit right = fit(film(kTurning), axes, axes);
  EXPECT_GT(right.windows, 50);
  EXPECT_GT(right.given, 1.5);
  EXPECT_EQ(right.axes, "");
  EXPECT_EQ(right.shift_us, 0);
}

// Whatever axes a sensor has, and whatever they are taken for.
TEST(RateCheck, NamesTheAxesThatAreMeant) {
  const Film turning = film(kTurning);
  const auto all = all_axes();
  for (std::size_t i = 0; i < all.size(); ++i) {
    const Eigen::Matrix3d& taken = all[(7 * i + 5) % 24];
    if (all[i] == taken) continue;
    const RateCheck::Fit wrong = fit(turning, all[i], taken);
    EXPECT_EQ(wrong.axes, names_of_axes(all[i]));
    EXPECT_EQ(wrong.right_handed, i < 24);
    EXPECT_EQ(wrong.as_good, 0);
    EXPECT_GT(wrong.with_axes, 1.5) << wrong.axes;
    EXPECT_LT(wrong.given, wrong.with_axes / 1.1);
  }
}

TEST(RateCheck, TellsByHowMuchTheClockIsOff) {
  const Film turning = film(kTurning);
  const Eigen::Matrix3d axes = *axes_named("right down forward");
  for (const TimeUs late_us : {-450'000, -80'000, -42'000, 35'000, 300'000}) {
    const RateCheck::Fit wrong = fit(turning, axes, axes, late_us);
    EXPECT_NEAR(static_cast<double>(wrong.shift_us), static_cast<double>(late_us), 5001);
    EXPECT_GT(wrong.with_shift, 1.1 * wrong.given);
    EXPECT_GT(wrong.with_shift, wrong.with_axes);
  }
}

TEST(RateCheck, PassesOverEventsThatComeLate) {
  const Eigen::Matrix3d axes = *axes_named("forward left up");
  Film some_late = film(kTurning), without = some_late;
  without.events.clear();
  for (std::size_t i = 0; i < some_late.events.size(); ++i) {
    if (i % 3 == 2) {
      some_late.events[i].t_us -= 20'000;
    } else {
      without.events.push_back(some_late.events[i]);
    }
  }
  const RateCheck::Fit expected = fit(without, axes, axes),
                       passed_over = fit(some_late, axes, axes);
  EXPECT_EQ(passed_over.windows, expected.windows);
  EXPECT_EQ(passed_over.given, expected.given);
}

// A turn about one axis says where that one points, and nothing of the others.
TEST(RateCheck, SaysHowManyAxesFitAlike) {
  const Film yawing = film({0, 0, 3});
  const RateCheck::Fit wrong =
      fit(yawing, *axes_named("forward left up"), *axes_named("forward right down"));
  EXPECT_EQ(wrong.as_good, 7);
  EXPECT_EQ(wrong.axes.substr(wrong.axes.rfind(' ')), " up");
  EXPECT_TRUE(wrong.right_handed);
}

TEST(RateCheck, LooksAtNothingWhileTheCameraHardlyTurns) {
  const Eigen::Matrix3d axes = Eigen::Matrix3d::Identity();
  EXPECT_EQ(fit(film({0.1, 0.1, 0.1}), axes, axes).windows, 0);
  EXPECT_EQ(RateCheck(forward_camera(), {}, axes).fit().windows, 0);
}

// As of a camera that keeps what it flies around in view: other axes would blur that less, but none
// would make it sharper than it is.
TEST(RateCheck, NamesNoAxesThatAreWorseThanNotTurning) {
  Film still = film(Eigen::Vector3d::Zero());
  still.rates = film({0, 0, 3}).rates;
  const Eigen::Matrix3d axes = *axes_named("right down forward");
  const RateCheck::Fit fitted = fit(still, axes, axes);
  EXPECT_GT(fitted.windows, 50);
  EXPECT_LT(fitted.given, 0.7);
  EXPECT_EQ(fitted.axes, "");
  EXPECT_EQ(fitted.shift_us, 0);
}

// Rates that turn all events out of the image do not make it sharp.
TEST(RateCheck, IsNotDeceivedByRatesThatAreFarTooFast) {
  const Eigen::Matrix3d axes = *axes_named("forward left up");
  Film fast = film(kTurning);
  for (ImuReading& rate : fast.rates) rate.w_B_radps *= 57.3;  // degrees
  EXPECT_LT(fit(fast, axes, axes).given, 0.5);
}

// In so short a time hardly a pixel has two events, and whatever scatters them has some share one.
TEST(RateCheck, DoesNotTakeScatteredEventsForSharpOnes) {
  const Eigen::Matrix3d axes = *axes_named("forward left up");
  Film slow = film({0.3, 0.2, 0.25});
  for (ImuReading& rate : slow.rates) rate.w_B_radps *= 57.3;
  const RateCheck::Fit fitted = fit(slow, axes, axes);
  EXPECT_GT(fitted.windows, 10);
  EXPECT_LT(fitted.given, 1.3);
  EXPECT_EQ(fitted.axes, "");
  EXPECT_EQ(fitted.shift_us, 0);
}

// A long recording is looked at until its end, and not ten times as often as one of a tenth.
TEST(RateCheck, LooksTheLessOftenTheLongerItLasts) {
  const Eigen::Matrix3d axes = Eigen::Matrix3d::Identity();
  const int brief = fit(film(kTurning, 1), axes, axes).windows;
  const int lasting = fit(film(kTurning, 10), axes, axes).windows;
  EXPECT_GT(lasting, brief);
  EXPECT_LT(lasting, 4 * brief);
}

}  // namespace
}  // namespace dodgesim

#include "dodge/monitor/height_monitor.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <optional>

namespace dodge {
namespace {

constexpr TimeUs kPeriodUs = 5000;  // 200 Hz

using OfTime = std::function<double(double t_s)>;

// When a vehicle lands that is truly 2 m above the ground, or never; the readings' error is drawn
// from `range_error` and the estimate's from `estimate_error`, both functions of time.
std::optional<TimeUs> lands_at(HeightMonitor& monitor, TimeUs end_us, const OfTime& estimate_error,
                               const OfTime& range_error) {
  for (TimeUs t = 0; t <= end_us; t += kPeriodUs) {
    monitor.add(t, 2 + estimate_error(seconds(t)), 2 + range_error(seconds(t)));
    if (monitor.drifted()) return t;
  }
  return std::nullopt;
}

double none(double) { return 0; }

// Lands at the first reading that is farther off than `threshold_m`.
HeightMonitorConfig at_once(double threshold_m) {
  HeightMonitorConfig config;
  config.threshold_m = threshold_m;
  config.persist_us = 0;
  return config;
}

// A change of `by` between two times.
OfTime between(double from_s, double to_s, double by) {
  return [=](double t_s) { return t_s >= from_s && t_s < to_s ? by : 0.0; };
}

TEST(HeightMonitor, AConstantErrorOfTheHeightIsNoDrift) {
  for (const double offset_m : {-5.0, -0.4, 0.4, 1.7, 100.0}) {
    HeightMonitor monitor(at_once(1e-9));
    EXPECT_FALSE(lands_at(
        monitor, 20000000, [&](double) { return offset_m; }, none))
        << offset_m;
  }
}

TEST(HeightMonitor, LandsWithinTheTimeThatADriftNeedsUpAndDownAlike) {
  const HeightMonitorConfig config;
  for (const double rate_mps : {0.011, 0.053, 0.19, 1.07, 9.7}) {
    const auto drift = [&](double sign) {
      return [=](double t_s) { return sign * rate_mps * std::max(0.0, t_s - 1); };
    };
    HeightMonitor monitor(config), mirrored(config);
    const auto rises = lands_at(monitor, 60000000, drift(1), none);
    ASSERT_TRUE(rises) << rate_mps;
    const auto reaches_us = static_cast<TimeUs>(1e6 * (1 + config.threshold_m / rate_mps));
    EXPECT_GT(*rises, reaches_us + config.persist_us - 1);
    EXPECT_LE(*rises, reaches_us + config.persist_us + kPeriodUs + 1);
    EXPECT_EQ(lands_at(mirrored, 60000000, drift(-1), none), rises);
  }
}

TEST(HeightMonitor, ItDoesNotMatterHowTheVehicleClimbs) {
  HeightMonitor monitor({});
  for (TimeUs t = 0; t < 10000000; t += kPeriodUs) {
    const double height_m = 3 + 2 * std::sin(2 * seconds(t));
    monitor.add(t, height_m + 0.7, height_m);
    ASSERT_FALSE(monitor.drifted());
  }
}

TEST(HeightMonitor, WhatPassesBelowDoesNotLandTheVehicle) {
  const HeightMonitorConfig config;
  const double persist_s = seconds(config.persist_us);
  HeightMonitor monitor(config);
  // A box is below the vehicle for just too short a time, again and again.
  const OfTime boxes = [&](double t_s) {
    const double phase_s = std::fmod(t_s, 1.0);
    return t_s > 1 && phase_s > 0.5 && phase_s < 0.5 + persist_s ? -0.8 : 0.0;
  };
  EXPECT_FALSE(lands_at(monitor, 20000000, none, boxes));
}

TEST(HeightMonitor, WhatStaysBelowLandsTheVehicle) {
  const HeightMonitorConfig config;
  HeightMonitor monitor(config);
  // A table of 0.78 m.
  EXPECT_EQ(lands_at(monitor, 5000000, none, between(2, 100, -0.78)), 2000000 + config.persist_us);
}

TEST(HeightMonitor, OneOutlierChangesNothing) {
  const auto outlier_at = [](double at_s) {
    return [=](double t_s) { return std::abs(t_s - at_s) < 1e-3 ? 40.0 : 0.0; };
  };
  HeightMonitor flying({}), learning(at_once(1e-9));
  EXPECT_FALSE(lands_at(flying, 3000000, none, outlier_at(2)));
  EXPECT_FALSE(lands_at(learning, 3000000, none, outlier_at(0.1)));
}

TEST(HeightMonitor, OneReadingThatAgreesBreaksTheDiscrepancy) {
  const HeightMonitorConfig config;
  HeightMonitor monitor(config);
  const OfTime apart = [](double t_s) { return t_s >= 1 && std::abs(t_s - 1.25) > 1e-3 ? 0.5 : 0; };
  EXPECT_EQ(lands_at(monitor, 5000000, apart, none), 1255000 + config.persist_us);
}

TEST(HeightMonitor, APauseBreaksTheDiscrepancy) {
  // Apart since 1 s; dodges tilt the vehicle so that no reading can be used for 60 ms, four times a
  // second.
  const auto lands = [](TimeUs pause_us) {
    HeightMonitor monitor({});
    for (TimeUs t = 0; t < 5000000; t += kPeriodUs) {
      if (t % 250000 < pause_us) continue;
      monitor.add(t, t >= 1000000 ? 2.5 : 2.0, 2);
      if (monitor.drifted()) return true;
    }
    return false;
  };
  EXPECT_FALSE(lands(60000));
  EXPECT_TRUE(lands(40000));
}

TEST(HeightMonitor, TwoReadingsFarApartProveNothing) {
  HeightMonitor monitor({});
  EXPECT_FALSE(lands_at(monitor, 1000000, none, none));
  monitor.add(2000000, 3, 2);
  monitor.add(4000000, 3, 2);
  EXPECT_FALSE(monitor.drifted());
}

TEST(HeightMonitor, AClockThatIsSetBackBreaksTheDiscrepancy) {
  HeightMonitorConfig config;
  config.learn_readings = 1;
  HeightMonitor monitor(config);
  monitor.add(1000000, 2, 2);
  monitor.add(1005000, 3, 2);
  for (TimeUs t = 0; t < config.persist_us; t += kPeriodUs) monitor.add(t, 3, 2);
  EXPECT_FALSE(monitor.drifted());
  monitor.add(config.persist_us, 3, 2);
  EXPECT_TRUE(monitor.drifted());
}

TEST(HeightMonitor, OnceDriftedItStaysSo) {
  HeightMonitor monitor({});
  ASSERT_TRUE(lands_at(monitor, 5000000, between(1, 3, 0.5), none));
  for (TimeUs t = 5000000; t < 7000000; t += kPeriodUs) monitor.add(t, 2, 2);
  EXPECT_TRUE(monitor.drifted());
}

TEST(HeightMonitor, SaysNothingWhileItLearnsTheGround) {
  const auto lands = [](double threshold_m) {
    HeightMonitorConfig config = at_once(threshold_m);
    config.learn_readings = 11;
    HeightMonitor monitor(config);
    for (int i = 0; i < 11; ++i) monitor.add(i * kPeriodUs, 2 + 0.1 * (i - 5), 1.9);
    EXPECT_FALSE(monitor.drifted());
    monitor.add(11 * kPeriodUs, 2.25, 1.9);
    return monitor.drifted();
  };
  EXPECT_TRUE(lands(0.25 - 1e-9));
  EXPECT_FALSE(lands(0.25 + 1e-9));
}

}  // namespace
}  // namespace dodge

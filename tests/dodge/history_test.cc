#include "dodge/history.h"

#include <gtest/gtest.h>

#include <cmath>

namespace dodge {
namespace {

TEST(RateHistory, IsZeroWithoutSamplesAndConstantOutsideOfThem) {
  RateHistory rates;
  EXPECT_EQ(rates.mean(0, 1000), Eigen::Vector3d::Zero());
  rates.add({.t_us = 5000, .w_WB_B = {1, 2, 3}});
  EXPECT_EQ(rates.mean(0, 1000), Eigen::Vector3d(1, 2, 3));
  EXPECT_EQ(rates.mean(9000, 9000), Eigen::Vector3d(1, 2, 3));
}

TEST(RateHistory, LeavesOutRatesThatAreNotFinite) {
  RateHistory rates;
  rates.add({.t_us = 0, .w_WB_B = {1, 2, 3}});
  rates.add({.t_us = 500, .w_WB_B = {1, std::nan(""), 3}});
  rates.add({.t_us = 900, .w_WB_B = {-INFINITY, 2, 3}});
  EXPECT_EQ(rates.mean(0, 1000), Eigen::Vector3d(1, 2, 3));
}

TEST(RateHistory, WeighsIrregularSamplesByTime) {
  // A rate that grows linearly has its mean at the middle of the window, whatever the sampling.
  RateHistory rates;
  for (const TimeUs t : {0, 10, 900, 1000, 4000, 4100, 7000, 15000}) {
    rates.add({.t_us = t, .w_WB_B = Eigen::Vector3d(static_cast<double>(t), 0, 0)});
  }
  EXPECT_NEAR(rates.mean(500, 6500).x(), 3500, 1e-9);
  EXPECT_NEAR(rates.mean(4000, 4100).x(), 4050, 1e-9);
}

TEST(RateHistory, KeepsTheNewestSamplesOfALongFlight) {
  RateHistory rates;
  for (TimeUs t = 0; t < 5000000; t += 1000) {
    rates.add({.t_us = t, .w_WB_B = Eigen::Vector3d(t < 4000000 ? 1 : 2, 0, 0)});
  }
  EXPECT_EQ(rates.mean(4980000, 4990000).x(), 2);
}

TEST(RateHistory, ForgetsTheTimeBeforeTheClockWasSetBack) {
  RateHistory rates;
  for (TimeUs t = 0; t < 5000000; t += 1000) rates.add({.t_us = t, .w_WB_B = {1, 0, 0}});
  for (TimeUs t = 0; t < 20000; t += 1000) rates.add({.t_us = t, .w_WB_B = {2, 0, 0}});
  EXPECT_NEAR(rates.mean(0, 10000).x(), 2, 1e-12);
  // A sample that is a little late is no such clock.
  rates.add({.t_us = 17500, .w_WB_B = {2, 0, 0}});
  EXPECT_NEAR(rates.mean(0, 10000).x(), 2, 1e-12);
}

StateEstimate state(TimeUs t_us, const Eigen::Vector3d& p, double yaw, const Eigen::Vector3d& v,
                    double yaw_rate) {
  StateEstimate s;
  s.t_us = t_us;
  s.p_WB = p;
  s.q_WB = Eigen::AngleAxisd(yaw, Eigen::Vector3d::UnitZ());
  s.v_WB = v;
  s.w_WB_B = {0, 0, yaw_rate};
  return s;
}

double yaw_of(const StateEstimate& s) {
  const Eigen::Vector3d x = s.q_WB * Eigen::Vector3d::UnitX();
  return std::atan2(x.y(), x.x());
}

TEST(StateHistory, IsEmptyWithoutEstimates) { EXPECT_FALSE(StateHistory().at(5).has_value()); }

TEST(StateHistory, ForgetsTheTimeBeforeTheClockWasSetBack) {
  StateHistory history;
  for (TimeUs t = 0; t < 5000000; t += 4000) history.add(state(t, {9, 0, 0}, 0, {5, 0, 0}, 0));
  history.add(state(1000, {1, 0, 0}, 0, {0, 0, 0}, 0));
  EXPECT_EQ(history.at(0)->p_WB.x(), 1);
}

TEST(StateHistory, LeavesOutEstimatesThatAreNotFinite) {
  StateHistory history;
  history.add(state(1000, {0, 0, 1}, 0, {1, 0, 0}, 0));
  history.add(state(2000, {0, std::nan(""), 1}, 0, {1, 0, 0}, 0));
  history.add(state(3000, {0, 0, 1}, 0, {INFINITY, 0, 0}, 0));
  EXPECT_NEAR(history.at(3000)->p_WB.x(), 0.002, 1e-12);
  EXPECT_TRUE(history.at(2000)->p_WB.allFinite());
}

TEST(StateHistory, LeavesOutAttitudesThatAreNoUnitQuaternions) {
  StateHistory history;
  EXPECT_FALSE(history.newest_us().has_value());
  history.add(state(1000, {0, 0, 1}, 0, {1, 0, 0}, 0));
  for (const double length : {0.0, 0.9, 2.0, std::nan("")}) {
    StateEstimate other = state(2000, {9, 9, 9}, 0, {0, 0, 0}, 0);
    other.q_WB.coeffs() *= length;
    history.add(other);
  }
  EXPECT_EQ(history.newest_us(), 1000);
  EXPECT_NEAR(history.at(2000)->p_WB.x(), 0.001, 1e-12);
}

TEST(StateHistory, InterpolatesBetweenEstimates) {
  StateHistory history;
  history.add(state(1000, {0, 0, 1}, 0.0, {1, 0, 0}, 0));
  history.add(state(5000, {4, 0, 1}, 0.4, {3, 0, 0}, 0));
  history.add(state(9000, {4, 8, 1}, 0.4, {3, 0, 0}, 0));
  const StateEstimate s = *history.at(2000);
  EXPECT_EQ(s.t_us, 2000);
  EXPECT_NEAR(s.p_WB.x(), 1, 1e-12);
  EXPECT_NEAR(yaw_of(s), 0.1, 1e-12);
  EXPECT_NEAR(s.v_WB.x(), 1.5, 1e-12);
  EXPECT_NEAR(history.at(7000)->p_WB.y(), 4, 1e-12);
  EXPECT_NEAR(history.at(5000)->p_WB.x(), 4, 1e-12);
}

TEST(StateHistory, RemembersHalfASecondAtFourKilohertz) {
  StateHistory history;
  for (TimeUs t_us = 0; t_us <= 2000000; t_us += 250) {
    history.add(state(t_us, {std::sin(1e-5 * static_cast<double>(t_us)), 0, 0}, 0, {0, 0, 0}, 0));
  }
  EXPECT_NEAR(history.at(1500000)->p_WB.x(), std::sin(15.0), 1e-12);
}

TEST(StateHistory, CarriesTheNewestEstimateOnAndTheOldestBack) {
  StateHistory history;
  history.add(state(10000, {1, 2, 3}, 0.1, {2, 0, -1}, 5));
  const StateEstimate later = *history.at(30000), earlier = *history.at(0);
  EXPECT_LT((later.p_WB - Eigen::Vector3d(1.04, 2, 2.98)).norm(), 1e-12);
  EXPECT_NEAR(yaw_of(later), 0.2, 1e-12);
  EXPECT_LT((earlier.p_WB - Eigen::Vector3d(0.98, 2, 3.01)).norm(), 1e-12);
  EXPECT_NEAR(yaw_of(earlier), 0.05, 1e-12);
}

TEST(StateHistory, ForgetsTheOldest) {
  StateHistory history;
  for (TimeUs t = 0; t < 20000000; t += 4000) {
    history.add(state(t, {static_cast<double>(t), 0, 0}, 0, {0, 0, 0}, 0));
  }
  EXPECT_NEAR(history.at(19990000)->p_WB.x(), 19990000, 1e-6);
  EXPECT_GT(history.at(0)->p_WB.x(), 9000000);
}

}  // namespace
}  // namespace dodge

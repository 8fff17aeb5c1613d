#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "dodge/avoid/escape.h"

namespace dodge {
namespace {

using Eigen::Vector3d;

// The share of the normal distribution with standard deviation `sigma` around `miss` on a disc of
// unit radius, by a sum over rings and sectors.
double share_on_unit_disc(double miss, double sigma) {
  constexpr int kRings = 200, kSectors = 200;
  double sum = 0;
  for (int i = 0; i < kRings; ++i) {
    const double r = (i + 0.5) / kRings;
    for (int j = 0; j < kSectors; ++j) {
      const double angle = 2 * std::numbers::pi * (j + 0.5) / kSectors;
      const double x = r * std::cos(angle) - miss, y = r * std::sin(angle);
      sum += r * std::exp(-0.5 * (x * x + y * y) / (sigma * sigma));
    }
  }
  return sum / (kRings * kSectors * sigma * sigma);
}

TEST(HitProbability, AgreesWithTheIntegralOfTheNormalDistribution) {
  for (const double radius : {0.2, 1.0}) {
    for (const double sigma : {0.1, 0.15, 0.3, 0.7, 1.0, 2.0, 5.0}) {
      for (const double miss : {0.0, 0.5, 1.0, 1.6, 2.0, 4.0}) {
        Meeting meeting;
        meeting.radius_m = radius;
        meeting.along_W = Vector3d(1, 2, -1).normalized();
        meeting.miss_W = miss * radius * meeting.along_W.unitOrthogonal();
        meeting.covariance = sigma * sigma * radius * radius * Eigen::Matrix3d::Identity();
        EXPECT_NEAR(hit_probability(meeting), share_on_unit_disc(miss, sigma), 1e-3)
            << "sigma " << sigma << ", miss " << miss << ", in radii";
      }
    }
  }
}

TEST(HitProbability, OfWhatIsKnownExactlyIsAllOrNothing) {
  for (const double sigma : {0.05, 0.01, 0.001}) {
    for (double miss = 0; miss < 2; miss += 0.01) {
      Meeting meeting;
      meeting.radius_m = 0.35;
      meeting.along_W = Vector3d::UnitX();
      meeting.miss_W = 0.35 * miss * Vector3d::UnitY();
      meeting.covariance = std::pow(0.35 * sigma, 2) * Eigen::Matrix3d::Identity();
      const double probability = hit_probability(meeting);
      EXPECT_LT(probability, 1.001) << sigma << ", " << miss;
      if (miss < 0.6) {
        EXPECT_GT(probability, 0.99) << sigma << ", " << miss;
      }
      if (miss > 1.4) {
        EXPECT_LT(probability, 0.01) << sigma << ", " << miss;
      }
    }
  }
}

TEST(HitProbability, OfASmallDiscIsItsAreaTimesTheDensity) {
  Meeting meeting;
  meeting.radius_m = 0.01;
  meeting.along_W = Vector3d::UnitX();
  meeting.miss_W = {0, 0.5, 0};
  meeting.covariance = Vector3d(9, 0.25, 0.0025).asDiagonal();  // 3, 0.5 and 0.05 m
  const double expected = 0.5 * 0.01 * 0.01 / (0.5 * 0.05) * std::exp(-0.5);
  EXPECT_NEAR(hit_probability(meeting), expected, 0.01 * expected);
  const Eigen::Matrix3d R =
      Eigen::AngleAxisd(1.1, Vector3d(1, 2, -1).normalized()).toRotationMatrix();
  Meeting turned = meeting;
  turned.along_W = R * meeting.along_W;
  turned.miss_W = R * meeting.miss_W;
  turned.covariance = R * meeting.covariance * R.transpose();
  EXPECT_NEAR(hit_probability(turned), hit_probability(meeting), 1e-9);
}

TEST(HitProbability, DoesNotCareForWhenTheObstacleComes) {
  Meeting meeting;
  meeting.radius_m = 0.3;
  meeting.along_W = Vector3d::UnitX();
  meeting.miss_W = {0, 0.2, 0.1};
  meeting.covariance = Vector3d(0.04, 0.04, 0.04).asDiagonal();
  const double before = hit_probability(meeting);
  meeting.covariance(0, 0) = 100;  // along its line of flight
  EXPECT_NEAR(hit_probability(meeting), before, 1e-12);
}

}  // namespace
}  // namespace dodge

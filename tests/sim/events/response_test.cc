#include "sim/events/response.h"

#include <gtest/gtest.h>

#include <cmath>

namespace dodgesim {
namespace {

TEST(Response, IsTheLogarithmAboveTheKnee) {
  for (const double epsilon : {1e-9, 1e-3, 0.1}) {
    for (const double knee : {0.0, 0.01}) {
      const Response response(epsilon, knee);
      for (double luminance = knee; luminance < 1e6; luminance = 1.7 * luminance + 1e-3) {
        EXPECT_NEAR(response.at(luminance), std::log(epsilon + luminance), 1e-13);
      }
    }
  }
}

TEST(Response, IsTheTangentBelowTheKnee) {
  const double epsilon = 1e-3, knee = 0.05;
  const Response response(epsilon, knee);
  const double slope = 1 / (epsilon + knee);
  for (const double luminance : {0.0, 0.01, 0.02, 0.0499999}) {
    EXPECT_NEAR(response.at(luminance), std::log(epsilon + knee) + slope * (luminance - knee),
                1e-13);
  }
  // No jump, and no kink.
  const double h = 1e-7;
  const double below = (response.at(knee) - response.at(knee - h)) / h;
  const double above = (response.at(knee + h) - response.at(knee)) / h;
  EXPECT_NEAR(below, above, 1e-4 * slope);
  EXPECT_NEAR(response.at(knee), response.at(std::nextafter(knee, 0)), 1e-13);
}

TEST(Response, InverseGivesTheLuminanceBack) {
  for (const double knee : {0.0, 0.05}) {
    const Response response(1e-3, knee);
    for (double luminance = 0; luminance < 1e6; luminance = 1.3 * luminance + 1e-4) {
      EXPECT_NEAR(response.inverse(response.at(luminance)), luminance, 1e-7 * (1 + luminance));
    }
  }
}

TEST(Response, InverseOfWhatNoLightGivesIsFiniteOrBeyondAllLight) {
  for (const double knee : {0.0, 0.05}) {
    const Response response(1e-3, knee);
    EXPECT_LT(response.inverse(-1e9), 0);
    EXPECT_GT(response.inverse(1e9), 1e290);
  }
}

}  // namespace
}  // namespace dodgesim

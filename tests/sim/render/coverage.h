// White objects on black, whose luminance is how much of a pixel they cover.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <string>

#include "tests/sim/render/render_fixture.h"

namespace dodgesim {

inline RenderSpec black_sky() {
  RenderSpec spec;
  spec.sky_luminance = 0.0;
  return spec;
}

inline Scene white_object(const std::string& geom) {
  return Scene(std::string(kWhiteLight) + "<worldbody>" + thrown(0, geom) + "</worldbody>",
               black_sky());
}

// Compares every pixel with brute-force ray casting: mean absolute error of partly covered pixels
// and the largest error.
inline void expect_coverage(const Image& image,
                            const std::function<bool(const Eigen::Vector3d&)>& hits, double largest,
                            double mean) {
  double worst = 0, sum = 0;
  int edges = 0;
  const auto inside = [&](double x, double y) {
    return hits(
        {(x - image.camera.cx()) / image.camera.f, (y - image.camera.cy()) / image.camera.f, 1.0});
  };
  for (int y = 0; y < image.camera.height; ++y) {
    for (int x = 0; x < image.camera.width; ++x) {
      const double truth = sampled_coverage(x, y, 4, inside);
      if (truth == 0 || truth == 1) {
        // Nothing but a sliver between the samples can differ.
        EXPECT_NEAR(image.at(x, y), truth, std::max(0.1, largest)) << x << ", " << y;
        continue;
      }
      const double error = std::abs(image.at(x, y) - sampled_coverage(x, y, 16, inside));
      worst = std::max(worst, error);
      sum += error;
      ++edges;
    }
  }
  EXPECT_GT(edges, 4);
  EXPECT_LT(worst, largest);
  EXPECT_LT(sum / edges, mean);
}

}  // namespace dodgesim

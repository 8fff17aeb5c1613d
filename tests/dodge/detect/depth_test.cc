#include "dodge/detect/depth.h"

#include <gtest/gtest.h>

#include <opencv2/imgproc.hpp>

#include "tests/dodge/synthetic_events.h"

namespace dodge {
namespace {

// Around (u, v), full of events.
Cluster upright(double u, double v, double width_px, double height_px) {
  Cluster cluster;
  cluster.rectangle =
      cv::RotatedRect(cv::Point2f(static_cast<float>(u), static_cast<float>(v)),
                      cv::Size2f(static_cast<float>(width_px), static_cast<float>(height_px)), 0);
  cluster.top_row = v - height_px / 2;
  cluster.bottom_row = v + height_px / 2;
  cluster.centroid = {u, v};
  cluster.pixels = static_cast<int>(width_px * height_px);
  cluster.events = 2 * cluster.pixels;
  cluster.time = 1;
  return cluster;
}

class DepthTest : public ::testing::Test {
 protected:
  static Cluster square(double u, double v, double side_px) {
    return upright(u, v, side_px, side_px);
  }

  // Disparity of the centres: most tests have clusters but no images.
  static DepthConfig centres() {
    DepthConfig config;
    config.stereo.disparity = "centres";
    config.stereo.max_cost = 2;
    config.max_range_m = 1.5;
    return config;
  }

  // The square an object of this size would fill in a camera.
  Cluster seen_by(std::size_t camera, const Eigen::Vector3d& p_B, double size_m) const {
    const Eigen::Vector3d p_C = cameras_[camera].X_BC.inverse() * p_B;
    const Eigen::Vector2d pixel = cameras_[camera].project(p_C);
    return square(pixel.x(), pixel.y(), cameras_[camera].fx * size_m / p_C.z());
  }

  std::vector<Detection> locate(const DepthConfig& config, const std::vector<Cluster>& top,
                                const std::vector<Cluster>& bottom) const {
    DepthEstimator estimator(config, cameras_, 10000, 64);
    const std::array<View, 2> both = {View{&top, &rho_[0]}, View{&bottom, &rho_[1]}};
    std::vector<Detection> detections;
    estimator.locate(both, state_, detections);
    return detections;
  }

  std::vector<CameraModel> cameras_ = synthetic::vertical_pair();
  StateEstimate state_;
  std::array<cv::Mat1f, 2> rho_ = {cv::Mat1f(240, 320, 0.0F), cv::Mat1f(240, 320, 0.0F)};
};

TEST_F(DepthTest, StereoRecoversPositionAndSize) {
  state_.t_us = 77;
  state_.p_WB = {1, 2, 3};
  state_.q_WB = Eigen::AngleAxisd(0.5, Eigen::Vector3d(0.2, 0.3, 1).normalized());
  const Eigen::Vector3d p_B(1.3, 0.2, -0.1);
  const auto detections = locate(centres(), {seen_by(0, p_B, 0.2)}, {seen_by(1, p_B, 0.2)});
  ASSERT_EQ(detections.size(), 1U);
  const Detection& d = detections[0];
  EXPECT_EQ(d.t_us, 77);
  EXPECT_NEAR(d.depth_m, 1.2, 1e-4);  // the cameras sit 0.1 m ahead of the body's origin
  EXPECT_NEAR(d.size_m, 0.2, 1e-4);
  EXPECT_LT((d.centre_W - (state_.p_WB + state_.q_WB * p_B)).norm(), 1e-4);
}

TEST_F(DepthTest, AVerticalPairMeasuresDepthByTheVerticalFocalLength) {
  for (CameraModel& camera : cameras_) camera.fy = 1.2 * camera.fx;
  const Eigen::Vector3d p_B(1.3, 0.2, -0.1);
  const auto detections = locate(centres(), {seen_by(0, p_B, 0.2)}, {seen_by(1, p_B, 0.2)});
  ASSERT_EQ(detections.size(), 1U);
  EXPECT_NEAR(detections[0].depth_m, 1.2, 1e-4);
}

TEST_F(DepthTest, SpeaksOfTheTimeOfTheEventsAndThePlaceOfTheVehicleThen) {
  state_.t_us = 500000;
  state_.v_WB = {4, 0, 0};
  const Eigen::Vector3d p_B(1.3, 0.2, -0.1);
  Cluster top = seen_by(0, p_B, 0.2);
  top.time = 0.7;
  const auto detections = locate(centres(), {top}, {seen_by(1, p_B, 0.2)});
  ASSERT_EQ(detections.size(), 1U);
  EXPECT_EQ(detections[0].t_us, 497000);
  EXPECT_LT((detections[0].centre_W - (p_B - Eigen::Vector3d(0.012, 0, 0))).norm(), 1e-4);
}

TEST_F(DepthTest, MonoRecoversPositionFromTheKnownSize) {
  const Eigen::Vector3d p_B(1.1, -0.3, 0.2);
  DepthConfig config;
  config.depth = "mono";
  config.known_size_m = 0.15;
  const auto detections = locate(config, {seen_by(0, p_B, 0.15)}, {});
  ASSERT_EQ(detections.size(), 1U);
  EXPECT_NEAR(detections[0].depth_m, 1.0, 1e-4);
  EXPECT_LT((detections[0].centre_W - p_B).norm(), 1e-4);
  EXPECT_NEAR(detections[0].size_m, 0.15, 1e-4);
}

TEST_F(DepthTest, SixPointsAreTheCornersAndTheCentreMovedByTheSize) {
  // Straight ahead of the top camera, whose axes are then those of the body.
  const Eigen::Vector3d p_B(1.1, 0, 0.075);
  auto detections = locate(centres(), {seen_by(0, p_B, 0.2)}, {seen_by(1, p_B, 0.2)});
  ASSERT_EQ(detections.size(), 1U);
  double left = 0, up = 0;
  for (int i = 0; i < 4; ++i) {
    const Eigen::Vector3d corner = detections[0].p_W[static_cast<std::size_t>(i)] - p_B;
    EXPECT_NEAR(corner.x(), 0, 1e-4);
    EXPECT_NEAR(std::abs(corner.y()), 0.1, 1e-4);
    EXPECT_NEAR(std::abs(corner.z()), 0.1, 1e-4);
    left += corner.y();
    up += corner.z();
  }
  EXPECT_NEAR(left, 0, 1e-4);
  EXPECT_NEAR(up, 0, 1e-4);
  EXPECT_LT((detections[0].p_W[4] - Eigen::Vector3d(0.9, 0, 0.075)).norm(), 1e-4);
  EXPECT_LT((detections[0].p_W[5] - Eigen::Vector3d(1.3, 0, 0.075)).norm(), 1e-4);
}

TEST_F(DepthTest, TakesTheCentroidInPlaceOfTheRectanglesCentreIfAskedTo) {
  const Eigen::Vector3d p_B(1.1, 0.2, 0.05);
  Cluster top = seen_by(0, p_B, 0.2), bottom = seen_by(1, p_B, 0.2);
  const double disparity_px = top.centroid.y() - bottom.centroid.y();
  top.centroid += Eigen::Vector2d(7, -5);
  bottom.centroid.x() += 7;
  DepthConfig config = centres();
  EXPECT_NEAR(locate(config, {top}, {bottom}).at(0).depth_m, 1, 1e-4);
  config.centre = "centroid";
  const Detection d = locate(config, {top}, {bottom}).at(0);
  EXPECT_NEAR(d.depth_m, disparity_px / (disparity_px - 5), 1e-4);
  const Eigen::Vector2d seen = cameras_[0].project(cameras_[0].X_BC.inverse() * d.centre_W);
  EXPECT_LT((seen - top.centroid).norm(), 1e-2);
}

TEST_F(DepthTest, TheNearPointIsNotBehindTheCameraHoweverLargeTheObject) {
  DepthConfig config;
  config.depth = "mono";
  config.known_size_m = 0.5;
  const Detection d = locate(config, {square(160, 120, 230)}, {}).at(0);
  ASSERT_GT(d.size_m, d.depth_m);
  const Eigen::Isometry3d X_WC = cameras_[0].X_BC;
  EXPECT_LT((d.p_W[4] - X_WC.translation()).norm(), 1e-9);
  EXPECT_NEAR((X_WC.inverse() * d.p_W[5]).z(), d.depth_m + d.size_m, 1e-9);
}

TEST_F(DepthTest, WholePixelsGiveDepthWithinTheQuantisationOfTheDisparity) {
  const double focal_baseline = cameras_[0].fx * 0.15;
  for (int depth_cm = 30; depth_cm < 140; ++depth_cm) {
    const double depth_m = 0.01 * depth_cm;
    const Eigen::Vector3d p_B(depth_m + 0.1, 0.05, 0.03);
    Cluster top = seen_by(0, p_B, 0.2), bottom = seen_by(1, p_B, 0.2);
    top.rectangle.center.y = std::round(top.rectangle.center.y);
    bottom.rectangle.center.y = std::round(bottom.rectangle.center.y);
    const auto detections = locate(centres(), {top}, {bottom});
    ASSERT_EQ(detections.size(), 1U);
    const double disparity = focal_baseline / depth_m;
    EXPECT_LT(std::abs(detections[0].depth_m - depth_m),
              focal_baseline / (disparity - 1) - depth_m + 1e-6);
  }
}

TEST_F(DepthTest, DepthUncertaintyIsThatOfOneDisparitySigma) {
  const Eigen::Vector3d p_B(1.6 - 1e-6, 0, 0.075);
  const auto detections = locate(centres(), {seen_by(0, p_B, 0.2)}, {seen_by(1, p_B, 0.2)});
  ASSERT_EQ(detections.size(), 1U);
  const double sigma_px = centres().stereo.disparity_sigma_px;
  // facts of the rig: 1.5 m is 19 px of disparity, 7.9 cm per px there
  EXPECT_NEAR(detections[0].depth_sigma_m, 0.0787 * sigma_px, 0.0005 * sigma_px);
}

TEST_F(DepthTest, DistanceIsLongerThanDepthOffTheAxis) {
  const Eigen::Vector3d p_B(1.1, 0.6, 0.075 + 0.3);
  const auto detections = locate(centres(), {seen_by(0, p_B, 0.2)}, {seen_by(1, p_B, 0.2)});
  ASSERT_EQ(detections.size(), 1U);
  EXPECT_NEAR(detections[0].distance_per_depth, Eigen::Vector3d(1, 0.6, 0.3).norm(), 1e-4);
}

TEST_F(DepthTest, MonoUncertaintyGrowsWithTheSquareOfTheDepth) {
  DepthConfig config;
  config.depth = "mono";
  const auto near = locate(config, {square(160, 120, 60)}, {});
  const auto far = locate(config, {square(160, 120, 30)}, {});
  EXPECT_NEAR(far.at(0).depth_sigma_m / near.at(0).depth_sigma_m, 4, 1e-6);
  // It is what the side's standard deviation makes of it.
  const auto depth_of = [&](double side_px) {
    return locate(config, {square(160, 120, side_px)}, {}).at(0).depth_m;
  };
  const double half = 0.5 * config.side_sigma_px;
  EXPECT_NEAR(near.at(0).depth_sigma_m, depth_of(60 - half) - depth_of(60 + half),
              2e-3 * near.at(0).depth_sigma_m);
}

TEST_F(DepthTest, DisparityMustBePositive) {
  EXPECT_EQ(locate(centres(), {square(160, 100, 20)}, {square(160, 130, 20)}).size(), 0U);
  EXPECT_EQ(locate(centres(), {square(160, 100, 20)}, {square(160, 100, 20)}).size(), 0U);
  EXPECT_EQ(locate(centres(), {square(160, 130, 20)}, {square(160, 100, 20)}).size(), 1U);
}

TEST_F(DepthTest, APairOfNegativeDisparityDoesNotTakeThePlaceOfTheRightOne) {
  // The first top cluster equals the bottom one, but lies above it.
  const auto detections =
      locate(centres(), {square(160, 90, 20), square(161, 130, 21)}, {square(160, 100, 20)});
  ASSERT_EQ(detections.size(), 1U);
  EXPECT_NEAR(detections[0].depth_m, 190.7 * 0.15 / 30, 1e-4);
}

TEST_F(DepthTest, MatchingCostIs8AndSymmetric) {
  DepthConfig config;
  config.stereo.weight_position_1ppx = 2;
  config.stereo.weight_area = 3;
  config.stereo.weight_count = 5;
  const DepthEstimator estimator(config, cameras_, 10000, 64);
  Cluster a = square(100, 80, 10), b = square(104, 50, 20);
  a.pixels = 60;
  b.pixels = 90;
  EXPECT_NEAR(estimator.matching_cost(a, b), 2 * 4 + 3 * (4 - 1) + 5 * (1.5 - 1), 1e-6);
  EXPECT_NEAR(estimator.matching_cost(b, a), estimator.matching_cost(a, b), 1e-9);
  EXPECT_EQ(estimator.matching_cost(a, a), 0);
}

TEST_F(DepthTest, MatchesTwoObjectsCrosswiseAndEachOnce) {
  const Eigen::Vector3d p1(1.2, 0.4, 0), p2(0.9, -0.3, 0.1);
  const std::vector<Cluster> top = {seen_by(0, p1, 0.1), seen_by(0, p2, 0.3)};
  const std::vector<Cluster> bottom = {seen_by(1, p2, 0.3), seen_by(1, p1, 0.1),
                                       seen_by(1, p2 + Eigen::Vector3d(0, 0.05, 0), 0.3)};
  const auto detections = locate(centres(), top, bottom);
  ASSERT_EQ(detections.size(), 2U);
  for (const Detection& d : detections) {
    EXPECT_LT(std::min((d.centre_W - p1).norm(), (d.centre_W - p2).norm()), 1e-3);
  }
  EXPECT_GT((detections[0].centre_W - detections[1].centre_W).norm(), 0.5);
}

// One above the other, so that the upper one in the top camera is above the lower one in the bottom
// camera, too: a disparity of two objects, which looks a little more alike.
TEST_F(DepthTest, TwoObjectsOneAboveTheOtherAreNotMatchedCrosswise) {
  const Eigen::Vector3d upper(1.3, 0, 0.3), lower(1.3, 0, -0.3);
  std::vector<Cluster> top = {seen_by(0, upper, 0.2), seen_by(0, lower, 0.2)};
  std::vector<Cluster> bottom = {seen_by(1, upper, 0.2), seen_by(1, lower, 0.2)};
  top[1].pixels += 9;  // as the upper one in the other camera, and no longer as itself
  bottom[0].pixels += 9;
  DepthConfig config = centres();
  config.max_range_m = 10;
  const auto detections = locate(config, top, bottom);
  ASSERT_EQ(detections.size(), 2U);
  for (const Detection& d : detections) EXPECT_NEAR(d.depth_m, 1.2, 1e-4);
}

TEST_F(DepthTest, UnlikeClustersDoNotMatch) {
  EXPECT_EQ(locate(centres(), {square(100, 130, 20)}, {square(160, 100, 20)}).size(), 0U);
  EXPECT_EQ(locate(centres(), {square(160, 130, 40)}, {square(160, 100, 10)}).size(), 0U);
}

TEST_F(DepthTest, CorrelationMeasuresDepthThoughEachCameraSeesAnotherPart) {
  // A ring 20 px wide, 25 px of disparity; the top camera sees only its upper edge.
  for (int y = 0; y < 240; ++y) {
    for (int x = 0; x < 320; ++x) {
      for (std::size_t i = 0; i < 2; ++i) {
        const double d = std::hypot(x - 160, y - (i == 0 ? 130 : 105)) - 10;
        rho_[i](y, x) = static_cast<float>(0.3 * std::exp(-0.5 * d * d));
      }
    }
  }
  rho_[0].rowRange(125, 240) = 0.0F;
  Cluster top = square(160, 121.5, 20);
  top.rectangle.size.height = 6;
  top.pixels = 30;
  Cluster bottom = square(160, 105, 21);
  bottom.pixels = 60;

  DepthConfig config = centres();
  config.stereo.max_cost = 5;
  const double truth_m = 190.7 * 0.15 / 25;
  auto detections = locate(config, {top}, {bottom});
  EXPECT_TRUE(detections.empty() || detections[0].depth_m > 1.3 * truth_m);

  config.stereo.disparity = "correlation";
  detections = locate(config, {top}, {bottom});
  ASSERT_EQ(detections.size(), 1U);
  EXPECT_NEAR(detections[0].depth_m, truth_m, 0.01);
  // Both cameras' rectangles together cover the whole ring.
  const double size_m = 21 * truth_m / 190.7;
  EXPECT_NEAR(detections[0].size_m, size_m, 0.1 * size_m);

  rho_[1] = 0.0F;  // the images do not agree: no match
  EXPECT_TRUE(locate(config, {top}, {bottom}).empty());
}

// What is left of a cluster of upright rectangle in the image.
Cluster cut_off_at_border(const Cluster& cluster) {
  const double first = std::max(-0.5, cluster.top_row), last = std::min(239.5, cluster.bottom_row);
  return upright(cluster.centroid.x(), (first + last) / 2, cluster.rectangle.size.width,
                 last - first);
}

// From where the bottom camera has lost the upper half of it to where the top one has lost the
// lower half.
TEST_F(DepthTest, WhatABorderCutsOffInOneCameraHasTheDepthOfItsOtherEnd) {
  const double depth_m = 0.35, side_px = 190.7 * 0.15 / depth_m;  // as large as the baseline
  const double disparity_px = 190.7 * 0.15 / depth_m;
  int cut = 0;
  for (double v = disparity_px; v <= 240; v += 2.5) {
    const Cluster top = square(160, v, side_px), bottom = square(160, v - disparity_px, side_px);
    const Cluster seen_top = cut_off_at_border(top), seen_bottom = cut_off_at_border(bottom);
    cut += seen_top.rectangle.size.height + seen_bottom.rectangle.size.height < 2 * side_px - 1;
    for (std::size_t i = 0; i < 2; ++i) {
      rho_[i] = 0.0F;
      cv::rectangle(rho_[i], (i == 0 ? top : bottom).rectangle.boundingRect(), 0.3F, 2);
    }
    for (const std::string disparity : {"centres", "correlation"}) {
      DepthConfig config;
      config.stereo.disparity = disparity;
      const auto detections = locate(config, {seen_top}, {seen_bottom});
      ASSERT_EQ(detections.size(), 1U) << v;
      EXPECT_NEAR(detections[0].depth_m, depth_m, 0.02 * depth_m) << disparity << " at " << v;
    }
  }
  EXPECT_GT(cut, 20);
}

// The upper camera sees the object's middle alone, the lower one all of it that is in its image.
TEST_F(DepthTest, AtTheBorderCamerasThatSeeDifferentEdgesMeasureNoLessThanTheirCentres) {
  const Cluster top = upright(160, 60, 60, 40), bottom = square(160, 29.5, 60);
  const auto detections = locate(centres(), {top}, {bottom});
  ASSERT_EQ(detections.size(), 1U);
  EXPECT_NEAR(detections[0].depth_m, 190.7 * 0.15 / 30.5, 1e-4);
}

// The corners of an oblique rectangle lie beyond what it is around, by different amounts.
TEST_F(DepthTest, TheEndOfAnObliqueObjectIsThatOfItsPixels) {
  Cluster top = square(160, 100, 60), bottom = square(160, 20, 41);
  top.rectangle.angle = 45;
  bottom.rectangle.angle = 20;
  bottom.bottom_row = top.bottom_row - 82;
  const auto detections = locate(centres(), {top}, {bottom});
  ASSERT_EQ(detections.size(), 1U);
  EXPECT_NEAR(detections[0].depth_m, 190.7 * 0.15 / 82, 1e-4);
}

// A horizontal bar that the bottom camera sees twice: its cluster is the worse of the two.
TEST_F(DepthTest, AMatchThatHasABetterOneElsewhereIsNoneIfAskedFor) {
  const auto draw = [&](std::size_t camera, int y, float rho) {
    rho_[camera](cv::Rect(150, y - 1, 20, 3)) = rho;
  };
  const auto bar = [&](double y) { return upright(160, y, 20, 3); };
  draw(0, 130, 0.3F);
  draw(1, 105, 0.3F);
  rho_[1](cv::Rect(150, 104, 6, 3)) = 0.0F;  // a part of it is hidden
  draw(1, 60, 0.3F);
  DepthConfig config = centres();
  config.max_range_m = 5;
  config.stereo.disparity = "correlation";
  const auto matches = [&](double min_share_of_best, double y) {
    config.stereo.min_share_of_best = min_share_of_best;
    return locate(config, {bar(130)}, {bar(y)}).size();
  };
  EXPECT_EQ(matches(0, 105), 1U);
  EXPECT_EQ(matches(0.7, 105), 1U);
  EXPECT_EQ(matches(0.9, 105), 0U);
  EXPECT_EQ(matches(0.9, 60), 1U);
}

TEST_F(DepthTest, DropsWhatIsTooFarTooNearTooLargeOrTooSmall) {
  const auto count = [&](double x_m, double size_m) {
    const Eigen::Vector3d p_B(x_m + 0.1, 0, 0.075);
    return locate(centres(), {seen_by(0, p_B, size_m)}, {seen_by(1, p_B, size_m)}).size();
  };
  EXPECT_EQ(count(1.49, 0.2), 1U);
  EXPECT_EQ(count(1.51, 0.2), 0U);
  EXPECT_EQ(count(0.21, 0.1), 1U);
  EXPECT_EQ(count(0.19, 0.1), 0U);
  EXPECT_EQ(count(1, 0.9), 0U);
  EXPECT_EQ(count(1, 0.01), 0U);
}

TEST_F(DepthTest, RangeIsTheDistanceFromTheCameraNotTheDepth) {
  const auto count = [&](double y_m) {
    const Eigen::Vector3d p_B(1.3 + 0.1, y_m, 0.075);  // 1.3 m of depth
    return locate(centres(), {seen_by(0, p_B, 0.2)}, {seen_by(1, p_B, 0.2)}).size();
  };
  EXPECT_EQ(count(0.7), 1U);   // 1.48 m
  EXPECT_EQ(count(-0.8), 0U);  // 1.53 m
}

}  // namespace
}  // namespace dodge

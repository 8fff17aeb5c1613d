// The first detection stages on real event cameras. Skips where the recordings are absent.
#include "tests/dodge/recording.h"

#include <gtest/gtest.h>

#include <cmath>
#include <opencv2/imgproc.hpp>
#include <utility>

#include "dodge/detect/cluster.h"
#include "dodge/detect/ego_motion.h"
#include "dodge/detect/time_image.h"

namespace dodge {
namespace {

std::vector<Event> between(const std::vector<Event>& events, TimeUs begin_us, TimeUs end_us) {
  std::vector<Event> found;
  for (const Event& event : events) {
    if (event.t_us > begin_us && event.t_us <= end_us) found.push_back(event);
  }
  return found;
}

// Windows of 10 ms, one every 5 ms, through the stages up to the clusters.
class Windows {
 public:
  Windows(const TimeImageConfig& config, const CameraModel& camera, std::vector<Event> events,
          const ClusterConfig& cluster = {})
      : events_(std::move(events)),
        ego_motion_({}, camera),
        image_(config, camera.width, camera.height),
        clusterer_(cluster, camera.width, camera.height) {}

  // Calls visit(image, clusters) for each window, compensated with w_WC_C(middle of the window).
  template <class Rate, class Visit>
  void each(const Rate& w_WC_C, const Visit& visit) {
    OpticalFlow flow({});
    for (TimeUs end_us = 10000; end_us <= events_.back().t_us; end_us += 5000) {
      const std::vector<Event> window = between(events_, end_us - 10000, end_us);
      const Eigen::Vector3d w = w_WC_C(end_us - 5000);
      ego_motion_.set_motion(w, end_us - 10000, end_us);
      const std::array<std::span<const Event>, 1> pieces = {std::span<const Event>(window)};
      image_.accumulate(pieces, ego_motion_, end_us - 10000, end_us);
      image_.threshold(w.norm());
      image_.clean();
      flow.set_images(image_.previous_averaged(), image_.averaged(), 0.5);
      visit(image_, clusterer_.find(image_, flow));
    }
  }

 private:
  std::vector<Event> events_;
  EgoMotion ego_motion_;
  TimeImage image_;
  Clusterer clusterer_;
};

// A hand-held DAVIS240C turned in front of a wall of shapes. The rates are estimates by contrast
// maximisation: the recording has no gyroscope.
class ShapesRotation : public ::testing::Test {
 protected:
  void SetUp() override {
    events_ = recording::read_events("mueggler_shapes_rotation.events.csv", 240, 180);
    if (events_.empty()) GTEST_SKIP() << "The recording is absent.";
  }

  static CameraModel camera() {
    return {.width = 240,
            .height = 180,
            .fx = 199.092366542,
            .fy = 198.82882047,
            .cx = 132.192071378,
            .cy = 110.712660011,
            .k1 = -0.368436311798,
            .k2 = 0.150947243557,
            .p1 = -0.000296130534385,
            .p2 = -0.000759431726241};
  }

  // Mean rate of each 10 ms; the first three from the recording's calibration file, the others
  // estimated in the same way.
  static Eigen::Vector3d rate(TimeUs t_us) {
    static const std::vector<Eigen::Vector3d> rates = {
        {1.89, -0.04, 1.64}, {1.97, -0.11, 1.15}, {2.03, -0.26, 0.92}, {2.24, -0.01, 0.26},
        {2.04, -0.01, 0.26}, {2.24, 0.01, 0.16},  {2.64, 0.01, 0.19},  {2.54, 0.01, 0.16},
        {2.44, 0.01, 0.11},  {2.14, 0.01, 0.06}};
    return rates[std::min(static_cast<std::size_t>(t_us / 10000), rates.size() - 1)];
  }

  // Variance of the image of warped events over (0, length_us], each event shared by the four
  // pixels around it.
  double variance(double factor, TimeUs length_us) const {
    EgoMotion ego_motion({}, camera());
    const Eigen::Vector3d w = (rate(0) + rate(10000) + rate(20000)) / 3;
    ego_motion.set_motion(factor * w, 0, length_us);
    cv::Mat1d image(180, 240, 0.0);
    for (const Event& event : between(events_, 0, length_us)) {
      const Eigen::Vector2f p = ego_motion.warp(event);
      const int x = static_cast<int>(std::floor(p.x())), y = static_cast<int>(std::floor(p.y()));
      if (x < 0 || y < 0 || x + 1 >= image.cols || y + 1 >= image.rows) continue;
      const float fx = p.x() - static_cast<float>(x), fy = p.y() - static_cast<float>(y);
      image(y, x) += (1 - fx) * (1 - fy);
      image(y, x + 1) += fx * (1 - fy);
      image(y + 1, x) += (1 - fx) * fy;
      image(y + 1, x + 1) += fx * fy;
    }
    cv::Scalar mean, deviation;
    cv::meanStdDev(image, mean, deviation);
    return deviation[0] * deviation[0];
  }

  std::vector<Event> events_;
};

TEST_F(ShapesRotation, CompensationSharpensTheImageAndTheWrongSignBlursIt) {
  const double none = variance(0, 30000), right = variance(1, 30000), wrong = variance(-1, 30000);
  RecordProperty("variance",
                 std::to_string(none) + " " + std::to_string(right) + " " + std::to_string(wrong));
  EXPECT_NEAR(none, 0.26, 0.04);
  EXPECT_GT(right, 0.56);
  EXPECT_NEAR(wrong, 0.18, 0.03);
}

TEST_F(ShapesRotation, StaticBlobsVanishWithCompensation) {
  // rho > 0, then opening and closing by 3x3: no threshold helps here.
  const TimeImageConfig config{.threshold_a_s = 0,
                               .threshold_b = 1e-6,
                               .blur_px = 1,
                               .open_px = 3,
                               .close_px = 3,
                               .dilate_px = 0};
  const auto blobs_per_window = [&](double factor) {
    Windows windows(config, camera(), events_);
    int blobs = 0, count = 0;
    windows.each([&](TimeUs t_us) { return Eigen::Vector3d(factor * rate(t_us)); },
                 [&](const TimeImage& image, const std::vector<Cluster>&) {
                   cv::Mat labels;
                   blobs += cv::connectedComponents(image.obstacle_mask(), labels) - 1;
                   ++count;
                 });
    return static_cast<double>(blobs) / count;
  };
  EXPECT_GT(blobs_per_window(0), 3);
  EXPECT_GT(blobs_per_window(-1), 5);
  EXPECT_LT(blobs_per_window(1), 0.2);
}

TEST_F(ShapesRotation, NothingStaticRemainsAsAnObstacle) {
  int with = 0, without = 0;
  Windows compensated({}, camera(), events_);
  compensated.each(rate, [&](const TimeImage&, const auto& clusters) {
    with += static_cast<int>(clusters.size());
  });
  EXPECT_EQ(with, 0);
  TimeImageConfig config;
  config.threshold_a_s = 0;
  Windows uncompensated(config, camera(), events_);
  uncompensated.each([](TimeUs) { return Eigen::Vector3d(0, 0, 0); },
                     [&](const TimeImage&, const auto& clusters) {
                       without += static_cast<int>(clusters.size());
                     });
  EXPECT_GT(without, 20);
}

// Clusters and windows of a recording by a camera at rest.
struct AtRest {
  int clusters, windows;
  int most;  // of a window
};

AtRest clusters_at_rest(std::vector<Event> events, int width, int height,
                        const ClusterConfig& cluster = {}) {
  const CameraModel camera{
      .width = width, .height = height, .cx = 0.5 * (width - 1), .cy = 0.5 * (height - 1)};
  AtRest seen = {0, 0, 0};
  Windows windows({}, camera, std::move(events), cluster);
  windows.each([](TimeUs) { return Eigen::Vector3d(0, 0, 0); },
               [&](const TimeImage&, const auto& found) {
                 const int size = static_cast<int>(found.size());
                 seen.clusters += size;
                 seen.most = std::max(seen.most, size);
                 ++seen.windows;
               });
  return seen;
}

TEST(NoiseRecording, BackgroundActivityIsNoObstacle) {
  // Four regions of the SEES1's size.
  for (const auto& [left, top] : {std::pair(0, 0), {320, 0}, {0, 240}, {320, 240}}) {
    std::vector<Event> events =
        recording::read_events("codecs_dvxplorer_noise.events.csv", 320, 240, left, top);
    if (events.empty()) GTEST_SKIP() << "The recording is absent.";
    const AtRest seen = clusters_at_rest(std::move(events), 320, 240);
    EXPECT_GT(seen.windows, 390);
    EXPECT_EQ(seen.clusters, 0) << left << " " << top;
  }
}

TEST(PersonRecording, ATurningHeadIsSeenAgainAndAgain) {
  std::vector<Event> events =
      recording::read_events("tonic_dvxplorerlite_person.events.csv", 320, 240);
  if (events.empty()) GTEST_SKIP() << "The recording is absent.";
  const AtRest seen = clusters_at_rest(std::move(events), 320, 240);
  RecordProperty("clusters", seen.clusters);
  EXPECT_GT(seen.windows, 110);
  EXPECT_GT(seen.clusters, 10);
}

TEST(FlickerRecording, LampFlickerIsBoundedWorkThoughItLooksLikeObstacles) {
  // A hard negative: nothing moves, but one lamp fires 9000 events per window. The time image alone
  // cannot tell it from motion; what is asserted is that the stages stay within their bounds.
  std::vector<Event> events =
      recording::read_events("aestream_davis346_flicker.events.csv", 346, 260);
  if (events.empty()) GTEST_SKIP() << "The recording is absent.";
  ClusterConfig cluster;
  cluster.min_group_pixels = 1;
  const AtRest seen = clusters_at_rest(events, 346, 260, cluster);
  RecordProperty("clusters", seen.clusters);
  EXPECT_GT(seen.windows, 20);
  EXPECT_GT(seen.most, 2);
  cluster.max_groups = 2;
  EXPECT_EQ(clusters_at_rest(std::move(events), 346, 260, cluster).most, 2);
}

}  // namespace
}  // namespace dodge

// A thrown, spinning ball in the room: pictures of its region against whole pictures.
#include <gtest/gtest.h>

#include "sim/render/luminance_renderer.h"
#include "sim/world/world.h"
#include "tests/sim/events/moving_plane.h"

namespace dodgesim {
namespace {

using testing::compare;
using testing::subdivide;

class ThrownBall : public ::testing::Test {
 protected:
  ThrownBall()
      : world_({DODGESIM_SOURCE_DIR "/models", "room", "qav_rxl", {{"ball", 0.3}}}),
        X_BC_(world_.vehicle().X_BC.front()),
        renderer_(world_, kIntrinsics, RenderSpec()),
        picture_(static_cast<std::size_t>(kIntrinsics.width * kIntrinsics.height)) {}

  // The vehicle and the ball, which flies straight: the physics are not at stake.
  Snapshot scene(TimeUs t_us) const {
    Snapshot s;
    s.t_us = t_us;
    s.vehicle.v_W = vehicle_v_W_;
    s.vehicle.w_W = vehicle_w_W_;
    s.vehicle.p_W = Eigen::Vector3d(-2, 0, 2) + seconds(t_us) * vehicle_v_W_;
    s.vehicle.q_W = turned(vehicle_w_W_, t_us);
    s.launched = {true};
    s.objects.resize(1);
    BodyState& ball = s.objects[0];
    ball.v_W = ball_v_W_;
    ball.w_W = Eigen::Vector3d(6, -5, 6);
    ball.p_W = ball_p_W_ + seconds(t_us) * ball_v_W_;
    ball.q_W = turned(ball.w_W, t_us);
    return s;
  }

  std::vector<Sample> samples(TimeUs end_us) const {
    Sampler sampler = new_sampler();
    std::vector<Sample> samples;
    for (TimeUs t = 0; t < end_us; t += kTickUs) {
      sampler.advance(scene(t), scene(t + kTickUs), StaticDistances(2.5), samples);
    }
    return samples;
  }

  // The events of these samples: as they are, or with whole pictures for all of them.
  std::vector<Event> events(const EventCameraSpec& spec, const std::vector<Sample>& samples,
                            bool whole) {
    Sampler sampler = new_sampler();
    EventCamera camera(spec, kIntrinsics.width, kIntrinsics.height, 1, 0, "top");
    std::vector<Event> events;
    const Rect all = {0, 0, kIntrinsics.width, kIntrinsics.height};
    camera.reset(0, look(0, all));
    regions_ = 0;
    for (const Sample& sample : samples) {
      const Rect region = sampler.region(sample, scene(sample.t_us));
      if (whole || sample.object == Sample::kWholeImage) {
        camera.update(sample.t_us, look(sample.t_us, all), events);
      } else {
        camera.add_region(sample.t_us, region, look(sample.t_us, region));
        ++regions_;
        last_region_ = region;
      }
    }
    return events;
  }

  std::vector<Event> in_region(const std::vector<Event>& events) const {
    const Rect& r = last_region_;
    std::vector<Event> inside;
    for (const Event& e : events) {
      if (e.x >= r.x0 && e.x < r.x1 && e.y >= r.y0 && e.y < r.y1) inside.push_back(e);
    }
    return inside;
  }

  static const Intrinsics kIntrinsics;
  Eigen::Vector3d vehicle_v_W_ = Eigen::Vector3d::Zero();
  Eigen::Vector3d vehicle_w_W_ = Eigen::Vector3d::Zero();
  Eigen::Vector3d ball_p_W_{-0.2, 0, 2};
  Eigen::Vector3d ball_v_W_{-6, 0.5, 0.3};
  int regions_ = 0;   // drawn for the last events()
  Rect last_region_;  // of those drawn

 private:
  static Eigen::Quaterniond turned(const Eigen::Vector3d& w_W, TimeUs t_us) {
    if (w_W.norm() == 0) return Eigen::Quaterniond::Identity();
    return Eigen::Quaterniond(Eigen::AngleAxisd(w_W.norm() * seconds(t_us), w_W.normalized()));
  }

  Sampler new_sampler() const {
    Sampler sampler(SamplingSpec(), kIntrinsics, X_BC_, {world_.object(0).bounding_radius_m});
    sampler.reset(0);
    return sampler;
  }

  const float* look(TimeUs t_us, const Rect& region) {
    const Snapshot s = scene(t_us);
    renderer_.render(s, s.vehicle.pose() * X_BC_, region, picture_.data(), nullptr);
    return picture_.data();
  }

  World world_;
  Eigen::Isometry3d X_BC_;
  LuminanceRenderer renderer_;
  std::vector<float> picture_;
};

const Intrinsics ThrownBall::kIntrinsics;

TEST_F(ThrownBall, GivesACameraAtRestTheSameEventsByItsRegionAndByWholePictures) {
  const struct {
    Eigen::Vector3d p_W, v_W;
  } throws[] = {{{-0.2, 0, 2}, {-6, 0.5, 0.3}},  // at the camera
                {{0, 1.9, 1.6}, {1, -8, 2}}};    // enters from the left
  for (const auto& toss : throws) {
    ball_p_W_ = toss.p_W;
    ball_v_W_ = toss.v_W;
    const auto wanted = samples(70000);
    EventCameraSpec slow;  // pixels that still settle when the region has moved on
    slow.jitter_us = 0;    // depends on the microsecond
    for (const EventCameraSpec& spec : {event_camera_preset("ideal"), slow}) {
      const auto by_region = events(spec, wanted, false);
      EXPECT_GT(regions_, 40);
      const auto by_picture = events(spec, wanted, true);
      ASSERT_GT(by_picture.size(), 3000u);
      if (spec.photoreceptor_hz == 0) {
        EXPECT_TRUE(by_region == by_picture);
        continue;
      }
      const auto difference = compare(by_region, by_picture);
      EXPECT_LT(std::abs(difference.count), 0.001);
      EXPECT_GT(difference.matched, 0.998);
      EXPECT_LE(difference.p90_us, 1);
    }
  }
}

// The events outside the region differ as those of any static scene do that is sampled more often.
TEST_F(ThrownBall, GivesAHoveringCameraTheSameEventsInItsRegion) {
  vehicle_v_W_ = Eigen::Vector3d(0.02, -0.03, 0.02);
  vehicle_w_W_ = Eigen::Vector3d(0.05, -0.1, 0.08);
  const auto wanted = samples(70000);
  const auto by_region = in_region(events(event_camera_preset("ideal"), wanted, false));
  EXPECT_GT(regions_, 40);
  const auto by_picture = in_region(events(event_camera_preset("ideal"), wanted, true));
  ASSERT_GT(by_picture.size(), 3000u);
  const auto difference = compare(by_region, by_picture);
  EXPECT_LT(std::abs(difference.count), 0.01);
  EXPECT_LT(difference.median_us, 50);
  EXPECT_GT(difference.matched, 0.95);
}

TEST_F(ThrownBall, ByItsRegionGivesTheEventsOfAFourTimesFinerReference) {
  const auto wanted = samples(50000);
  std::vector<TimeUs> times;
  for (const Sample& sample : wanted) times.push_back(sample.t_us);
  std::vector<Sample> fine;
  for (const TimeUs t : subdivide(times, 4)) fine.push_back({t, Sample::kWholeImage});
  const auto reference = events(event_camera_preset("ideal"), fine, true);
  ASSERT_GT(reference.size(), 3000u);
  const auto difference = compare(events(event_camera_preset("ideal"), wanted, false), reference);
  // The print on the ball is fine, and moves up to a pixel between samples.
  EXPECT_LT(std::abs(difference.count), 0.03);
  EXPECT_LT(difference.median_us, 100);
  EXPECT_GT(difference.matched, 0.9);
}

}  // namespace
}  // namespace dodgesim

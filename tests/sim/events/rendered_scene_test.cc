// Renderer, sampler and event camera together.
#include <gtest/gtest.h>

#include <string>

#include "sim/base/mujoco.h"
#include "sim/render/luminance_renderer.h"
#include "tests/sim/events/moving_plane.h"

namespace dodgesim {
namespace {

using testing::compare;
using testing::MovingPlane;
using testing::sample_times;
using testing::subdivide;

const Intrinsics kIntrinsics;

// MuJoCo geoms seen by the camera of a MovingPlane.
class RenderedScene {
 public:
  RenderedScene(const std::string& assets, const std::string& geoms)
      : model_(compile_model("<mujoco><statistic extent=\"8\"/><visual><map zfar=\"6\"/>"
                             "<headlight ambient=\"0.8 0.8 0.8\" diffuse=\"0 0 0\"/></visual>"
                             "<asset>" +
                                 assets + "</asset><worldbody>" + geoms + "</worldbody></mujoco>",
                             DODGESIM_SOURCE_DIR "/models", "test scene")),
        renderer_(*model_, {}, kIntrinsics, RenderSpec()) {}

  std::vector<Event> events(const MovingPlane& motion, const std::vector<TimeUs>& times) {
    const EventCameraSpec spec = event_camera_preset("ideal");
    EventCamera camera(spec, kIntrinsics.width, kIntrinsics.height, 1, 0, "top");
    std::vector<Event> events;
    camera.reset(0, look(motion, 0));
    for (const TimeUs t : times) camera.update(t, look(motion, t), events);
    return events;
  }

 private:
  const float* look(const MovingPlane& motion, TimeUs t_us) {
    const Snapshot snapshot = motion.snapshot(t_us);
    renderer_.render(snapshot, snapshot.vehicle.pose() * MovingPlane::X_BC(),
                     {0, 0, kIntrinsics.width, kIntrinsics.height}, picture_.data(), nullptr);
    return picture_.data();
  }

  MjModelPtr model_;
  LuminanceRenderer renderer_;
  std::vector<float> picture_ =
      std::vector<float>(static_cast<std::size_t>(kIntrinsics.width * kIntrinsics.height));
};

TEST(RenderedScene, ATexturedWallGivesTheEventsOfAnEightTimesFinerReference) {
  RenderedScene scene(
      "<texture name=\"wall\" type=\"2d\" file=\"textures/wall.png\"/>"
      "<material name=\"wall\" texture=\"wall\" texrepeat=\"0.244140625 0.244140625\" "
      "texuniform=\"true\"/>",
      "<geom type=\"plane\" pos=\"3 0 0\" xyaxes=\"0 -1 0 0 0 1\" size=\"20 20 .1\" "
      "material=\"wall\"/>");
  const struct {
    Eigen::Vector3d v_W, w_W;
    TimeUs duration_us;
  } motions[] = {{{0, 0, 0}, {0, 0, 5}, 10000},
                 {{0, 0, 0}, {4, 2, 0}, 10000},
                 {{0, 3, 0}, {0, 0, 0}, 30000},
                 {{1.5, 1, 2}, {0, 0, 0}, 30000}};
  for (const auto& motion : motions) {
    MovingPlane camera;
    camera.intrinsics = kIntrinsics;
    camera.v_W = motion.v_W;
    camera.w_W = motion.w_W;
    const auto times = sample_times(camera, SamplingSpec(), 2.9, motion.duration_us);
    const auto reference = scene.events(camera, subdivide(times, 8));
    const auto difference = compare(scene.events(camera, times), reference);
    ASSERT_GT(reference.size(), 2000u);
    EXPECT_LT(std::abs(difference.count), 0.02);
    EXPECT_LT(difference.median_us, 100);
    EXPECT_GT(difference.matched, 0.95);
  }
}

TEST(RenderedScene, ABrightBoxUpLeftShowsEveryFlip) {
  RenderedScene scene(
      "",
      "<geom type=\"plane\" pos=\"3 0 0\" xyaxes=\"0 -1 0 0 0 1\" size=\"20 20 .1\" "
      "rgba=\".1 .1 .1 1\"/>"
      "<geom type=\"box\" pos=\"2.9 1 0.5\" size=\".05 .2 .2\" rgba=\"1 1 1 1\"/>");
  struct Means {
    Eigen::Vector2d on = Eigen::Vector2d::Zero(), off = Eigen::Vector2d::Zero();
  };
  const auto means = [&](const Eigen::Vector3d& w_W) {
    MovingPlane camera;
    camera.intrinsics = kIntrinsics;
    camera.w_W = w_W;
    const auto events = scene.events(camera, sample_times(camera, SamplingSpec(), 2.8, 10000));
    Means means;
    double on = 0, off = 0;
    for (const Event& event : events) {
      EXPECT_LT(event.x, kIntrinsics.cx());
      EXPECT_LT(event.y, kIntrinsics.cy());
      (event.polarity > 0 ? means.on : means.off) += Eigen::Vector2d(event.x, event.y);
      (event.polarity > 0 ? on : off) += 1;
    }
    EXPECT_GT(on, 100);
    EXPECT_GT(off, 100);
    means.on /= on;
    means.off /= off;
    return means;
  };
  // The camera turns left, the scene moves right: bright pixels appear at the right side.
  const Means left = means({0, 0, 2});
  EXPECT_GT(left.on.x(), left.off.x() + 15);
  EXPECT_NEAR(left.on.y(), left.off.y(), 3);
  // The camera turns down (about +y of W), the scene moves up.
  const Means down = means({0, 2, 0});
  EXPECT_LT(down.on.y(), down.off.y() - 15);
  EXPECT_NEAR(down.on.x(), down.off.x(), 3);
}

}  // namespace
}  // namespace dodgesim

#include "sim/render/scene_pictures.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "sim/base/error.h"
#include "tests/sim/render/render_fixture.h"

namespace dodgesim {
namespace {

constexpr int kWidth = 160, kHeight = 120;

class Pictures : public ::testing::Test {
 protected:
  Pictures()
      : model_(compile_model(
            "<mujoco><worldbody><light directional='true' dir='0 0 -1'/>"
            "<geom type='plane' size='5 5 .1' rgba='.2 .2 .2 1'/><body name='vehicle' pos='0 0 "
            "1'><freejoint/><geom type='box' size='.2 .2 .1' rgba='0 0 1 1' group='3'/></body>" +
                thrown(0, "<geom type='sphere' size='.15' rgba='1 0 0 1'/>") +
                "</worldbody></mujoco>",
            ".", "picture scene")),
        pictures_(*model_, body("vehicle"), {body("object0")}, kWidth, kHeight),
        rgb_(3 * kWidth * kHeight) {
    snapshot_.vehicle.p_W = {0, 0, 1};
    snapshot_.objects.resize(1);
    snapshot_.objects[0].p_W = {0, 0.6, 1};
    snapshot_.launched = {true};
    view_.look_at_W = {0, 0, 1};
    view_.distance_m = 2;
    view_.elevation_deg = -10;
  }
  int body(const char* name) const { return mj_name2id(model_.get(), mjOBJ_BODY, name); }
  void draw(const std::vector<PictureDot>& dots = {}) {
    pictures_.draw(snapshot_, view_, dots, rgb_.data());
  }
  // Pixels where one channel stands out, and their mean column.
  int count(int channel, double* mean_x = nullptr) const {
    int n = 0, sum = 0;
    for (int i = 0; i < kWidth * kHeight; ++i) {
      const std::uint8_t* p = rgb_.data() + 3 * i;
      const int other = std::max(p[(channel + 1) % 3], p[(channel + 2) % 3]);
      if (p[channel] <= other + 40) continue;
      ++n;
      sum += i % kWidth;
    }
    if (mean_x && n) *mean_x = static_cast<double>(sum) / n;
    return n;
  }

  MjModelPtr model_;
  ScenePictures pictures_;
  std::vector<std::uint8_t> rgb_;
  Snapshot snapshot_;
  PictureView view_;
};

TEST_F(Pictures, ShowVehicleAndLaunchedObjectWhereTheyAre) {
  draw();
  double vehicle_x = 0, object_x = 0;
  EXPECT_GT(count(2, &vehicle_x), 100);
  EXPECT_GT(count(0, &object_x), 100);
  EXPECT_NEAR(vehicle_x, 0.5 * kWidth, 3);
  EXPECT_LT(object_x, vehicle_x - 20);  // +y is on the left of a view along +x
  view_.azimuth_deg = 180;
  draw();
  count(0, &object_x);
  EXPECT_GT(object_x, vehicle_x + 20);
}

TEST_F(Pictures, HideAnObjectBeforeItsLaunch) {
  snapshot_.launched = {false};
  draw();
  EXPECT_EQ(count(0), 0);
}

TEST_F(Pictures, ShowDotsAndHaveTheTopFirst) {
  draw({{{0, 0, 1.5}, 0.05, {0, 1, 0, 1}}});
  EXPECT_GT(count(1), 5);
  int above = 0;
  for (int i = 0; i < kWidth * kHeight / 2; ++i)
    above += rgb_[static_cast<std::size_t>(3 * i + 1)] > 150;
  EXPECT_GT(above, 5);
}

TEST_F(Pictures, RefuseAnImpossibleSize) {
  EXPECT_THROW(ScenePictures(*model_, -1, {}, 0, 100), ScenarioError);
  EXPECT_THROW(ScenePictures(*model_, -1, {}, 4000, 100), ScenarioError);
}

TEST_F(Pictures, LeaveOtherContextsAlone) {
  Scene scene(std::string(kWhiteLight) +
              "<worldbody><geom type='sphere' size='.3' pos='2 0 0'/></worldbody>");
  const Image before = scene.render(forward_camera());
  draw();
  EXPECT_EQ(scene.render(forward_camera()).luminance, before.luminance);
}

}  // namespace
}  // namespace dodgesim

// Values, orientation, occlusion, ids, regions and repeatability of the luminance renderer.
#include "sim/render/luminance_renderer.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "sim/base/error.h"
#include "tests/sim/render/full_scene.h"

namespace dodgesim {
namespace {

using Eigen::Vector3d;

TEST(LuminanceRenderer, DrawsARegionWithTheBitsOfTheFullFrame) {
  Scene scene = full_scene();
  const Image full = scene.render(tilted_camera());
  for (const Rect& region :
       {Rect{0, 0, 1, 1}, Rect{37, 51, 77, 91}, Rect{101, 3, 102, 240}, Rect{140, 90, 156, 106},
        Rect{200, 120, 320, 240}, Rect{63, 63, 65, 65}, Rect{0, 118, 320, 119},
        Rect{0, 131, 320, 132}}) {
    scene.render(forward_camera({0.5, 0.2, 0.8}));  // what it leaves behind must not show
    const Image part = scene.render(tilted_camera(), region);
    for (int y = 0; y < 240; ++y) {
      for (int x = 0; x < 320; ++x) {
        const bool inside = x >= region.x0 && x < region.x1 && y >= region.y0 && y < region.y1;
        const std::size_t i = full.index(x, y);
        ASSERT_EQ(part.luminance[i], inside ? full.luminance[i] : -1.0f) << x << ", " << y;
        ASSERT_EQ(part.id[i], inside ? full.id[i] : -7) << x << ", " << y;
      }
    }
  }
}

TEST(LuminanceRenderer, ClipsARegionToTheImage) {
  Scene scene = full_scene();
  const Image full = scene.render(tilted_camera());
  EXPECT_EQ(scene.render(tilted_camera(), {-50, -50, 1000, 1000}).luminance, full.luminance);
  EXPECT_EQ(scene.render(tilted_camera(), {10, 10, 10, 20}).at(10, 10), -1.0);
}

TEST(LuminanceRenderer, RepeatsEveryBitAlsoInAnotherRendererAndWithoutIds) {
  Scene scene = full_scene(), other = full_scene();
  const Image first = scene.render(tilted_camera());
  scene.render(forward_camera());
  EXPECT_EQ(scene.render(tilted_camera()).luminance, first.luminance);
  EXPECT_EQ(other.render(tilted_camera()).luminance, first.luminance);
  EXPECT_EQ(other.render(tilted_camera()).id, first.id);
  Image without_ids(scene.camera());
  scene.render_without_ids(tilted_camera(), without_ids);
  EXPECT_EQ(without_ids.luminance, first.luminance);
}

// Four white balls, each in a corner of the view of its own kind, one in the middle.
TEST(LuminanceRenderer, ShowsLeftOnTheLeftAndUpAbove) {
  Scene scene(std::string(kWhiteLight) +
              "<worldbody><geom type='box' size='.05 .3 .3' pos='3 1 .7' rgba='.2 .2 .2 1'/>" +
              thrown(0, "<geom type='sphere' size='.2'/>") +
              thrown(1, "<geom type='sphere' size='.2'/>") + "</worldbody>");
  scene.snapshot().objects[0].p_W = {3, 1.5, -0.8};  // left, below
  scene.snapshot().objects[1].p_W = {3, -1.5, 0.8};  // right, above
  const Image image = scene.render(forward_camera());
  const double f = image.camera.f;
  const auto id_at = [&](double left, double up) {
    return image.id_at(static_cast<int>(std::lround(image.camera.cx() - f * left / 3)),
                       static_cast<int>(std::lround(image.camera.cy() - f * up / 3)));
  };
  EXPECT_EQ(id_at(1.5, -0.8), 1);
  EXPECT_EQ(id_at(-1.5, 0.8), 2);
  EXPECT_EQ(id_at(1, 0.7), 0);
  EXPECT_EQ(id_at(-1, -0.7), -1);
}

TEST(LuminanceRenderer, TurnsTheImageAgainstTheCamerasRoll) {
  Scene scene(std::string(kWhiteLight) + "<worldbody>" +
              thrown(0, "<geom type='sphere' size='.1'/>") + "</worldbody>");
  Eigen::Isometry3d X_WC = forward_camera();
  // Right wing down (positive about the forward axis): what was above moves to the left.
  X_WC.linear() =
      Eigen::AngleAxisd(0.5 * mjPI, Vector3d::UnitX()).toRotationMatrix() * X_WC.linear();
  scene.snapshot().objects[0].p_W = {2, 0, 0.5};
  const Image image = scene.render(X_WC);
  EXPECT_EQ(image.id_at(112, 120), 1);
  EXPECT_EQ(image.id_at(207, 120), -1);
}

TEST(LuminanceRenderer, LightsALambertianPlaneByTheCosineAndTheLampByItsCone) {
  const std::string plane =
      "<geom type='plane' size='9 9 1' pos='2 0 0' zaxis='-1 0 0' rgba='.4 .4 .4 1'/>";
  Scene sun(std::string(kNoHeadlight) +
            "<worldbody><light directional='true' dir='.6 0 -.8' "
            "ambient='.1 .1 .1' diffuse='.9 .9 .9'/>" +
            plane + "</worldbody>");
  EXPECT_NEAR(sun.render(forward_camera()).at(160, 120), 0.4 * (0.1 + 0.9 * 0.6), 1e-6);
  Scene behind(std::string(kNoHeadlight) +
               "<worldbody><light directional='true' dir='-1 0 0' "
               "ambient='.1 .1 .1' diffuse='.9 .9 .9'/>" +
               plane + "</worldbody>");
  EXPECT_NEAR(behind.render(forward_camera()).at(160, 120), 0.4 * 0.1, 1e-6);

  Scene lamp(std::string(kNoHeadlight) +
             "<worldbody><light pos='0 0 0' dir='1 0 0' cutoff='20' "
             "exponent='3' attenuation='1 .5 .2' ambient='0 0 0' diffuse='1 1 1'/>" +
             plane + "</worldbody>");
  const Image image = lamp.render(forward_camera());
  for (const int x : {160, 180, 200, 215}) {
    const double tangent = (x - image.camera.cx()) / image.camera.f;
    const double offset = (120 - image.camera.cy()) / image.camera.f;
    const double d = 2 * std::sqrt(1 + tangent * tangent + offset * offset), c = 2 / d;
    EXPECT_NEAR(image.at(x, 120), 0.4 * c * std::pow(c, 3) / (1 + 0.5 * d + 0.2 * d * d), 1e-5);
  }
  EXPECT_EQ(image.at(260, 120), 0.0);  // outside the cone
}

TEST(LuminanceRenderer, LightsABallByItsNormals) {
  Scene scene(std::string(kNoHeadlight) +
              "<worldbody><light directional='true' dir='0 0 -1' ambient='0 0 0' diffuse='1 1 "
              "1'/>" +
              thrown(0, "<geom type='sphere' size='.5' rgba='.5 .5 .5 1'/>") + "</worldbody>");
  scene.snapshot().objects[0].p_W = {2, 0, 0};
  const Image image = scene.render(forward_camera());
  for (const int y : {85, 100, 115}) {
    // Where the ray through the pixel meets the ball.
    const Vector3d d(1, 0, -(y - image.camera.cy()) / image.camera.f);
    const Vector3d side(1, (image.camera.cx() - 160) / image.camera.f, d.z());
    const double a = side.squaredNorm(), b = -2 * side.x();
    const double t = (-b - std::sqrt(b * b - a * (4 - 0.25))) / a;
    const Vector3d normal = (t * side - Vector3d(2, 0, 0)) / 0.5;
    EXPECT_NEAR(image.at(160, y), 0.5 * std::max(0.0, normal.z()), 1e-4);
  }
  EXPECT_EQ(image.at(160, 140), 0.0);  // the underside
}

TEST(LuminanceRenderer, LightsAThrownBallByALampWhereverTheyAre) {
  Scene scene(std::string(kNoHeadlight) +
              "<worldbody><light pos='1 .5 3' dir='0 0 -1' cutoff='80' exponent='0' "
              "attenuation='0 1 0' ambient='0 0 0' diffuse='1 1 1'/>" +
              thrown(0, "<geom type='box' size='.2 .2 .1' rgba='.5 .5 .5 1'/>") + "</worldbody>");
  BodyState& box = scene.snapshot().objects[0];
  box.p_W = {1, 0.5, 1};
  box.q_W = Eigen::AngleAxisd(0.7, Vector3d::UnitZ());
  Eigen::Isometry3d X_WC = Eigen::Isometry3d::Identity();  // looks down on it from beside the lamp
  X_WC.linear() = Eigen::Vector3d(1, -1, -1).asDiagonal();
  X_WC.translation() = Vector3d(1, 0.5, 3);
  // Its top is 1.9 m below the lamp.
  const Image image = scene.render(X_WC);
  EXPECT_NEAR(image.at(160, 120), 0.5 / 1.9, 1e-4);
  box.q_W = Eigen::AngleAxisd(3.0, Vector3d::UnitX()) * box.q_W;  // now the other side is up
  EXPECT_NEAR(scene.render(X_WC).at(160, 120), 0.5 / 1.9 * std::cos(std::numbers::pi - 3), 2e-3);
}

// Few lights reach the fragments by another way than many.
TEST(LuminanceRenderer, LetsDarkLightsChangeNoBitHoweverManyThereAre) {
  Scene plain = full_scene();
  const Image expected = plain.render(tilted_camera());
  const auto dark = [](const std::string& kind) {
    return "<light " + kind + " dir='0 0 -1' ambient='0 0 0' diffuse='0 0 0'/>";
  };
  for (const int more : {1, 2, 4, 12}) {  // of both kinds
    std::string content = kFullScene;
    for (int i = 0; i < more; ++i) {
      content.insert(content.find("<geom"), dark("directional='true'") + dark("pos='1 0 3'"));
    }
    Scene scene(content);
    scene.snapshot() = plain.snapshot();
    const Image image = scene.render(tilted_camera());
    EXPECT_TRUE(image.luminance == expected.luminance) << more << " more";
  }
}

TEST(LuminanceRenderer, WeighsColoursByRec709AndReadsTexels) {
  const std::string light =
      "<visual><headlight ambient='1 1 1' diffuse='0 0 0' specular='0 0 0'/></visual>";
  Scene color(light +
              "<worldbody><geom type='plane' size='9 9 1' pos='2 0 0' zaxis='-1 0 0' "
              "rgba='.2 .5 .8 1'/></worldbody>");
  EXPECT_NEAR(color.render(forward_camera()).at(50, 50), .2 * .2126 + .5 * .7152 + .8 * .0722,
              1e-6);

  const std::string textured =
      light +
      "<asset><texture name='t' type='2d' builtin='flat' rgb1='.6 .4 .2' width='8' height='8'/>"
      "<material name='m' texture='t' rgba='.5 1 1 1'/></asset>"
      "<worldbody><geom type='plane' size='9 9 1' pos='2 0 0' zaxis='-1 0 0' material='m'/>"
      "</worldbody>";
  const double r = std::round(.6 * 255) / 255, g = std::round(.4 * 255) / 255,
               b = std::round(.2 * 255) / 255;
  // MuJoCo truncates or rounds its built-in colours to bytes: allow for one count.
  EXPECT_NEAR(Scene(textured).render(forward_camera()).at(50, 50),
              .5 * r * .2126 + g * .7152 + b * .0722, 0.005);
  RenderSpec photographs;
  photographs.texel_encoding = "srgb";
  const auto linear = [](double code) { return std::pow((code + 0.055) / 1.055, 2.4); };
  EXPECT_NEAR(Scene(textured, photographs).render(forward_camera()).at(50, 50),
              .5 * linear(r) * .2126 + linear(g) * .7152 + linear(b) * .0722, 0.005);
}

TEST(LuminanceRenderer, LetsTheNearerHideTheFarther) {
  Scene scene(std::string(kWhiteLight) +
              "<worldbody><geom type='box' size='.01 .2 .2' pos='3 0 0' rgba='.3 .3 .3 1'/>"
              "<geom type='cylinder' size='.1 1' pos='2 -.4 0' rgba='.5 .5 .5 1'/>" +
              thrown(0, "<geom type='sphere' size='.1' rgba='.9 .9 .9 1'/>") +
              thrown(1, "<geom type='box' size='.1 .1 .1' rgba='.7 .7 .7 1'/>") + "</worldbody>");
  auto& objects = scene.snapshot().objects;
  const auto look = [&](double x0, double x1) {
    objects[0].p_W = {x0, 0, 0};
    objects[1].p_W = {x1, 0, 0};
    return scene.render(forward_camera());
  };
  Image image = look(1.5, 2.5);
  EXPECT_EQ(image.id_at(160, 120), 1);
  EXPECT_NEAR(image.at(160, 120), 0.9, 1e-6);
  image = look(2.5, 1.5);
  EXPECT_EQ(image.id_at(160, 120), 2);
  EXPECT_NEAR(image.at(160, 120), 0.7, 1e-6);
  image = look(4, 5);  // both behind the static box
  EXPECT_EQ(image.id_at(160, 120), 0);
  EXPECT_NEAR(image.at(160, 120), 0.3, 1e-6);
  // Behind and in front of the static cylinder.
  const int x = static_cast<int>(std::lround(image.camera.cx() + image.camera.f * 0.2));
  objects[0].p_W = {2.5, -0.5, 0};
  objects[1].p_W = {9, 9, 9};
  EXPECT_EQ(scene.render(forward_camera()).id_at(x, 120), 0);
  objects[0].p_W = {1.5, -0.3, 0};
  EXPECT_EQ(scene.render(forward_camera()).id_at(x, 120), 1);
}

TEST(LuminanceRenderer, BlendsAnOutlineWithWhatIsBehindIt) {
  RenderSpec spec;
  spec.sky_luminance = 0.1;
  Scene scene(std::string(kWhiteLight) + "<worldbody>" +
                  thrown(0, "<geom type='sphere' size='.1' rgba='.9 .9 .9 1'/>") +
                  thrown(1, "<geom type='sphere' size='.6' rgba='.7 .7 .7 1'/>") + "</worldbody>",
              spec);
  for (const bool swapped : {false, true}) {
    auto& objects = scene.snapshot().objects;
    objects[0].p_W = {swapped ? 4.0 : 1.5, 0, 0};
    objects[1].p_W = {3, 0, 0};
    const Image image = scene.render(forward_camera());
    // The ball of 0.6 m covers 37 px around the middle.
    for (int y = 95; y < 145; ++y) {
      for (int x = 135; x < 185; ++x) {
        ASSERT_GT(image.at(x, y), 0.699) << x << ", " << y;
        ASSERT_LT(image.at(x, y), swapped ? 0.701 : 0.901) << x << ", " << y;
      }
    }
  }
}

// A coverage that is rounded to more than 1 must not take light away that is not there.
TEST(LuminanceRenderer, ABlackBallIsNowhereDarkerThanBlack) {
  RenderSpec spec;
  spec.sky_luminance = 0.9;
  Scene scene(std::string(kWhiteLight) + "<worldbody>" +
                  thrown(0, "<geom type='sphere' size='.05' rgba='0 0 0 1'/>") + "</worldbody>",
              spec);
  for (int k = 0; k < 60; ++k) {
    scene.snapshot().objects[0].p_W = {2.5 + 0.05 * k, 0.013 * k, 0.007 * k};
    const Image image = scene.render(forward_camera());
    for (const float luminance : image.luminance) ASSERT_GE(luminance, 0) << k;
  }
}

TEST(LuminanceRenderer, ACubeTextureStaysWhereItIsOnAnUnboundedPlane) {
  Scene scene(std::string(kWhiteLight) +
              "<asset><texture name='t' type='cube' builtin='flat' mark='edge' rgb1='0 0 0' "
              "markrgb='1 1 1' width='16' height='96'/><material name='m' texture='t'/></asset>"
              "<worldbody><geom type='plane' size='0 0 1' pos='0 0 -1' material='m'/></worldbody>");
  // Between two faces there is a line from the origin, half to the left.
  Eigen::Isometry3d before = forward_camera();
  before.linear() = Eigen::AngleAxisd(0.7, Vector3d::UnitZ()) * before.linear();
  Eigen::Isometry3d after = before;
  before.translation().x() = 0.9999;
  after.translation().x() = 1.0001;
  const Image a = scene.render(before), b = scene.render(after);
  int differ = 0;
  for (std::size_t i = 0; i < a.luminance.size(); ++i) {
    differ += std::abs(a.luminance[i] - b.luminance[i]) > 0.2 ? 1 : 0;
  }
  EXPECT_LT(differ, 50);
  EXPECT_GT(std::ranges::count_if(a.luminance, [](float l) { return l > 0.5f; }), 500);
}

TEST(LuminanceRenderer, DrawsWhatIsNearAndLeavesTheFarToTheSky) {
  RenderSpec spec;
  spec.sky_luminance = 0.25;
  Scene scene(std::string(kWhiteLight) +
                  "<worldbody><geom type='plane' size='0 0 1' pos='0 0 -1'/>" +
                  thrown(0, "<geom type='sphere' size='.02' rgba='1 1 1 1'/>") + "</worldbody>",
              spec);
  scene.snapshot().objects[0].p_W = {0.05, 0, 0};
  Image image = scene.render(forward_camera());
  EXPECT_EQ(image.id_at(160, 120), 1);
  EXPECT_NEAR(image.at(160, 120), 1.0, 1e-6);
  scene.snapshot().launched[0] = false;
  image = scene.render(forward_camera());
  EXPECT_EQ(image.id_at(160, 110), -1);
  EXPECT_NEAR(image.at(160, 110), 0.25, 1e-6);
  EXPECT_EQ(image.id_at(160, 121),
            0);  // the plane reaches to the horizon, between rows 119 and 120
  EXPECT_EQ(image.id_at(160, 118), -1);
}

TEST(LuminanceRenderer, HidesUnlaunchedObjectsAndTheVehiclesGroup) {
  Scene scene(std::string(kWhiteLight) +
              "<worldbody><body><freejoint/><geom type='sphere' size='.3' pos='2 0 0'/></body>"
              "<geom type='sphere' size='.3' pos='2 .8 0' group='3'/>" +
              thrown(0, "<geom type='sphere' size='.1'/>") + "</worldbody>");
  scene.snapshot().objects[0].p_W = {2, -0.5, 0};
  scene.snapshot().launched[0] = false;
  for (const int id : scene.render(forward_camera()).id) ASSERT_EQ(id, -1);
}

TEST(LuminanceRenderer, PlacesAnObjectByItsCentreOfMass) {
  Scene scene(std::string(kWhiteLight) +
              "<worldbody><body name='object0'><freejoint/>"
              "<inertial pos='0 .5 0' mass='1' diaginertia='1e-3 1e-3 1e-3'/>"
              "<geom type='sphere' size='.1' pos='0 .5 0'/></body></worldbody>");
  scene.snapshot().objects[0].p_W = {2, 0, 0};
  scene.snapshot().objects[0].q_W = Eigen::AngleAxisd(1.0, Vector3d::UnitZ());
  EXPECT_EQ(scene.render(forward_camera()).id_at(160, 120), 1);
}

TEST(LuminanceRenderer, RejectsAGeomThatItCannotDraw) {
  EXPECT_THROW(Scene("<asset><hfield name='h' nrow='4' ncol='4' size='1 1 1 1'/></asset><worldbody>"
                     "<geom type='hfield' hfield='h'/></worldbody>"),
               ScenarioError);
}

TEST(LuminanceRenderer, RejectsLightBelowZero) {
  const char* const ball = "<worldbody><geom type='sphere' size='1' material='m'/>";
  for (const char* material : {"emission='-1'", "rgba='1 -1 1 1'"}) {
    EXPECT_THROW(Scene(std::string("<asset><material name='m' ") + material + "/></asset>" + ball +
                       "</worldbody>"),
                 ScenarioError)
        << material;
  }
  for (const char* light : {"diffuse='-1 0 0'", "ambient='0 -1 0'", "attenuation='0 0 0'"}) {
    EXPECT_THROW(Scene(std::string("<worldbody><light pos='0 0 1' dir='0 0 -1' ") + light +
                       "/></worldbody>"),
                 ScenarioError)
        << light;
  }
}

}  // namespace
}  // namespace dodgesim

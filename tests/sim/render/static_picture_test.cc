// The static scene with its depth, and objects drawn over it: luminance_renderer.h.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "sim/world/ray.h"
#include "sim/world/world.h"
#include "tests/sim/render/full_scene.h"

namespace dodgesim {
namespace {

using Eigen::Isometry3d;
using Eigen::Vector3d;

double difference(const Image& a, const Image& b, int x, int y) {
  return std::abs(a.at(x, y) - b.at(x, y));
}

struct Differences {
  int count = 0;  // pixels that differ by more than 1e-6
  double largest = 0;
  Rect about;  // the pixels that differ
};

Differences differences(const Image& a, const Image& b) {
  Differences d;
  for (int y = 0; y < a.camera.height; ++y) {
    for (int x = 0; x < a.camera.width; ++x) {
      const double now = difference(a, b, x, y);
      d.largest = std::max(d.largest, now);
      if (now <= 1e-6) continue;
      ++d.count;
      d.about = merged(d.about, {x, y, x + 1, y + 1});
    }
  }
  return d;
}

TEST(StaticPicture, IsTheWholePictureWithoutThrownObjects) {
  Scene scene = full_scene();
  std::vector<float> inverse_depth;
  scene.render(forward_camera());  // what it leaves behind must not show
  const Image still = scene.render_static(tilted_camera(), inverse_depth);
  scene.snapshot().launched.assign(3, false);
  EXPECT_EQ(still.luminance, scene.render(tilted_camera()).luminance);
}

TEST(StaticPicture, WithOtherIntrinsicsIsThatOfARendererMadeForThem) {
  const Intrinsics fine{512, 416, 2 * 190.68};
  Scene scene = full_scene(), other(kFullScene, {}, fine);
  std::vector<float> a, b;
  scene.render(tilted_camera());
  const Image still = scene.render_static(tilted_camera(), fine, a);
  EXPECT_EQ(still.luminance, other.render_static(tilted_camera(), b).luminance);
  EXPECT_EQ(a, b);
  // And leaves the camera's own pictures as they are.
  EXPECT_EQ(scene.render(tilted_camera()).luminance,
            full_scene().render(tilted_camera()).luminance);
}

TEST(StaticPicture, HasTheDepthThatRaysFindInTheRoom) {
  World world({DODGESIM_SOURCE_DIR "/models", "room", "qav_rxl", {{"ball", 0.2}}});
  world.reset({0, 0, 2}, 0, {0, 0, 0});
  BodyState ball;
  ball.p_W = {2, 0, 2};
  world.launch(0, ball);  // not static, not in the picture
  const Intrinsics camera{640, 480, 2 * 190.68};
  LuminanceRenderer renderer(world, Intrinsics(), {});
  Image image(camera);
  std::vector<float> inverse_depth(image.luminance.size());
  int hits = 0, edges = 0;
  for (const double yaw : {0.3, 2.0, 4.0}) {
    Isometry3d X_WC = forward_camera({-1, 0.5, 1.5});
    X_WC.linear() = Eigen::AngleAxisd(yaw, Vector3d::UnitZ()).toRotationMatrix() * X_WC.linear();
    renderer.render_static(camera, X_WC, 0, image.luminance.data(), inverse_depth.data());
    for (int y = 3; y < camera.height; y += 7) {
      for (int x = 3; x < camera.width; x += 7) {
        const Vector3d ray_C((x - camera.cx()) / camera.f, (y - camera.cy()) / camera.f, 1);
        const auto hit =
            first_along(world, X_WC.translation(), X_WC.linear() * ray_C, kRoomGroup + 1);
        const double truth = hit ? 1 / hit->distance : 0;
        const double depth = inverse_depth[image.index(x, y)];
        if (std::abs(depth - truth) < 1e-4 + 1e-4 * truth) {
          ++hits;
        } else {
          ++edges;
        }
      }
    }
  }
  EXPECT_GT(hits, 15000);
  EXPECT_LT(edges, 0.002 * hits);  // a ray that touches a corner may fall to either side
}

// Walls, floor and ceiling come in parts, between which nothing may be seen.
TEST(StaticPicture, OfAClosedRoomShowsNoSky) {
  World world({DODGESIM_SOURCE_DIR "/models", "room", "qav_rxl", {}});
  const Intrinsics camera{640, 480, 2 * 190.68};
  LuminanceRenderer renderer(world, Intrinsics(), {});
  Image image(camera);
  std::vector<float> inverse_depth(image.luminance.size());
  for (int i = 0; i < 40; ++i) {
    Isometry3d X_WC = forward_camera({-4.0 + 0.2 * i, 2.0 - 0.1 * i, 0.7 + 0.09 * i});
    X_WC.linear() = Eigen::AngleAxisd(0.7 * i, Vector3d(0.2, 0.3, 1).normalized()) * X_WC.linear();
    renderer.render_static(camera, X_WC, 0, image.luminance.data(), inverse_depth.data());
    EXPECT_EQ(std::count(inverse_depth.begin(), inverse_depth.end(), 0.0f), 0) << i;
  }
}

TEST(StaticPicture, TheSkyHasInverseDepthZero) {
  Scene scene(std::string(kWhiteLight) +
              "<worldbody><geom type='plane' size='0 0 1' pos='0 0 -1'/></worldbody>");
  std::vector<float> inverse_depth;
  const Image image = scene.render_static(forward_camera(), inverse_depth);
  EXPECT_EQ(inverse_depth[image.index(7, 5)], 0.0f);
  EXPECT_EQ(inverse_depth[image.index(160, 118)], 0.0f);
  // The plane 1 m below: 1/z = tan of the angle below the horizon.
  for (const int y : {121, 130, 200, 239}) {
    const double truth = (y - image.camera.cy()) / image.camera.f;
    EXPECT_NEAR(inverse_depth[image.index(44, y)], truth, 3e-5) << y;
  }
}

TEST(StaticPicture, TheDepthOfRoundThingsIsThatOfTheirSurface) {
  Scene scene(std::string(kWhiteLight) +
              "<worldbody><geom type='sphere' size='.5' pos='2 0 0'/>"
              "<geom type='cylinder' size='.3 2' pos='2 1.2 0'/></worldbody>");
  std::vector<float> inverse_depth;
  const Image image = scene.render_static(forward_camera(), inverse_depth);
  const Intrinsics& camera = image.camera;
  for (const int x : {130, 150, 160, 185}) {
    for (const int y : {90, 120, 140}) {
      const Vector3d d(1, (camera.cx() - x) / camera.f, (camera.cy() - y) / camera.f);
      const double a = d.squaredNorm(), b = 2 * d.x();
      const double z = (b - std::sqrt(b * b - a * (4 - 0.25))) / a;
      EXPECT_NEAR(inverse_depth[image.index(x, y)], 1 / z, 2e-5);
    }
  }
  for (const int x : {40, 45, 50}) {
    const double left = (camera.cx() - x) / camera.f;
    const double a = 1 + left * left, b = 2 + 1.2 * left;
    const double square = b * b - a * (4 + 1.44 - 0.09);
    if (square < 0) continue;
    // Drawn with flat facets.
    EXPECT_NEAR(inverse_depth[image.index(x, 100)], a / (b - std::sqrt(square)), 3e-4);
  }
}

// Objects that nothing static hides.
TEST(ObjectsOverAStaticPicture, AreWhereTheWholePictureHasThem) {
  Scene scene = full_scene();
  const Isometry3d X_WC = tilted_camera();
  const Image all = scene.render(X_WC);
  for (const bool behind_static : {false, true}) {
    const Image over = scene.draw_objects(X_WC, scene.full(), behind_static);
    EXPECT_LT(differences(over, all).largest, 1e-6) << behind_static;
    for (std::size_t i = 0; i < all.id.size(); ++i) {
      ASSERT_EQ(over.id[i], std::max(all.id[i], 0));
    }
  }
  for (const int id : {1, 2, 3}) EXPECT_GT(std::count(all.id.begin(), all.id.end(), id), 50);
}

TEST(ObjectsOverAStaticPicture, HaveTheSameBitsWithoutIds) {
  Scene scene = full_scene();
  std::vector<float> inverse_depth;
  for (const bool behind_static : {false, true}) {
    const Image with = scene.draw_objects(tilted_camera(), scene.full(), behind_static);
    Image without = scene.render_static(tilted_camera(), inverse_depth);
    scene.draw_objects(tilted_camera(), scene.full(), behind_static, without, nullptr);
    EXPECT_EQ(without.luminance, with.luminance);
  }
}

TEST(ObjectsOverAStaticPicture, ChangeOnlyTheRegion) {
  Scene scene = full_scene();
  const Isometry3d X_WC = tilted_camera();
  const Image all = scene.draw_objects(X_WC, scene.full(), true);
  std::vector<float> inverse_depth;
  const Image still = scene.render_static(X_WC, inverse_depth);
  for (const Rect& r :
       {Rect{100, 80, 190, 131}, Rect{-20, 90, 160, 400}, Rect{150, 110, 151, 111}}) {
    for (const bool behind_static : {false, true}) {
      const Image part = scene.draw_objects(X_WC, r, behind_static);
      for (int y = 0; y < 240; ++y) {
        for (int x = 0; x < 320; ++x) {
          const bool inside = x >= r.x0 && x < r.x1 && y >= r.y0 && y < r.y1;
          ASSERT_EQ(part.at(x, y), inside ? all.at(x, y) : still.at(x, y)) << x << ", " << y;
          ASSERT_EQ(part.id_at(x, y), inside ? all.id_at(x, y) : -7);
        }
      }
    }
  }
}

const std::string kHidden =
    std::string(kWhiteLight) +
    "<worldbody><geom type='plane' size='9 9 1' pos='6 0 0' zaxis='-1 0 0' rgba='.4 .4 .4 1'/>"
    "<geom type='box' size='.1 .3 .5' pos='3 .4 0' rgba='.3 .3 .3 1'/>"
    "<geom type='capsule' size='.2 .6' pos='3 -.9 0' rgba='.6 .6 .6 1'/>" +
    thrown(0, "<geom type='sphere' size='.25' rgba='.9 .9 .9 1'/>") +
    thrown(1, "<geom type='box' size='.2 .2 .2' rgba='.8 .8 .8 1'/>") + "</worldbody>";

TEST(ObjectsOverAStaticPicture, AreHiddenByWhatIsInFrontOfThem) {
  Scene scene(kHidden);
  auto& objects = scene.snapshot().objects;
  const Isometry3d X_WC = forward_camera();
  std::vector<float> inverse_depth;
  const Image still = scene.render_static(X_WC, inverse_depth);
  const auto hidden = [&](const Vector3d& ball, const Vector3d& box) {
    objects[0].p_W = ball;
    objects[1].p_W = box;
    return scene.draw_objects(X_WC, scene.full(), true).luminance == still.luminance;
  };
  const Vector3d behind_the_wall = {6.5, -0.3, 0};
  EXPECT_TRUE(hidden({5, -1.5, 0}, behind_the_wall));  // behind the capsule
  EXPECT_TRUE(hidden({4, 0.5, 0}, behind_the_wall));   // behind the box
  EXPECT_FALSE(hidden({4, -0.2, 0}, behind_the_wall));
  EXPECT_TRUE(hidden({4, 0.5, 0}, behind_the_wall));
  const Image through = scene.draw_objects(X_WC, scene.full(), false);
  EXPECT_EQ(through.id_at(136, 120), 1);
  EXPECT_EQ(through.id_at(168, 120), 2);
}

TEST(ObjectsOverAStaticPicture, AMeshIsHiddenByWhatIsInFrontOfItHoweverThatIsDrawn) {
  Scene scene(std::string(kWhiteLight) +
              "<asset><mesh name='wedge' vertex='0 0 0  .1 0 0  0 .1 0  0 0 .1'/></asset>"
              "<worldbody><geom type='plane' size='9 9 1' pos='6 0 0' zaxis='-1 0 0' "
              "rgba='.4 .4 .4 1'/>"
              "<geom type='box' size='.1 .3 .5' pos='2 .8 0' rgba='.3 .3 .3 1'/>"
              "<geom type='sphere' size='.4' pos='2 -.4 0' rgba='.6 .6 .6 1'/>" +
              thrown(0, "<geom type='mesh' mesh='wedge' rgba='.9 .9 .9 1'/>") + "</worldbody>");
  const Isometry3d X_WC = forward_camera();
  std::vector<float> inverse_depth;
  const Image still = scene.render_static(X_WC, inverse_depth);
  const auto shows = [&](const Vector3d& p_W) {
    scene.snapshot().objects[0].p_W = p_W;
    const Image over = scene.draw_objects(X_WC, scene.full(), true);
    const bool id = std::count(over.id.begin(), over.id.end(), 1) > 0;
    EXPECT_EQ(over.luminance != still.luminance, id);
    return id;
  };
  EXPECT_FALSE(shows({3, 1.2, 0}));   // behind the box
  EXPECT_FALSE(shows({3, -0.6, 0}));  // behind the sphere
  EXPECT_TRUE(shows({3, 0.3, 0}));
  EXPECT_TRUE(shows({1.3, -0.3, 0}));
}

TEST(ObjectsOverAStaticPicture, DifferFromTheWholePictureOnlyAtTheEdgeThatHidesThem) {
  Scene scene(kHidden);
  auto& objects = scene.snapshot().objects;
  const Isometry3d X_WC = forward_camera();
  objects[0].p_W = {4, 0.1, 0.1};      // half behind the box
  objects[1].p_W = {4.5, -1.5, -0.2};  // half behind the capsule
  const Image all = scene.render(X_WC), over = scene.draw_objects(X_WC, scene.full(), true);
  int differ = 0;
  for (int y = 0; y < 240; ++y) {
    for (int x = 0; x < 320; ++x) {
      ASSERT_EQ(over.id_at(x, y), std::max(all.id_at(x, y), 0)) << x << ", " << y;
      if (difference(all, over, x, y) <= 1e-6) continue;
      ++differ;
      // At a pixel where the static thing in front ends.
      bool edge = false;
      for (const int dx : {-1, 1}) edge = edge || all.id_at(x, y) != all.id_at(x + dx, y);
      for (const int dy : {-1, 1}) edge = edge || all.id_at(x, y) != all.id_at(x, y + dy);
      ASSERT_TRUE(edge) << x << ", " << y;
      // What is mixed there is what is in front and what is behind, one way or the other.
      ASSERT_LT(difference(all, over, x, y), 0.6);
    }
  }
  EXPECT_LT(differ, 80);  // a column of either edge
  int seen[3] = {0, 0, 0};
  for (const int id : all.id) ++seen[std::max(id, 0)];
  EXPECT_GT(seen[1], 200);
  EXPECT_GT(seen[2], 60);
}

TEST(ObjectsOverAStaticPicture, TheNearerHidesTheFartherAndBlendsWithIt) {
  Scene scene(std::string(kWhiteLight) +
              "<worldbody><geom type='plane' size='9 9 1' pos='6 0 0' zaxis='-1 0 0' "
              "rgba='.1 .1 .1 1'/>" +
              thrown(0, "<geom type='sphere' size='.1' rgba='.9 .9 .9 1'/>") +
              thrown(1, "<geom type='sphere' size='.6' rgba='.7 .7 .7 1'/>") + "</worldbody>");
  auto& objects = scene.snapshot().objects;
  const Isometry3d X_WC = forward_camera();
  for (const bool near : {false, true}) {
    objects[0].p_W = {near ? 1.5 : 4.0, 0, 0};
    objects[1].p_W = {3, 0, 0};
    const Image all = scene.render(X_WC);
    for (const bool behind_static : {false, true}) {
      const Image over = scene.draw_objects(X_WC, scene.full(), behind_static);
      EXPECT_EQ(over.id_at(160, 120), near ? 1 : 2);
      EXPECT_LT(differences(over, all).largest, 1e-6);
      for (int y = 95; y < 145; ++y) {
        for (int x = 135; x < 185; ++x) ASSERT_GT(over.at(x, y), 0.699);  // no wall in between
      }
    }
  }
}

// Its centre is nearer, its surface is not.
TEST(ObjectsOverAStaticPicture, OneThatIsInsideAnotherIsHiddenByItAlsoWithoutIds) {
  Scene scene(std::string(kWhiteLight) + "<worldbody>" +
              thrown(0, "<geom type='sphere' size='.1' rgba='.9 .9 .9 1'/>") +
              thrown(1, "<geom type='sphere' size='.6' rgba='.7 .7 .7 1'/>") + "</worldbody>");
  scene.snapshot().objects[0].p_W = {2.9, 0, 0};
  scene.snapshot().objects[1].p_W = {3, 0, 0};
  for (const bool with_ids : {false, true}) {
    Image image(scene.camera(), 0.1f);
    scene.draw_objects(forward_camera(), scene.full(), false, image,
                       with_ids ? image.id.data() : nullptr);
    EXPECT_NEAR(image.at(160, 120), 0.7, 1e-6) << with_ids;
  }
}

TEST(ObjectsOverAStaticPicture, AreNotDrawnBeforeTheyAreLaunched) {
  Scene scene = full_scene();
  scene.snapshot().launched.assign(3, false);
  std::vector<float> inverse_depth;
  const Image still = scene.render_static(tilted_camera(), inverse_depth);
  for (const bool behind_static : {false, true}) {
    const Image over = scene.draw_objects(tilted_camera(), scene.full(), behind_static);
    EXPECT_EQ(over.luminance, still.luminance);
    for (const int id : over.id) ASSERT_EQ(id, 0);
  }
}

// What it is drawn over need not be what the renderer would draw.
TEST(ObjectsOverAStaticPicture, TakeThePictureThatTheyAreGiven) {
  Scene scene(kHidden);
  scene.snapshot().objects[0].p_W = {1.5, 0, 0};
  scene.snapshot().launched[1] = false;
  Image plain(scene.camera(), 0.123f);
  scene.draw_objects(forward_camera(), scene.full(), false, plain, plain.id.data());
  for (int y = 0; y < 240; ++y) {
    for (int x = 0; x < 320; ++x) {
      if (plain.id_at(x, y) == 1) {
        ASSERT_GT(plain.at(x, y), 0.123);
      } else if (std::hypot(x - 159.5, y - 119.5) > 36) {
        ASSERT_EQ(plain.at(x, y), static_cast<double>(0.123f));
      }
    }
  }
  EXPECT_NEAR(plain.at(160, 120), 0.9, 1e-6);
}

}  // namespace
}  // namespace dodgesim

// The renderer against MuJoCo itself: mj_ray for what is seen where, mjr_render for textures.
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "sim/render/osmesa_context.h"
#include "sim/world/world.h"
#include "tests/sim/render/render_fixture.h"

namespace dodgesim {
namespace {

using Eigen::Vector3d;

// Camera at `eye` that looks at `at`, with W's z up in the image.
Eigen::Isometry3d look_at(const Vector3d& eye, const Vector3d& at) {
  const Vector3d z = (at - eye).normalized(), x = z.cross(Vector3d::UnitZ()).normalized();
  Eigen::Isometry3d X_WC = Eigen::Isometry3d::Identity();
  X_WC.linear() << x, z.cross(x), z;
  X_WC.translation() = eye;
  return X_WC;
}

int ray_geom(const mjModel& model, const mjData& data, const Eigen::Isometry3d& X_WC,
             const Intrinsics& camera, double x, double y) {
  const Vector3d ray =
      X_WC.linear() * Vector3d((x - camera.cx()) / camera.f, (y - camera.cy()) / camera.f, 1.0);
  const mjtByte visible_groups[mjNGROUP] = {1, 1, 1, 0, 0, 0};
  int geom = -1;
  mj_ray(&model, &data, X_WC.translation().data(), ray.data(), visible_groups, 1, -1, &geom);
  return geom;
}

TEST(AgainstMjRay, EveryPixelOfTheRoomShowsTheGeomThatARayHits) {
  WorldSpec spec;
  spec.models_dir = std::string(DODGESIM_SOURCE_DIR) + "/models";
  spec.objects.resize(2);
  World world(spec);
  world.reset({0, 0, 2}, 0, {0, 0, 0});
  BodyState ball;
  ball.p_W = {2.0, 0.3, 2.2};
  world.launch(0, ball);
  ball.p_W = {5.0, 1.4, 0.7};  // behind the shelf's boards
  world.launch(1, ball);
  // Each geom gets a luminance of its own; ambient light only.
  const MjModelPtr model(mj_copyModel(nullptr, &world.model()));
  for (int g = 0; g < model->ngeom; ++g) {
    model->geom_matid[g] = -1;
    for (int k = 0; k < 3; ++k) model->geom_rgba[4 * g + k] = 0.01f * static_cast<float>(g + 1);
    model->geom_rgba[4 * g + 3] = 1.0f;
  }
  for (int i = 0; i < model->nlight; ++i) model->light_active[i] = 0;
  model->vis.headlight.active = 1;
  for (float& value : model->vis.headlight.ambient) value = 1.0f;

  const Intrinsics camera;
  const std::vector<int> bodies = {world.object_body(0), world.object_body(1)};
  LuminanceRenderer renderer(*model, bodies, camera, {});
  Image image(camera);
  const Eigen::Isometry3d views[] = {
      world.snapshot().vehicle.pose() * world.vehicle().X_BC[0],
      look_at({-1, -2, 2}, {1.5, 3.6, 1}), look_at({0, 2, 2}, {0.4, -3.6, 0.5}),
      look_at({3, 0, 1}, {6, 2, 0.8}), look_at({1, 0, 2}, {-6, 0, 1})};
  for (const Eigen::Isometry3d& X_WC : views) {
    renderer.render(world.snapshot(), X_WC, {0, 0, camera.width, camera.height},
                    image.luminance.data(), image.id.data());
    int checked = 0, wrong_id = 0, wrong_value = 0;
    for (int y = 1; y < camera.height; y += 3) {
      for (int x = 1; x < camera.width; x += 3) {
        const auto geom_at = [&](double dx, double dy) {
          return ray_geom(*model, world.data(), X_WC, camera, x + dx, y + dy);
        };
        const int geom = geom_at(0, 0);
        int id = geom < 0 ? -1 : 0;
        for (std::size_t i = 0; i < bodies.size() && geom >= 0; ++i) {
          if (model->geom_bodyid[geom] == bodies[i]) id = static_cast<int>(i) + 1;
        }
        wrong_id += image.id_at(x, y) != id;
        // Luminance where the whole pixel, and a little around it, is one geom.
        const double r = 0.8;
        if (geom_at(-r, -r) != geom || geom_at(r, -r) != geom || geom_at(-r, r) != geom ||
            geom_at(r, r) != geom) {
          continue;
        }
        ++checked;
        wrong_value += std::abs(image.at(x, y) - 0.01 * (geom + 1)) > 1e-4;
      }
    }
    EXPECT_EQ(wrong_id, 0);
    EXPECT_GT(checked, 7000);
    // At a face less than a pixel wide, edge smoothing takes what lies beyond the face.
    EXPECT_LE(wrong_value, checked / 500);
  }
}

// Linear grey image of MuJoCo's own renderer, from the model's camera "eye".
std::vector<double> mujoco_image(const mjModel& model, const Intrinsics& camera) {
  OsmesaContext context(GlProfile::kCompatibility, camera.width, camera.height);
  const MjDataPtr data(mj_makeData(&model));
  mj_forward(&model, data.get());
  mjvScene scene;
  mjv_defaultScene(&scene);
  mjv_makeScene(&model, &scene, 1000);
  mjrContext mujoco;
  mjr_defaultContext(&mujoco);
  mjr_makeContext(&model, &mujoco, mjFONTSCALE_100);
  mjr_setBuffer(mjFB_WINDOW, &mujoco);
  mjvOption option;
  mjv_defaultOption(&option);
  mjvCamera view;
  mjv_defaultCamera(&view);
  view.type = mjCAMERA_FIXED;
  view.fixedcamid = mj_name2id(&model, mjOBJ_CAMERA, "eye");
  mjv_updateScene(&model, data.get(), &option, nullptr, &view, mjCAT_ALL, &scene);
  for (const int effect : {mjRND_SHADOW, mjRND_REFLECTION, mjRND_HAZE}) scene.flags[effect] = 0;
  const mjrRect viewport{0, 0, camera.width, camera.height};
  mjr_render(viewport, &scene, &mujoco);
  std::vector<unsigned char> rgb(static_cast<std::size_t>(3 * camera.width * camera.height));
  mjr_readPixels(rgb.data(), nullptr, viewport, &mujoco);
  mjr_freeContext(&mujoco);
  mjv_freeScene(&scene);
  std::vector<double> grey;
  for (int y = camera.height - 1; y >= 0; --y) {
    for (int x = 0; x < camera.width; ++x) {
      const unsigned char* p = rgb.data() + 3 * (y * camera.width + x);
      grey.push_back((0.2126 * p[0] + 0.7152 * p[1] + 0.0722 * p[2]) / 255);
    }
  }
  return grey;
}

// Without any symmetry: brightness grows along rows and columns, from face to face, and a dark bar
// lies near one corner.
void paint(mjModel& model, int texture) {
  const int width = model.tex_width[texture], height = model.tex_height[texture];
  const int face_height = model.tex_type[texture] == mjTEXTURE_2D ? height : width;
  for (int row = 0; row < height; ++row) {
    for (int column = 0; column < width; ++column) {
      const int face = row / face_height;
      const double u = static_cast<double>(column) / width;
      const double v = static_cast<double>(row % face_height) / face_height;
      const bool bar = u > 0.1 && u < 0.4 && v > 0.1 && v < 0.2;
      const double value = bar ? 20 : 60 + 20 * face + 60 * u + 30 * v;
      mjtByte* texel = model.tex_rgb + model.tex_adr[texture] + 3 * (row * width + column);
      for (int k = 0; k < 3; ++k) texel[k] = static_cast<mjtByte>(value);
    }
  }
}

class AgainstMjrRender : public ::testing::TestWithParam<const char*> {};

TEST_P(AgainstMjrRender, TexturesLieTheSameWay) {
  const Intrinsics camera;
  const double fovy = 2 * std::atan(0.5 * camera.height / camera.f) * 180 / mjPI;
  // Six different sides; a 2-D texture without symmetry.
  const std::string content =
      "<visual><headlight ambient='.5 .5 .5' diffuse='0 0 0' specular='0 0 0'/>"
      "<map znear='.001' zfar='100'/><quality offsamples='0' numslices='64' "
      "numstacks='64'/></visual>"
      "<statistic extent='10'/><asset><texture name='sky' type='skybox' builtin='gradient' "
      "rgb1='.9 .6 .3' "
      "rgb2='.1 .2 .3' width='64' height='64' mark='cross' markrgb='1 1 1'/>"
      "<texture name='flat' type='2d' builtin='flat' width='128' height='96'/>"
      "<texture name='cube' type='cube' builtin='gradient' rgb1='1 .2 .1' rgb2='.1 .3 .9' "
      "width='64' height='64' mark='edge' markrgb='0 0 0'/>"
      "<texture name='sides' type='cube' builtin='flat' width='64' height='64'/>"
      "<material name='flat' texture='flat' texrepeat='2 3' specular='0'/>"
      "<material name='flat_uniform' texture='flat' texrepeat='.4 .6' texuniform='true' "
      "specular='0'/>"
      "<material name='cube' texture='cube' specular='0'/>"
      "<material name='sides' texture='sides' specular='0'/>"
      "<material name='sides_uniform' texture='sides' texuniform='true' specular='0'/>"
      "<mesh name='wedge' vertex='0 0 0  1.2 0 0  0 1.6 0  0 0 2'/></asset><worldbody>"
      "<light directional='true' dir='.5 .3 -1' diffuse='.4 .4 .4' specular='0 0 0' "
      "castshadow='false'/>"
      "<camera name='eye' pos='0 0 0' xyaxes='0 -1 0 .1 0 1' fovy='" +
      std::to_string(fovy) + "'/>" + GetParam() + "</worldbody>";
  const MjModelPtr model = compile_model("<mujoco>" + content + "</mujoco>", ".", "texture scene");
  for (const char* name : {"flat", "sides"}) {
    paint(*model, mj_name2id(model.get(), mjOBJ_TEXTURE, name));
  }
  std::vector<int> thrown;
  Snapshot snapshot;
  if (const int body = mj_name2id(model.get(), mjOBJ_BODY, "thrown"); body >= 0) {
    thrown.push_back(body);
    BodyState& state = snapshot.objects.emplace_back();
    const mjtNum* q = model->body_quat + 4 * body;
    state.q_W = Eigen::Quaterniond(q[0], q[1], q[2], q[3]);
    state.p_W = Eigen::Map<const Vector3d>(model->body_pos + 3 * body) +
                state.q_W * Eigen::Map<const Vector3d>(model->body_ipos + 3 * body);
    snapshot.launched.push_back(true);
  }
  LuminanceRenderer renderer(*model, thrown, camera, {});
  Image image(camera);
  Eigen::Isometry3d X_WC = Eigen::Isometry3d::Identity();
  const Vector3d up = Vector3d(0.1, 0, 1).normalized(), right(0, -1, 0);
  X_WC.linear() << right, -up, up.cross(right);
  renderer.render(snapshot, X_WC, {0, 0, camera.width, camera.height}, image.luminance.data(),
                  nullptr);
  const std::vector<double> reference = mujoco_image(*model, camera);
  double difference = 0, mean = 0, spread = 0;
  const auto n = static_cast<double>(reference.size());
  for (const double v : reference) mean += v / n;
  for (std::size_t i = 0; i < reference.size(); ++i) {
    difference += std::abs(image.luminance[i] - reference[i]) / n;
    spread += std::abs(reference[i] - mean) / n;
  }
  EXPECT_GT(spread, 0.02);  // something to see
  EXPECT_LT(difference, 0.1 * spread) << "of " << spread;
}

// What is thrown is ray-cast, unless it is a mesh.
#define THROWN(geom) "<body name='thrown' pos='2 0 0' euler='20 30 40'><freejoint/>" geom "</body>"

INSTANTIATE_TEST_SUITE_P(
    Shapes, AgainstMjrRender,
    ::testing::Values(
        "", "<geom type='plane' size='1.5 1 .1' pos='2 .1 0' zaxis='-1 .2 .3' material='flat'/>",
        "<geom type='plane' size='1.5 1 .1' pos='2 .1 0' zaxis='-1 .2 .3' "
        "material='flat_uniform'/>",
        "<geom type='plane' size='1.5 1 .1' pos='2 .1 0' zaxis='-1 .2 .3' material='sides'/>",
        "<geom type='plane' size='1.5 .7 .1' pos='2 .1 0' zaxis='-1 .2 .3' "
        "material='sides_uniform'/>",
        "<geom type='plane' size='0 0 .1' pos='0 0 -1' material='flat'/>",
        "<geom type='plane' size='0 1.5 .1' pos='1 .2 -1' material='flat'/>",
        "<geom type='plane' size='.6 0 .1' pos='2 .1 -1' euler='0 0 20' material='flat'/>",
        "<geom type='box' size='.5 .7 .4' pos='2 0 0' euler='20 30 40' material='sides'/>",
        "<geom type='box' size='.5 .7 .4' pos='2 0 0' euler='20 30 220' material='sides_uniform'/>",
        "<geom type='box' size='.5 .7 .4' pos='2 0 0' euler='120 30 40' material='cube'/>",
        "<geom type='box' size='.5 .7 .4' pos='2 0 0' euler='20 60 40' material='flat'/>",
        "<geom type='sphere' size='.7' pos='2 0 0' euler='20 30 40' material='sides'/>",
        "<geom type='ellipsoid' size='.7 .4 .6' pos='2 0 0' euler='20 30 40' material='flat'/>",
        "<geom type='cylinder' size='.5 .6' pos='2 0 0' euler='60 30 40' material='sides'/>",
        "<geom type='cylinder' size='.5 .6' pos='2 0 0' euler='60 30 40' material='flat'/>",
        "<geom type='mesh' mesh='wedge' pos='2 0 0' euler='60 30 200' material='sides'/>",
        "<geom type='mesh' mesh='wedge' pos='2 0 0' euler='60 30 200' material='flat'/>",
        THROWN("<geom type='ellipsoid' size='.7 .4 .6' material='sides'/>"),
        THROWN("<geom type='box' size='.5 .7 .4' material='sides'/>"),
        THROWN("<geom type='box' size='.5 .7 .4' euler='100 60 0' material='flat_uniform'/>"),
        THROWN("<geom type='cylinder' size='.5 .6' euler='40 0 0' material='sides_uniform'/>"),
        THROWN("<geom type='cylinder' size='.5 .6' euler='-60 0 0' material='flat'/>"),
        THROWN("<geom type='capsule' size='.4 .4' euler='40 0 0' material='sides'/>"),
        THROWN("<geom type='mesh' mesh='wedge' euler='40 0 170' material='sides'/>")));

#undef THROWN

}  // namespace
}  // namespace dodgesim

#include "sim/render/scene_pictures.h"

#include <algorithm>
#include <string>

#include "sim/base/error.h"
#include "sim/world/compose.h"
#include "sim/world/mujoco_eigen.h"

namespace dodgesim {

namespace {

constexpr int kMaxGeoms = 2000 + ScenePictures::kMaxDots;

mjrRect checked_viewport(int width, int height) {
  if (width < 1 || width > ScenePictures::kMaxWidth || height < 1 ||
      height > ScenePictures::kMaxHeight) {
    throw ScenarioError("A picture of " + std::to_string(width) + " x " + std::to_string(height) +
                        " px was asked for; it must measure 1 x 1 to " +
                        std::to_string(ScenePictures::kMaxWidth) + " x " +
                        std::to_string(ScenePictures::kMaxHeight) + " px.");
  }
  return {0, 0, width, height};
}

void add_dot(const PictureDot& dot, mjvScene& scene) {
  if (scene.ngeom >= scene.maxgeom) return;
  const mjtNum size[3] = {dot.radius_m, dot.radius_m, dot.radius_m};
  mjvGeom* geom = scene.geoms + scene.ngeom++;
  mjv_initGeom(geom, mjGEOM_SPHERE, size, dot.p_W.data(), nullptr, dot.rgba.data());
  geom->category = mjCAT_DECOR;
}

}  // namespace

ScenePictures::ScenePictures(const mjModel& model, int vehicle_body,
                             const std::vector<int>& object_bodies, int width, int height)
    : model_(model),
      vehicle_body_(vehicle_body),
      object_bodies_(object_bodies),
      viewport_(checked_viewport(width, height)),
      context_(GlProfile::kCompatibility, width, height),
      data_(mj_makeData(&model)),
      bottom_up_(3 * static_cast<std::size_t>(width) * static_cast<std::size_t>(height)) {
  mjv_defaultScene(&scene_);
  mjv_makeScene(&model, &scene_, kMaxGeoms);
  mjr_defaultContext(&mujoco_context_);
  mjr_makeContext(&model, &mujoco_context_, mjFONTSCALE_100);
  mjr_setBuffer(mjFB_WINDOW, &mujoco_context_);
  mjv_defaultOption(&option_);
  option_.geomgroup[kVehicleGroup] = 1;
  std::fill(std::begin(option_.sitegroup), std::end(option_.sitegroup), mjtByte{0});
}

ScenePictures::ScenePictures(const World& world, int width, int height)
    : ScenePictures(world.model(), world.vehicle_body(), world.object_bodies(), width, height) {}

ScenePictures::~ScenePictures() {
  context_.make_current();
  mjr_freeContext(&mujoco_context_);
  mjv_freeScene(&scene_);
}

void ScenePictures::place(int body, const BodyState& state) {
  mjtNum* q = data_->qpos + model_.jnt_qposadr[model_.body_jntadr[body]];
  // MuJoCo's frame has its origin at the body, the state's at the centre of mass.
  const ConstMap3 center(model_.body_ipos + 3 * body);
  const Eigen::Vector3d p_W = state.p_W - state.q_W * center;
  std::copy_n(p_W.data(), 3, q);
  set_quaternion(q + 3, state.q_W);
}

// Out of sight of the far clipping plane.
void ScenePictures::hide(int body) {
  constexpr double kFarAwayM = 1e4;
  BodyState state;
  state.p_W = {0, 0, -kFarAwayM};
  place(body, state);
}

void ScenePictures::draw(const Snapshot& snapshot, const PictureView& view,
                         const std::vector<PictureDot>& dots, std::uint8_t* rgb) {
  if (vehicle_body_ >= 0) place(vehicle_body_, snapshot.vehicle);
  for (std::size_t i = 0; i < object_bodies_.size(); ++i) {
    if (snapshot.launched[i]) {
      place(object_bodies_[i], snapshot.objects[i]);
    } else {
      hide(object_bodies_[i]);
    }
  }
  mj_kinematics(&model_, data_.get());
  mj_comPos(&model_, data_.get());
  mj_camlight(&model_, data_.get());

  mjvCamera camera;
  mjv_defaultCamera(&camera);
  std::copy_n(view.look_at_W.data(), 3, camera.lookat);
  camera.distance = view.distance_m;
  camera.azimuth = view.azimuth_deg;
  camera.elevation = view.elevation_deg;
  context_.make_current();
  mjv_updateScene(&model_, data_.get(), &option_, nullptr, &camera, mjCAT_ALL, &scene_);
  const std::size_t shown = std::min<std::size_t>(dots.size(), kMaxDots);
  for (std::size_t i = 0; i < shown; ++i) add_dot(dots[i], scene_);
  mjr_render(viewport_, &scene_, &mujoco_context_);
  mjr_readPixels(bottom_up_.data(), nullptr, viewport_, &mujoco_context_);

  const std::size_t row = 3 * static_cast<std::size_t>(viewport_.width);
  for (int y = 0; y < viewport_.height; ++y) {
    const auto from = static_cast<std::size_t>(viewport_.height - 1 - y);
    std::copy_n(bottom_up_.data() + from * row, row, rgb + static_cast<std::size_t>(y) * row);
  }
}

}  // namespace dodgesim

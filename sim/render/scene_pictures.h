// Pictures of a scene for people: 8-bit colour, from outside, by MuJoCo's own renderer. Slow (tens
// of milliseconds); nothing in the loop reads them.
#pragma once

#include <mujoco/mujoco.h>

#include <Eigen/Dense>
#include <cstdint>
#include <vector>

#include "sim/base/mujoco.h"
#include "sim/render/osmesa_context.h"
#include "sim/world/snapshot.h"
#include "sim/world/world.h"

namespace dodgesim {

// Camera that looks at a point from outside.
struct PictureView {
  Eigen::Vector3d look_at_W = Eigen::Vector3d::Zero();  // [m]
  double distance_m = 4.0;
  double azimuth_deg = 0.0;      // heading of the line of sight about z: 0 looks along +x
  double elevation_deg = -20.0;  // of the line of sight: negative looks down
};

// A dot drawn into a picture, e.g. of a trajectory.
struct PictureDot {
  Eigen::Vector3d p_W;
  double radius_m = 0.01;
  Eigen::Vector4f rgba = {1, 0, 0, 1};
};

class ScenePictures {
 public:
  static constexpr int kMaxWidth = 1280, kMaxHeight = 720, kMaxDots = 5000;

  // Bodies with a free joint that Snapshot moves: the vehicle (-1: none) and the thrown objects.
  // The model must outlive this object. Throws ScenarioError for a size out of 1 to the maximum,
  // SimulationError when OpenGL fails.
  ScenePictures(const mjModel& model, int vehicle_body, const std::vector<int>& object_bodies,
                int width, int height);
  ScenePictures(const World& world, int width, int height);
  ~ScenePictures();
  ScenePictures(const ScenePictures&) = delete;
  ScenePictures& operator=(const ScenePictures&) = delete;

  int width() const { return viewport_.width; }
  int height() const { return viewport_.height; }

  // RGB, 3 * width * height bytes, row-major from the top. Objects not launched are hidden; the
  // vehicle is shown. At most kMaxDots dots are drawn.
  void draw(const Snapshot& snapshot, const PictureView& view, const std::vector<PictureDot>& dots,
            std::uint8_t* rgb);

 private:
  void place(int body, const BodyState& state);
  void hide(int body);

  const mjModel& model_;
  int vehicle_body_;
  std::vector<int> object_bodies_;
  mjrRect viewport_;
  OsmesaContext context_;
  MjDataPtr data_;
  mjvScene scene_;
  mjrContext mujoco_context_;
  mjvOption option_;
  std::vector<std::uint8_t> bottom_up_;
};

}  // namespace dodgesim

// Small scenes for the tests of the renderer, and independent references computed on the CPU.
#pragma once

#include <Eigen/Dense>
#include <cstdint>
#include <cstring>
#include <memory>
#include <string>
#include <vector>

#include "sim/base/mujoco.h"
#include "sim/camera/looking_forward.h"
#include "sim/render/luminance_renderer.h"

namespace dodgesim {

struct Image {
  Intrinsics camera;
  std::vector<float> luminance;
  std::vector<std::int32_t> id;

  explicit Image(const Intrinsics& intrinsics, float fill = 0.0f)
      : camera(intrinsics),
        luminance(static_cast<std::size_t>(camera.width) * static_cast<std::size_t>(camera.height),
                  fill),
        id(luminance.size(), -7) {}
  std::size_t index(int x, int y) const { return static_cast<std::size_t>(y * camera.width + x); }
  double at(int x, int y) const { return luminance[index(x, y)]; }
  int id_at(int x, int y) const { return id[index(x, y)]; }
};

inline constexpr const char* kWhiteLight =
    "<visual><headlight ambient='1 1 1' diffuse='0 0 0' specular='0 0 0'/></visual>";
inline constexpr const char* kNoHeadlight = "<visual><headlight active='0'/></visual>";

// An MJCF text whose bodies named object0, object1, ... are the thrown objects.
class Scene {
 public:
  explicit Scene(const std::string& content, const RenderSpec& spec = {},
                 const Intrinsics& camera = {})
      : camera_(camera),
        model_(compile_model("<mujoco>" + content + "</mujoco>", ".", "test scene")) {
    int body;
    while ((body = mj_name2id(model_.get(), mjOBJ_BODY,
                              ("object" + std::to_string(bodies_.size())).c_str())) >= 0) {
      bodies_.push_back(body);
      snapshot_.objects.emplace_back();
      snapshot_.launched.push_back(true);
    }
    renderer_ = std::make_unique<LuminanceRenderer>(*model_, bodies_, camera_, spec);
  }

  Snapshot& snapshot() { return snapshot_; }
  const mjModel& model() const { return *model_; }
  const Intrinsics& camera() const { return camera_; }

  Image render(const Eigen::Isometry3d& X_WC) { return render(X_WC, full()); }
  Image render(const Eigen::Isometry3d& X_WC, const Rect& region) {
    Image image(camera_, -1.0f);
    renderer_->render(snapshot_, X_WC, region, image.luminance.data(), image.id.data());
    return image;
  }
  void render_without_ids(const Eigen::Isometry3d& X_WC, Image& image) {
    renderer_->render(snapshot_, X_WC, full(), image.luminance.data(), nullptr);
  }
  // The static scene alone, and 1/z_C.
  Image render_static(const Eigen::Isometry3d& X_WC, std::vector<float>& inverse_depth) {
    return render_static(X_WC, camera_, inverse_depth);
  }
  Image render_static(const Eigen::Isometry3d& X_WC, const Intrinsics& camera,
                      std::vector<float>& inverse_depth) {
    Image image(camera, -1.0f);
    inverse_depth.assign(image.luminance.size(), -1.0f);
    renderer_->render_static(camera, X_WC, 0, image.luminance.data(), inverse_depth.data());
    return image;
  }
  // The objects over the picture of the static scene.
  Image draw_objects(const Eigen::Isometry3d& X_WC, const Rect& region, bool behind_static) {
    std::vector<float> inverse_depth;
    Image image = render_static(X_WC, inverse_depth);
    draw_objects(X_WC, region, behind_static, image, image.id.data());
    return image;
  }
  void draw_objects(const Eigen::Isometry3d& X_WC, const Rect& region, bool behind_static,
                    Image& image, std::int32_t* object_id) {
    renderer_->draw_objects(snapshot_, X_WC, region, behind_static, image.luminance.data(),
                            object_id);
  }
  Rect full() const { return {0, 0, camera_.width, camera_.height}; }

 private:
  Intrinsics camera_;
  MjModelPtr model_;
  std::vector<int> bodies_;
  Snapshot snapshot_;
  std::unique_ptr<LuminanceRenderer> renderer_;
};

inline std::string thrown(int index, const std::string& geom) {
  return "<body name='object" + std::to_string(index) + "'><freejoint/>" +
         "<inertial pos='0 0 0' mass='1' diaginertia='1e-3 1e-3 1e-3'/>" + geom + "</body>";
}

// Camera at p_W that looks along +x of W with z of W up.
inline Eigen::Isometry3d forward_camera(const Eigen::Vector3d& p_W = Eigen::Vector3d::Zero()) {
  Eigen::Isometry3d X_WC = Eigen::Isometry3d::Identity();
  X_WC.linear() = looking_forward();
  X_WC.translation() = p_W;
  return X_WC;
}

// Part of a pixel's square for which `inside(x, y)` holds, with n x n samples.
template <class Inside>
double sampled_coverage(int x, int y, int n, const Inside& inside) {
  int count = 0;
  for (int j = 0; j < n; ++j) {
    for (int i = 0; i < n; ++i) {
      count += inside(x + (i + 0.5) / n - 0.5, y + (j + 0.5) / n - 0.5) ? 1 : 0;
    }
  }
  return static_cast<double>(count) / (n * n);
}

}  // namespace dodgesim

#include <memory>

#include "sim/base/wall_clock.h"
#include "sim/bench/bench_case.h"
#include "sim/render/key_picture.h"
#include "sim/render/luminance_renderer.h"
#include "sim/world/world.h"

namespace dodgesim {

namespace {

constexpr int kPictures = 50;  // a run, of each size
constexpr double kSwingRad = 0.05;
const Eigen::Vector3d kVehicle_W(-2, 0, 2);
constexpr double kFarM = 1.5, kNearM = 0.4;  // of the ball from the vehicle

// The room as the first camera sees it from where the demo hovers, a ball in the middle.
class View {
 public:
  explicit View(const std::string& models_dir)
      : world_({models_dir, "room", "qav_rxl", {{"ball", 0.2}}}),
        renderer_(world_, intrinsics_, RenderSpec{}),
        luminance_(static_cast<std::size_t>(intrinsics_.width) *
                   static_cast<std::size_t>(intrinsics_.height)) {
    world_.reset(kVehicle_W, 0, Eigen::Vector3d::Zero());
    place_ball(kFarM);
    const Intrinsics& key = key_.intrinsics();
    key_luminance_.resize(static_cast<std::size_t>(key.width) *
                          static_cast<std::size_t>(key.height));
    key_inverse_depth_.resize(key_luminance_.size());
    draw_keys();
    draw_ball(whole());
  }

  const Intrinsics& intrinsics() const { return intrinsics_; }
  Rect whole() const { return {0, 0, intrinsics_.width, intrinsics_.height}; }

  void place_ball(double distance_m) {
    BodyState ball;
    ball.p_W = kVehicle_W + distance_m * Eigen::Vector3d::UnitX();
    world_.launch(0, ball);
  }

  // ms per key: the room is drawn, finer and wider than the view.
  double draw_keys() {
    return run([this](const Eigen::Isometry3d& X_WC) { draw_key(X_WC); });
  }

  // ms per region of a picture that is shown from a key.
  double show(const Rect& region) {
    draw_key(camera(0));
    return run([&](const Eigen::Isometry3d& X_WC) { key_.show(X_WC, region, luminance_.data()); });
  }

  // ms per region with a ball that is drawn over it.
  double draw_ball(const Rect& region) {
    return run([&](const Eigen::Isometry3d& X_WC) {
      renderer_.draw_objects(world_.snapshot(), X_WC, region, false, luminance_.data(), nullptr);
    });
  }

 private:
  // Each picture from another direction.
  template <class Task>
  double run(const Task& task) {
    const auto start = WallClock::now();
    for (int i = 0; i < kPictures; ++i) {
      task(camera(kSwingRad * (2.0 * i / (kPictures - 1) - 1)));
    }
    return 1e3 * seconds_since(start) / kPictures;
  }

  Eigen::Isometry3d camera(double yaw_rad) const {
    return world_.snapshot().vehicle.pose() * Eigen::AngleAxisd(yaw_rad, Eigen::Vector3d::UnitZ()) *
           world_.vehicle().X_BC.front();
  }

  void draw_key(const Eigen::Isometry3d& X_WC) {
    renderer_.render_static(key_.intrinsics(), X_WC, key_.lod_bias(), key_luminance_.data(),
                            key_inverse_depth_.data());
    key_.set(X_WC, key_luminance_, key_inverse_depth_);
  }

  Intrinsics intrinsics_;
  World world_;
  LuminanceRenderer renderer_;
  KeyPicture key_{intrinsics_, KeySpec{}};
  std::vector<float> luminance_;
  std::vector<float> key_luminance_, key_inverse_depth_;
};

}  // namespace

std::vector<BenchCase> renderer_cases() {
  const std::vector<int> sides = {16, 40, 80, 160};
  BenchCase bench;
  bench.quantities = {
      {"renderer.key", "ms", "the furnished room is drawn as sensors.keys says by default"},
      {"renderer.whole", "ms", "a picture of 320 x 240 px is shown from a key"}};
  for (const int side : sides) {
    const std::string size = std::to_string(side);
    bench.quantities.push_back(
        {"renderer.region" + size, "ms", "its middle " + size + " x " + size + " px, with a ball"});
  }
  bench.quantities.push_back(
      {"renderer.near_ball", "ms",
       "a ball of 20 cm is drawn over the whole picture, 0.4 m from the vehicle instead of 1.5 m"});
  bench.prepare = [sides](const BenchOptions& options) -> BenchRun {
    auto view = std::make_shared<View>(options.models_dir);
    return [view, sides] {
      const int width = view->intrinsics().width;
      const int height = view->intrinsics().height;
      std::vector<double> values = {view->draw_keys(), view->show(view->whole())};
      for (const int side : sides) {
        const int x0 = (width - side) / 2;
        const int y0 = (height - side) / 2;
        const Rect region = {x0, y0, x0 + side, y0 + side};
        values.push_back(view->show(region) + view->draw_ball(region));
      }
      view->place_ball(kNearM);
      values.push_back(view->draw_ball(view->whole()));
      view->place_ball(kFarM);
      return values;
    };
  };
  return {bench};
}

}  // namespace dodgesim

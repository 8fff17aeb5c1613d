#include <chrono>
#include <memory>

#include "sim/bench/bench_case.h"
#include "sim/render/luminance_renderer.h"
#include "sim/world/world.h"

namespace dodgesim {

namespace {

constexpr int kPictures = 50;  // a run, of each size
constexpr double kSwingRad = 0.05;
const Eigen::Vector3d kVehicle_W(-2, 0, 2);
const Eigen::Vector3d kBall_W(-0.5, 0, 2);

// The room as the first camera sees it from where the demo hovers, a ball in the middle.
class View {
 public:
  explicit View(const std::string& models_dir)
      : world_({models_dir, "room", "qav_rxl", {{"ball", 0.2}}}),
        renderer_(world_, intrinsics_, RenderSpec{}),
        luminance_(static_cast<std::size_t>(intrinsics_.width) *
                   static_cast<std::size_t>(intrinsics_.height)) {
    world_.reset(kVehicle_W, 0, Eigen::Vector3d::Zero());
    BodyState ball;
    ball.p_W = kBall_W;
    world_.launch(0, ball);
    run({0, 0, intrinsics_.width, intrinsics_.height});
  }

  const Intrinsics& intrinsics() const { return intrinsics_; }

  // ms per picture of the region, each from another direction.
  double run(const Rect& region) {
    const auto start = std::chrono::steady_clock::now();
    for (int i = 0; i < kPictures; ++i) {
      const double yaw_rad = kSwingRad * (2.0 * i / (kPictures - 1) - 1);
      const Eigen::Isometry3d X_WC = world_.snapshot().vehicle.pose() *
                                     Eigen::AngleAxisd(yaw_rad, Eigen::Vector3d::UnitZ()) *
                                     world_.vehicle().X_BC.front();
      renderer_.render(world_.snapshot(), X_WC, region, luminance_.data(), nullptr);
    }
    const std::chrono::duration<double> passed = std::chrono::steady_clock::now() - start;
    return 1e3 * passed.count() / kPictures;
  }

 private:
  Intrinsics intrinsics_;
  World world_;
  LuminanceRenderer renderer_;
  std::vector<float> luminance_;
};

}  // namespace

std::vector<BenchCase> renderer_cases() {
  const std::vector<int> sides = {16, 40, 80, 160};
  BenchCase bench;
  bench.quantities = {{"renderer.whole", "ms", "a picture of the furnished room, 320 x 240 px"}};
  for (const int side : sides) {
    const std::string size = std::to_string(side);
    bench.quantities.push_back(
        {"renderer.region" + size, "ms", "its middle " + size + " x " + size + " px, with a ball"});
  }
  bench.prepare = [sides](const BenchOptions& options) -> BenchRun {
    auto view = std::make_shared<View>(options.models_dir);
    return [view, sides] {
      const int width = view->intrinsics().width;
      const int height = view->intrinsics().height;
      std::vector<double> values = {view->run({0, 0, width, height})};
      for (const int side : sides) {
        const int x0 = (width - side) / 2;
        const int y0 = (height - side) / 2;
        values.push_back(view->run({x0, y0, x0 + side, y0 + side}));
      }
      return values;
    };
  };
  return {bench};
}

}  // namespace dodgesim

#include "dodge/config.h"

#include <cmath>
#include <sstream>
#include <stdexcept>
#include <string>

#include "dodge/check_ranges.h"

namespace dodge {

namespace {

constexpr double kRectifiedTolerance = 1e-3;  // [rad] and relative to the baseline
constexpr double kLeastBaselineM = 1e-3;
constexpr double kRotationTolerance = 1e-3;  // of R^T R; a calibration may be rounded
constexpr double kLongestFocalPx = 1e6;
constexpr double kWidestBearing = 1e3;  // of the axis' unit: 89.9 degrees

[[noreturn]] void fail(const std::string& sentence) { throw std::invalid_argument(sentence); }

void check_odd(const char* name, int size) {
  if (size % 2 == 0) {
    fail(std::string("The parameter ") + name + " is " + std::to_string(size) +
         " but must be odd, so that the kernel has a centre.");
  }
}

struct Parameter {
  const char* name;
  double value;
};

[[noreturn]] void refuse_order(const Parameter& smaller, const char* must_be,
                               const Parameter& larger) {
  std::ostringstream sentence;
  sentence << "The parameter " << smaller.name << " is " << smaller.value << " but must " << must_be
           << " " << larger.name << ", which is " << larger.value << ".";
  fail(sentence.str());
}

void check_less(const Parameter& smaller, const Parameter& larger) {
  if (smaller.value >= larger.value) refuse_order(smaller, "be less than", larger);
}

void check_not_more(const Parameter& smaller, const Parameter& larger) {
  if (smaller.value > larger.value) refuse_order(smaller, "not exceed", larger);
}

// With so large a control error even a hit in the middle is no more probable than `radii` allows; a
// larger min_probability would never be reached.
void check_escape(const EscapeConfig& config, double max_size_m) {
  check_not_more({"escape.keep_probability", config.keep_probability},
                 {"escape.min_probability", config.min_probability});
  const double radii = (config.hull_radius_m + 0.5 * max_size_m) / config.control_sigma_m;
  const double most = 1 - std::exp(-0.5 * radii * radii);
  if (config.law == "potential_field" || config.min_probability < most) return;
  std::ostringstream sentence;
  sentence << "The parameter escape.min_probability is " << config.min_probability
           << " but must be less than " << most
           << ": with escape.control_sigma_m no hit of anything up to position.max_size_m is more "
              "probable.";
  fail(sentence.str());
}

// Who brakes less than this flies on after an escape as if it never ended.
void check_calm(const VelocityLimitConfig& config) {
  constexpr double kLeastMps2 = 0.1;
  const double calm_mps2 = config.calm_acceleration_mps2;
  if (calm_mps2 == 0 || calm_mps2 >= kLeastMps2) return;
  std::ostringstream sentence;
  sentence << "The parameter velocity_limit.calm_acceleration_mps2 is " << calm_mps2
           << " but must be 0 (at once) or at least " << kLeastMps2 << ".";
  fail(sentence.str());
}

void check_repulsive(const RepulsiveConfig& config) {
  if (config.field != "khosla" || config.gamma >= 1) return;
  std::ostringstream sentence;
  sentence
      << "The parameter repulsive.gamma is " << config.gamma
      << " but must be at least 1 for the khosla field; below, its force is infinite at eta_0.";
  fail(sentence.str());
}

bool is_rotation(const Eigen::Matrix3d& R) {
  return (R.transpose() * R - Eigen::Matrix3d::Identity()).norm() <= kRotationTolerance &&
         R.determinant() > 0;
}

void check_camera(const CameraModel& camera, const std::string& name) {
  const Eigen::Array<double, 9, 1> intrinsics{camera.fx, camera.fy, camera.cx, camera.cy, camera.k1,
                                              camera.k2, camera.p1, camera.p2, camera.k3};
  if (!intrinsics.allFinite() || !camera.X_BC.matrix().allFinite()) {
    fail(name + " has a calibration with values that are not finite.");
  }
  if (camera.width < 1 || camera.height < 1 || camera.fx <= 0 || camera.fy <= 0) {
    fail(name + " must have a positive size and positive focal lengths.");
  }
  if (camera.fx > kLongestFocalPx || camera.fy > kLongestFocalPx) {
    fail(name + " has a focal length of more than a million pixels.");
  }
  if (camera.lens &&
      !(camera.lens->fx > 0 && camera.lens->fy > 0 &&
        std::isfinite(camera.lens->fx * camera.lens->cx) &&
        std::isfinite(camera.lens->fy * camera.lens->cy) && is_rotation(camera.lens->R_CL))) {
    fail(name + " has a lens without a positive focal length, or that is turned by no rotation.");
  }
  if (!is_rotation(camera.X_BC.linear())) {
    fail(name + " has a pose X_BC whose linear part is no rotation: it scales, shears or mirrors.");
  }
  for (int y = 0; y < camera.height; ++y) {
    for (int x = 0; x < camera.width; ++x) {
      const double off_axis = camera.bearing({x, y}).norm();
      if (off_axis <= kWidestBearing) continue;
      const std::string pixel = "pixel (" + std::to_string(x) + ", " + std::to_string(y) + ")";
      if (off_axis > kWidestBearing) {
        fail(name + " would look at right angles to its axis at " + pixel + ".");
      }
      fail(name + " has a distortion that has no inverse at " + pixel +
           ": no line of sight is seen there.");
    }
  }
}

// Stereo takes the disparity along the image's columns: same size, same intrinsics, same
// orientation, the second camera straight below the first.
void check_rectified(const CameraModel& top, const CameraModel& bottom) {
  if (top.width != bottom.width || top.height != bottom.height) {
    fail("Stereo needs two cameras of the same image size, but the first has " +
         std::to_string(top.width) + " x " + std::to_string(top.height) +
         " pixels and the second " + std::to_string(bottom.width) + " x " +
         std::to_string(bottom.height) + ".");
  }
  if (top.fx != bottom.fx || top.fy != bottom.fy || top.cx != bottom.cx || top.cy != bottom.cy) {
    fail("Stereo needs two cameras of the same intrinsics (rectified).");
  }
  const Eigen::Isometry3d X_TopBottom = top.X_BC.inverse() * bottom.X_BC;
  const Eigen::Vector3d baseline = X_TopBottom.translation();
  const double turn = Eigen::AngleAxisd(X_TopBottom.linear()).angle();
  if (!(std::abs(turn) <= kRectifiedTolerance)) {
    fail("Stereo needs two cameras of the same orientation (rectified).");
  }
  if (!(baseline.y() > 0) ||
      !(std::hypot(baseline.x(), baseline.z()) <= kRectifiedTolerance * baseline.norm())) {
    fail("Stereo needs the second camera straight below the first, along the images' columns.");
  }
  if (!(baseline.y() >= kLeastBaselineM)) {
    std::ostringstream sentence;
    sentence << "Stereo needs two cameras at least " << kLeastBaselineM << " m apart, but they are "
             << baseline.y() << " m apart.";
    fail(sentence.str());
  }
}

}  // namespace

void validate(const Config& config) {
  check_ranges(config);
  check_odd("time_image.blur_px", config.time_image.blur_px);
  check_odd("flow.window_px", config.flow.window_px);
  check_less({"position.min_range_m", config.position.min_range_m},
             {"position.max_range_m", config.position.max_range_m});
  check_less({"position.min_size_m", config.position.min_size_m},
             {"position.max_size_m", config.position.max_size_m});
  if (!config.position.stereo_depth()) {  // a cluster's size is taken to be the known one
    check_less({"position.min_size_m", config.position.min_size_m},
               {"position.known_size_m", config.position.known_size_m});
    check_less({"position.known_size_m", config.position.known_size_m},
               {"position.max_size_m", config.position.max_size_m});
  }
  check_not_more({"cluster.min_points", 1.0 * config.cluster.min_points},
                 {"cluster.max_groups", 1.0 * config.cluster.max_groups});
  check_less({"range_sensor.min_range_m", config.range_sensor.min_range_m},
             {"range_sensor.max_range_m", config.range_sensor.max_range_m});
  check_repulsive(config.repulsive);
  check_escape(config.escape, config.position.max_size_m);
  if (config.escape.law != "potential_field" && decay_lifetime_s(config.repulsive) <= 0) {
    // By any law an obstacle is remembered until its repulsive constant has decayed.
    refuse_order({"repulsive.k_r0", config.repulsive.k_r0}, "exceed",
                 {"repulsive.k_tau", config.repulsive.k_tau});
  }
  check_calm(config.velocity_limit);
  check_less({"velocity_limit.evading_threshold_mps", config.velocity_limit.evading_threshold_mps},
             {"velocity_limit.max_speed_mps", config.velocity_limit.max_speed_mps});
  check_not_more({"landing.touchdown_mps", config.landing.touchdown_mps},
                 {"landing.descent_mps", config.landing.descent_mps});

  if (!config.p_BR.allFinite()) fail("The range sensor's place p_BR is not finite.");
  const std::size_t needed = config.position.cameras();
  if (config.cameras.size() < needed) {
    std::string sentence = "Depth by " + config.position.depth + " needs " +
                           std::to_string(needed) + " camera(s), but the configuration has " +
                           std::to_string(config.cameras.size()) + ".";
    if (!config.cameras.empty()) sentence += " With position.depth: mono one is enough.";
    fail(sentence);
  }
  for (std::size_t i = 0; i < config.cameras.size(); ++i) {
    check_camera(config.cameras[i], "Camera " + std::to_string(i));
  }
  if (config.position.stereo_depth()) check_rectified(config.cameras[0], config.cameras[1]);
}

}  // namespace dodge

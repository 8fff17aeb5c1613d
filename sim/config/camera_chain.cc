#include "sim/config/camera_chain.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "sim/base/numbers.h"
#include "sim/camera/looking_forward.h"

namespace dodgesim {

namespace {

using Kind = YamlNode::Kind;

constexpr double kMostOfChain = 1e4;  // pixels, metres

struct ChainKeys {
  std::string camera_model = "pinhole", distortion_model;
  std::vector<double> intrinsics, distortion_coeffs, resolution;
  double timeshift_cam_imu = 0;

  template <class Visitor>
  void visit(Visitor& v) {
    v("camera_model", camera_model, {"pinhole"}, "");
    v("intrinsics", intrinsics, -kMostOfChain, kMostOfChain, "");
    v("camera_matrix", intrinsics, -kMostOfChain, kMostOfChain, "");
    v("distortion_model", distortion_model, {"radtan", "none"}, "");
    if (distortion_model != "none") v("distortion_coeffs", distortion_coeffs, -100, 100, "");
    v("resolution", resolution, 16, 4096, "");
    v("timeshift_cam_imu", timeshift_cam_imu, -10, 10, "");
  }
};

// The map whose values are cameras.
const YamlNode& cameras(const YamlNode& root) {
  const YamlNode* intrinsics = root.find("intrinsics");
  const bool is_dsec = intrinsics != nullptr && intrinsics->find("cam0") != nullptr;
  return is_dsec ? *intrinsics : root;
}

// cam0, cam1, or camRect0 of DSEC's.
bool is_camera_name(const std::string& name) {
  if (!name.starts_with("cam")) return false;
  const std::string number = name.substr(name.starts_with("camRect") ? 7 : 3);
  return !number.empty() && number.find_first_not_of("0123456789") == std::string::npos;
}

// Four rows of four numbers, of which the first three are a rotation and a translation.
std::optional<Eigen::Isometry3d> transform(const YamlNode& node) {
  constexpr double kRoundingOfText = 1e-4;
  Eigen::Matrix4d T = Eigen::Matrix4d::Zero();
  if (node.items.size() != 4) return std::nullopt;
  for (std::size_t row = 0; row < 4; ++row) {
    if (node.items[row].items.size() != 4) return std::nullopt;
    for (std::size_t column = 0; column < 4; ++column) {
      const std::optional<double> number = as_number(node.items[row].items[column].text);
      if (!number || std::abs(*number) > kMostOfChain) return std::nullopt;
      T(static_cast<int>(row), static_cast<int>(column)) = *number;
    }
  }
  const Eigen::Matrix3d R = T.topLeftCorner<3, 3>();
  if (!(R * R.transpose()).isIdentity(kRoundingOfText) || R.determinant() < 0) return std::nullopt;
  return Eigen::Isometry3d(T);
}

void expect_numbers(const std::string& name, const std::vector<double>& numbers, std::size_t count,
                    const char* meaning, ReadContext& context) {
  if (numbers.size() == count) return;
  context.add_problem(name,
                      name + " must be the " + std::to_string(count) + " numbers " + meaning + ".");
}

void read_lens(const ChainKeys& keys, const std::string& path, ReadContext& context,
               dodge::CameraModel& camera) {
  const bool dsec = context.where.count(path + "camera_matrix") > 0;
  const std::string intrinsics = path + (dsec ? "camera_matrix" : "intrinsics");
  expect_numbers(path + "resolution", keys.resolution, 2, "width and height", context);
  expect_numbers(intrinsics, keys.intrinsics, 4, "fx, fy, cx and cy", context);
  const bool distorted = keys.distortion_model == "radtan" || !keys.distortion_coeffs.empty();
  if (distorted) {
    expect_numbers(path + "distortion_coeffs", keys.distortion_coeffs, 4, "k1, k2, p1 and p2",
                   context);
  }
  context.problems.raise_if_any();
  for (const double side : keys.resolution) {
    if (side == std::floor(side)) continue;
    context.add_problem(path + "resolution", path + "resolution must be whole numbers.");
  }
  if (keys.intrinsics[0] < 1 || keys.intrinsics[1] < 1) {
    context.add_problem(intrinsics,
                        intrinsics + " begins with fx and fy, which must be at least 1.");
  }
  camera.width = static_cast<int>(keys.resolution[0]);
  camera.height = static_cast<int>(keys.resolution[1]);
  camera.fx = keys.intrinsics[0];
  camera.fy = keys.intrinsics[1];
  camera.cx = keys.intrinsics[2];
  camera.cy = keys.intrinsics[3];
  if (!distorted) return;
  camera.k1 = keys.distortion_coeffs[0];
  camera.k2 = keys.distortion_coeffs[1];
  camera.p1 = keys.distortion_coeffs[2];
  camera.p2 = keys.distortion_coeffs[3];
}

// The polynomials of the pilot's lens do not bend as far.
void refuse_fisheye(const YamlNode& camera, const std::string& path, ReadContext& context) {
  const YamlNode* model = camera.find("distortion_model");
  if (model == nullptr || (model->text != "equidistant" && model->text != "fov")) return;
  context.problems.fail(model->at, path + "distortion_model is " + model->text +
                                       ", a fisheye's, which the pilots do not know: undistort "
                                       "the events, or calibrate the camera as radtan.");
}

// A key of our own files.
void refuse_imu_axes(const YamlNode& root, const YamlNode& camera, ReadContext& context) {
  for (const YamlNode* map : {&root, &camera}) {
    for (const YamlNode::Key& key : map->keys) {
      if (key.name != "imu_axes") continue;
      context.problems.fail(key.at,
                            "imu_axes has no effect in a chain: where the IMU's axes point "
                            "is said by T_cam_imu.");
    }
  }
}

std::optional<Eigen::Isometry3d> transform_of(const YamlNode& camera, const char* key,
                                              const std::string& path, ReadContext& context) {
  const YamlNode* const node = camera.find(key);
  if (node == nullptr) return std::nullopt;
  auto X = transform(*node);
  if (!X) {
    context.problems.fail(node->at, path + "." + key + " must be four rows of four numbers, a " +
                                        "rotation and a translation in metres.");
  }
  return X;
}

struct FromImu {
  Eigen::Isometry3d X_CG = Eigen::Isometry3d::Identity();
  bool known = false;  // else G is taken for the frame of a camera of the chain
};

// By T_cam_imu, by its inverse T_imu_cam (of OpenVINS's files), or by T_cn_cnm1 from the camera
// before.
FromImu from_imu(const YamlNode& map, const std::vector<std::string>& names, std::size_t i,
                 const std::string& path, ReadContext& context) {
  const YamlNode& camera = *map.find(names[i]);
  const std::string own = path + names[i];
  if (const auto X = transform_of(camera, "T_cam_imu", own, context)) return {*X, true};
  if (const auto X = transform_of(camera, "T_imu_cam", own, context)) return {X->inverse(), true};
  const auto X = transform_of(camera, "T_cn_cnm1", own, context);
  if (!X || i == 0) return {};
  const FromImu before = from_imu(map, names, i - 1, path, context);
  return {*X * before.X_CG, before.known};
}

}  // namespace

std::vector<std::string> cameras_of_chain(const YamlNode& root) {
  std::vector<std::string> names;
  const YamlNode& map = cameras(root);
  for (std::size_t i = 0; i < map.keys.size(); ++i) {
    const bool is_camera = is_camera_name(map.keys[i].name) && map.items[i].kind == Kind::kMap;
    if (is_camera) names.push_back(map.keys[i].name);
  }
  return names;
}

CameraCalibration read_chain(const YamlNode& root, const std::string& name, ReadContext& context) {
  const YamlNode& map = cameras(root);
  const YamlNode& node = *map.find(name);
  const std::string path = &map == &root ? "" : "intrinsics.";
  refuse_fisheye(node, path + name + ".", context);
  refuse_imu_axes(root, node, context);
  ChainKeys keys;
  Reader reader(node, path + name, context);
  keys.visit(reader);
  CameraCalibration calibration;
  read_lens(keys, path + name + ".", context, calibration.camera);
  calibration.imu_later_us = std::llround(1e6 * keys.timeshift_cam_imu);
  const std::vector<std::string> names = cameras_of_chain(root);
  const auto i = static_cast<std::size_t>(std::ranges::find(names, name) - names.begin());
  const FromImu imu = from_imu(map, names, i, path, context);
  calibration.imu_axes_assumed = !imu.known;
  calibration.R_BG = looking_forward() * imu.X_CG.linear();
  calibration.camera.X_BC.linear() = looking_forward();
  calibration.camera.X_BC.translation() = -(looking_forward() * imu.X_CG.translation());
  return calibration;
}

}  // namespace dodgesim

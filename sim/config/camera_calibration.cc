#include "sim/config/camera_calibration.h"

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <optional>
#include <utility>
#include <vector>

#include "sim/base/body_axes.h"
#include "sim/base/contains.h"
#include "sim/base/error.h"
#include "sim/base/joined.h"
#include "sim/base/numbers.h"
#include "sim/camera/camera.h"
#include "sim/config/camera_chain.h"
#include "sim/config/closest_name.h"
#include "sim/config/reader.h"
#include "sim/config/writer.h"

namespace dodgesim {

namespace {

constexpr double kAssumedFovDeg = 80;       // of the paper's cameras
constexpr double kFar = 1e4;                // of pixels and metres
constexpr double kMostOfRotation = 1.0001;  // rounded
constexpr const char* kDistortion = "radtan_k1_k2_p1_p2_k3";

struct IntrinsicsKeys {
  double fx = 0, fy = 0, cx = 0, cy = 0;

  template <class Visitor>
  void visit(Visitor& v) {
    v("fx", fx, 1, kFar, "");
    v("fy", fy, 1, kFar, "");
    v("cx", cx, -kFar, kFar, "");
    v("cy", cy, -kFar, kFar, "");
  }
};

struct DistortionKeys {
  std::string model = kDistortion;
  std::vector<double> coeffs;

  template <class Visitor>
  void visit(Visitor& v) {
    v("model", model, {kDistortion, "radtan", "none"}, "");
    v("coeffs", coeffs, -100, 100, "");
  }
};

struct CalibrationKeys {
  int width = 0, height = 0;
  std::optional<IntrinsicsKeys> intrinsics;
  std::optional<DistortionKeys> distortion;
  Eigen::Vector3d p_BC_m = Eigen::Vector3d::Zero();
  std::vector<Eigen::Vector3d> R_BC = {{0, 0, 1}, {-1, 0, 0}, {0, -1, 0}};
  std::string imu_axes;
  Eigen::Vector3d p_BR_m = Eigen::Vector3d::Zero();

  template <class Visitor>
  void visit(Visitor& v) {
    v("width", width, 16, 4096, "");
    v("height", height, 16, 4096, "");
    v("intrinsics", intrinsics, "");
    v("distortion", distortion, "");
    v("p_BC_m", p_BC_m, -kFar, kFar, "");
    v("R_BC", R_BC, -kMostOfRotation, kMostOfRotation, "");
    v.text("imu_axes", imu_axes, "");
    v("p_BR_m", p_BR_m, -kFar, kFar, "");
  }
};

// What the calibrators of ROS (camera_info) and OpenCV write, in place of the keys above.
struct CameraInfoKeys {
  struct Matrix {
    int rows = 0, cols = 0;
    std::string dt;  // OpenCV's type of the numbers; all types are read alike
    std::vector<double> data;

    template <class Visitor>
    void visit(Visitor& v) {
      v("rows", rows, 1, 14, "");
      v("cols", cols, 1, 14, "");
      v.text("dt", dt, "");
      v("data", data, -kFar, kFar, "");
    }
  };
  int image_width = 0, image_height = 0;
  Matrix camera_matrix, distortion_coefficients;
  std::string distortion_model = "plumb_bob";

  template <class Visitor>
  void visit(Visitor& v) {
    v("image_width", image_width, 16, 4096, "");
    v("image_height", image_height, 16, 4096, "");
    v("camera_matrix", camera_matrix, "");
    v("distortion_model", distortion_model, {"plumb_bob"}, "");
    v("distortion_coefficients", distortion_coefficients, "");
  }
};

// OpenCV's programs tag their matrices, whose keys are those of ROS.
void drop_tags_of_opencv(YamlNode& map) {
  for (YamlNode& item : map.items) {
    if (item.tag == "!!opencv-matrix") item.tag.clear();
  }
}

// Keys without a value count as not given.
void drop_empty(YamlNode& map) {
  for (std::size_t i = map.keys.size(); i-- > 0;) {
    if (map.items[i].kind == YamlNode::Kind::kNull) map.erase(i);
  }
}

// Calibrators of ROS and OpenCV begin with the size.
const YamlNode::Key* key_of_ros(const YamlNode& root) {
  for (const YamlNode::Key& key : root.keys) {
    if (key.name == "image_width" || key.name == "image_height") return &key;
  }
  return nullptr;
}

// Size and lens are given once.
void expect_one_form(const YamlNode& root, Problems& problems) {
  const YamlNode::Key* of_ros = key_of_ros(root);
  if (of_ros == nullptr) return;
  const std::vector<std::string> names = {"width", "height", "intrinsics", "distortion"};
  for (const YamlNode::Key& key : root.keys) {
    if (!contains(names, key.name)) continue;
    problems.add(key.at, key.name + " and " + of_ros->name +
                             " (ROS's, OpenCV's) are keys of two forms of a calibration: take away "
                             "what belongs to one of them.");
    return;
  }
}

// Where our form has what other calibrations have under a key of that name; empty: nowhere.
std::string place_in_lens(const std::string& key) {
  std::string name;
  for (const char c : key) {
    if (c != '_') name += static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  }
  const std::vector<std::string> intrinsics = {
      "cameramatrix", "intrinsicmatrix", "k", "fx", "fy", "cx", "cy"};
  const std::vector<std::string> distortion = {"distortioncoefficients",
                                               "distortioncoeffs",
                                               "distcoeffs",
                                               "distortionmodel",
                                               "coeffs",
                                               "d",
                                               "k1",
                                               "k2",
                                               "k3",
                                               "k4",
                                               "k5",
                                               "k6",
                                               "p1",
                                               "p2"};
  if (contains(intrinsics, name)) return "intrinsics: {fx: ..., fy: ..., cx: ..., cy: ...}";
  if (contains(distortion, name))
    return "distortion: {model: radtan, coeffs: [k1, k2, p1, p2, k3]}";
  return "";
}

// In place of Reader::finish(): any other key may stand there for people.
void expect_no_misspelling(const YamlNode& root, Problems& problems) {
  const std::vector<std::string> names = {"width",  "height", "intrinsics", "distortion",
                                          "p_BC_m", "R_BC",   "imu_axes",   "p_BR_m"};
  const bool of_ros = key_of_ros(root) != nullptr;
  const std::vector<std::string> ros = {"camera_matrix", "distortion_model",
                                        "distortion_coefficients"};
  const bool of_ours = root.find("width") != nullptr || root.find("height") != nullptr;
  const std::vector<std::string> kalibr = {"camera_model",      "resolution", "distortion_model",
                                           "distortion_coeffs", "T_cam_imu",  "T_imu_cam",
                                           "timeshift_cam_imu"};
  for (const YamlNode::Key& key : root.keys) {
    if (contains(names, key.name)) continue;
    const std::string place = place_in_lens(key.name);
    if (!place.empty() && (of_ros ? !contains(ros, key.name) : of_ours)) {
      problems.add(key.at, key.name + " has no effect here: beside " +
                               (of_ros ? "image_width the lens is camera_matrix and "
                                         "distortion_coefficients, each with data: [...]."
                                       : "width and height it belongs in " + place + "."));
      continue;
    }
    if (!of_ros && contains(kalibr, key.name)) {
      problems.add(key.at, key.name +
                               " is a key of Kalibr's, which must stand below the name of its "
                               "camera, such as cam0.");
      continue;
    }
    const std::string meant = closest_name(key.name, names);
    if (meant.empty()) continue;
    problems.add(key.at, key.name + " is not a known key" + did_you_mean(meant));
  }
}

void expect_given(const std::string& key, ReadContext& context) {
  if (!context.where.contains(key)) context.problems.add({}, key + " is missing.");
}

// The size and the lens of a camera_info, as keys of ours.
void read_camera_info(const YamlNode& root, ReadContext& context, CalibrationKeys& keys) {
  CameraInfoKeys info;
  Reader reader(root, "", context);
  info.visit(reader);
  for (const char* key : {"image_width", "image_height"}) expect_given(key, context);
  keys.width = info.image_width;
  keys.height = info.image_height;
  const std::vector<double>& K = info.camera_matrix.data;
  const bool is_matrix = K.size() == 9 && K[0] >= 1 && K[4] >= 1 && K[1] == 0 && K[3] == 0 &&
                         K[6] == 0 && K[7] == 0 && K[8] == 1;
  if (!is_matrix) {
    context.add_problem("camera_matrix",
                        "camera_matrix.data must be the nine numbers fx, 0, cx, 0, fy, cy, 0, 0 "
                        "and 1.");
    return;
  }
  keys.intrinsics = IntrinsicsKeys{K[0], K[4], K[2], K[5]};
  const YamlNode* fisheye = root.find("fisheye_model");
  if (fisheye != nullptr && fisheye->text != "0") {
    context.problems.add(fisheye->at,
                         "fisheye_model is " + fisheye->text +
                             ", a lens that the pilots do not know: undistort the events, or "
                             "calibrate the camera without it.");
  }
  const std::size_t count = info.distortion_coefficients.data.size();
  if (count == 0) return;
  if (count != 4 && count != 5) {
    context.add_problem("distortion_coefficients",
                        "distortion_coefficients.data must be the four or five numbers k1, k2, p1, "
                        "p2 and k3 (plumb_bob): calibrate without the others.");
    return;
  }
  keys.distortion = DistortionKeys{kDistortion, info.distortion_coefficients.data};
}

std::optional<Eigen::Matrix3d> right_handed_axes(const std::string& words) {
  const std::optional<Eigen::Matrix3d> axes = axes_named(words);
  return axes && axes->determinant() > 0 ? axes : std::nullopt;
}

void read_rotations(const CalibrationKeys& keys, ReadContext& context,
                    CameraCalibration& calibration) {
  constexpr double kRoundingOfText = 1e-4;
  Eigen::Matrix3d R_BC = Eigen::Matrix3d::Zero();
  if (keys.R_BC.size() == 3) R_BC << keys.R_BC[0], keys.R_BC[1], keys.R_BC[2];
  R_BC.transposeInPlace();
  const bool orthonormal = (R_BC * R_BC.transpose()).isIdentity(kRoundingOfText);
  if (!orthonormal || R_BC.determinant() < 0) {
    context.add_problem(
        "R_BC",
        "R_BC must be a rotation: three rows of three numbers, at right angles to each "
        "other, of length 1 and right-handed.");
  }
  calibration.camera.X_BC.linear() = R_BC;
  calibration.camera.X_BC.translation() = keys.p_BC_m;
  calibration.imu_axes_assumed = keys.imu_axes.empty();
  const auto R_BG =
      calibration.imu_axes_assumed ? std::optional(R_BC) : right_handed_axes(keys.imu_axes);
  if (R_BG) {
    calibration.R_BG = *R_BG;
  } else {
    context.add_problem(
        "imu_axes", "imu_axes is " + in_quotes(keys.imu_axes) +
                        ", but must be three of forward, backward, left, right, up and down, that "
                        "make a right-handed frame, such as right down forward.");
  }
}

void read_lens(const CalibrationKeys& keys, ReadContext& context, dodge::CameraModel& camera) {
  camera.width = keys.width;
  camera.height = keys.height;
  if (keys.intrinsics) {
    camera.fx = keys.intrinsics->fx;
    camera.fy = keys.intrinsics->fy;
    camera.cx = keys.intrinsics->cx;
    camera.cy = keys.intrinsics->cy;
  } else {
    camera.fx = camera.fy = focal_length_px(keys.width, kAssumedFovDeg);
    camera.cx = 0.5 * (keys.width - 1);
    camera.cy = 0.5 * (keys.height - 1);
  }
  if (!keys.distortion || keys.distortion->model == "none") return;
  const std::vector<double>& k = keys.distortion->coeffs;
  if (k.size() != 4 && k.size() != 5) {
    context.add_problem(
        "distortion", "distortion.coeffs must be the four or five numbers k1, k2, p1, p2 and k3.");
    return;
  }
  camera.k1 = k[0];
  camera.k2 = k[1];
  camera.p1 = k[2];
  camera.p2 = k[3];
  camera.k3 = k.size() == 5 ? k[4] : 0;
}

// "chain.yaml:cam1" as its parts; of another path the second one is empty.
std::pair<std::string, std::string> path_and_name(const std::string& text) {
  const std::size_t colon = text.rfind(":cam");
  if (colon == text.npos || std::filesystem::exists(text)) return {text, ""};
  return {text.substr(0, colon), text.substr(colon + 1)};
}

CameraCalibration load_of_chain(const YamlNode& root, std::vector<std::string> cameras,
                                const std::string& chosen, ReadContext& context) {
  const auto found = chosen.empty() ? cameras.begin() : std::ranges::find(cameras, chosen);
  if (found == cameras.end()) {
    context.problems.fail(
        {}, "There is no camera " + chosen + ", but " + joined(cameras, {}, " and ") + ".");
  }
  const std::string name = *found;
  CameraCalibration calibration = read_chain(root, name, context);
  context.problems.raise_if_any();
  calibration.name = name;
  cameras.erase(found);
  if (chosen.empty()) calibration.passed_over = cameras;
  return calibration;
}

}  // namespace

CameraCalibration load_camera_calibration(const std::string& path_and_camera) {
  constexpr std::size_t kMostOfCalibration = 50000;  // OpenCV writes each corner that it has seen
  const auto [path, chosen] = path_and_name(path_and_camera);
  ReadContext context(path);
  YamlNode root = parse_yaml(read_scenario_text(path), context.problems, 0, kMostOfCalibration);
  const std::vector<std::string> cameras = cameras_of_chain(root);
  if (!cameras.empty()) return load_of_chain(root, cameras, chosen, context);
  if (!chosen.empty()) throw ScenarioError(path + " holds one camera, and no " + chosen + ".");
  drop_tags_of_opencv(root);
  drop_empty(root);
  CalibrationKeys keys;
  Reader reader(root, "", context);
  keys.visit(reader);
  expect_one_form(root, context.problems);
  expect_no_misspelling(root, context.problems);
  if (key_of_ros(root) != nullptr) {
    read_camera_info(root, context, keys);
  } else {
    for (const char* key : {"width", "height"}) expect_given(key, context);
    for (const char* key : {"intrinsics.fx", "intrinsics.fy", "intrinsics.cx", "intrinsics.cy"}) {
      if (keys.intrinsics) expect_given(key, context);
    }
  }
  context.problems.raise_if_any();
  CameraCalibration calibration;
  read_lens(keys, context, calibration.camera);
  read_rotations(keys, context, calibration);
  context.problems.raise_if_any();
  calibration.p_BR = keys.p_BR_m;
  calibration.focal_length_assumed = !keys.intrinsics;
  return calibration;
}

std::string to_yaml(const dodge::CameraModel& camera, const Eigen::Vector3d& p_BR) {
  const auto list = [](std::initializer_list<double> values) {
    std::string text;
    for (const double value : values) text += (text.empty() ? "[" : ", ") + to_text(value);
    return text + "]";
  };
  const Eigen::Vector3d p = camera.X_BC.translation();
  const Eigen::Matrix3d R = camera.X_BC.linear();
  std::string rows;
  for (int i = 0; i < 3; ++i) {
    rows += (i > 0 ? ", " : "") + list({R(i, 0) + 0.0, R(i, 1) + 0.0, R(i, 2) + 0.0});
  }
  return "width: " + to_text(camera.width) + "\nheight: " + to_text(camera.height) +
         "\nintrinsics: {fx: " + to_text(camera.fx) + ", fy: " + to_text(camera.fy) +
         ", cx: " + to_text(camera.cx) + ", cy: " + to_text(camera.cy) +
         "}\ndistortion: {model: " + kDistortion +
         ", coeffs: " + list({camera.k1, camera.k2, camera.p1, camera.p2, camera.k3}) +
         "}\np_BC_m: " + list({p.x(), p.y(), p.z()}) + "\nR_BC: [" + rows +
         "]\nimu_axes: forward left up\np_BR_m: " + list({p_BR.x(), p_BR.y(), p_BR.z()}) + "\n";
}

}  // namespace dodgesim

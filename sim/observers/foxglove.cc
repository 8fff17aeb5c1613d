#include "sim/observers/foxglove.h"

#include <algorithm>

#include "sim/files/base64.h"

namespace dodgesim::foxglove {

namespace schema {

Json number() { return {{"type", "number"}}; }
Json text() { return {{"type", "string"}}; }
Json boolean() { return {{"type", "boolean"}}; }
Json array_of(const Json& item) { return {{"type", "array"}, {"items", item}}; }

Json object(const std::string& title, const Json& properties) {
  return {{"title", title}, {"type", "object"}, {"properties", properties}};
}

namespace {

Json integer() { return {{"type", "integer"}}; }

Json seconds_and_nanoseconds(const std::string& title) {
  return object(title, {{"sec", integer()}, {"nsec", integer()}});
}

Json quaternion() {
  return object("foxglove.Quaternion",
                {{"x", number()}, {"y", number()}, {"z", number()}, {"w", number()}});
}

Json pose() {
  return object("foxglove.Pose", {{"position", vector()}, {"orientation", quaternion()}});
}

Json colour() {
  return object("foxglove.Color",
                {{"r", number()}, {"g", number()}, {"b", number()}, {"a", number()}});
}

// A primitive of a scene, with a pose, a colour and what else `more` says.
Json primitive(const std::string& title, Json more) {
  more["pose"] = pose();
  more["color"] = colour();
  return array_of(object("foxglove." + title, more));
}

Json scene_entity() {
  const Json pair = object("foxglove.KeyValuePair", {{"key", text()}, {"value", text()}});
  const Json points = {{"points", array_of(vector())},
                       {"colors", array_of(colour())},
                       {"indices", array_of(integer())}};
  Json line = points;
  line["type"] = integer();
  line["thickness"] = number();
  line["scale_invariant"] = boolean();
  return object("foxglove.SceneEntity",
                {{"timestamp", time()},
                 {"frame_id", text()},
                 {"id", text()},
                 {"lifetime", seconds_and_nanoseconds("duration")},
                 {"frame_locked", boolean()},
                 {"metadata", array_of(pair)},
                 {"arrows", primitive("ArrowPrimitive", {{"shaft_length", number()},
                                                         {"shaft_diameter", number()},
                                                         {"head_length", number()},
                                                         {"head_diameter", number()}})},
                 {"cubes", primitive("CubePrimitive", {{"size", vector()}})},
                 {"spheres", primitive("SpherePrimitive", {{"size", vector()}})},
                 {"cylinders", primitive("CylinderPrimitive", {{"size", vector()},
                                                               {"bottom_scale", number()},
                                                               {"top_scale", number()}})},
                 {"lines", primitive("LinePrimitive", line)},
                 {"triangles", primitive("TriangleListPrimitive", points)},
                 {"texts", primitive("TextPrimitive", {{"billboard", boolean()},
                                                       {"font_size", number()},
                                                       {"scale_invariant", boolean()},
                                                       {"text", text()}})},
                 {"models", array_of(object("foxglove.ModelPrimitive", Json::object()))}});
}

}  // namespace

Json time() { return seconds_and_nanoseconds("time"); }

Json vector() {
  return object("foxglove.Vector3", {{"x", number()}, {"y", number()}, {"z", number()}});
}

Json frame_transforms() {
  const Json transform = object("foxglove.FrameTransform", {{"timestamp", time()},
                                                            {"parent_frame_id", text()},
                                                            {"child_frame_id", text()},
                                                            {"translation", vector()},
                                                            {"rotation", quaternion()}});
  return object("foxglove.FrameTransforms", {{"transforms", array_of(transform)}});
}

Json pose_in_frame() {
  return object("foxglove.PoseInFrame",
                {{"timestamp", time()}, {"frame_id", text()}, {"pose", pose()}});
}

Json scene_update() {
  const Json deletion = object("foxglove.SceneEntityDeletion",
                               {{"timestamp", time()}, {"type", integer()}, {"id", text()}});
  return object("foxglove.SceneUpdate",
                {{"deletions", array_of(deletion)}, {"entities", array_of(scene_entity())}});
}

Json compressed_image() {
  const Json bytes = {{"type", "string"}, {"contentEncoding", "base64"}};
  return object("foxglove.CompressedImage",
                {{"timestamp", time()}, {"frame_id", text()}, {"data", bytes}, {"format", text()}});
}

Json camera_calibration() {
  return object("foxglove.CameraCalibration", {{"timestamp", time()},
                                               {"frame_id", text()},
                                               {"width", integer()},
                                               {"height", integer()},
                                               {"distortion_model", text()},
                                               {"D", array_of(number())},
                                               {"K", array_of(number())},
                                               {"R", array_of(number())},
                                               {"P", array_of(number())}});
}

Json log() {
  return object("foxglove.Log", {{"timestamp", time()},
                                 {"level", integer()},
                                 {"message", text()},
                                 {"name", text()},
                                 {"file", text()},
                                 {"line", integer()}});
}

}  // namespace schema

namespace {

Json colour_json(const Colour& c) { return {{"r", c[0]}, {"g", c[1]}, {"b", c[2]}, {"a", c[3]}}; }

Json vectors(const std::vector<Eigen::Vector3d>& points) {
  Json array = Json::array();
  for (const Eigen::Vector3d& point : points) array.push_back(vector(point));
  return array;
}

}  // namespace

Json time(TimeUs t_us) { return {{"sec", t_us / 1000000}, {"nsec", t_us % 1000000 * 1000}}; }

Json vector(const Eigen::Vector3d& v) { return {{"x", v.x()}, {"y", v.y()}, {"z", v.z()}}; }

Json quaternion(const Eigen::Quaterniond& q) {
  return {{"x", q.x()}, {"y", q.y()}, {"z", q.z()}, {"w", q.w()}};
}

Json pose(const Eigen::Vector3d& p, const Eigen::Quaterniond& q) {
  return {{"position", vector(p)}, {"orientation", quaternion(q)}};
}

Json frame_transform(TimeUs t_us, const std::string& parent, const std::string& child,
                     const Eigen::Vector3d& p, const Eigen::Quaterniond& q) {
  return {{"timestamp", time(t_us)},
          {"parent_frame_id", parent},
          {"child_frame_id", child},
          {"translation", vector(p)},
          {"rotation", quaternion(q)}};
}

Json pose_in_frame(TimeUs t_us, const std::string& frame, const Eigen::Vector3d& p,
                   const Eigen::Quaterniond& q) {
  return {{"timestamp", time(t_us)}, {"frame_id", frame}, {"pose", pose(p, q)}};
}

Json cube(const Json& pose, const Eigen::Vector3d& size_m, const Colour& colour) {
  return {{"pose", pose}, {"size", vector(size_m)}, {"color", colour_json(colour)}};
}

Json ellipsoid(const Json& pose, const Eigen::Vector3d& diameters_m, const Colour& colour) {
  return {{"pose", pose}, {"size", vector(diameters_m)}, {"color", colour_json(colour)}};
}

Json cylinder(const Json& pose, double diameter_m, double length_m, const Colour& colour) {
  return {{"pose", pose},
          {"size", vector({diameter_m, diameter_m, length_m})},
          {"bottom_scale", 1},
          {"top_scale", 1},
          {"color", colour_json(colour)}};
}

Json arrow(const Json& pose, double length_m, double diameter_m, const Colour& colour) {
  const double head_m = std::min(3 * diameter_m, length_m);
  return {
      {"pose", pose},          {"shaft_length", length_m - head_m}, {"shaft_diameter", diameter_m},
      {"head_length", head_m}, {"head_diameter", 2 * diameter_m},   {"color", colour_json(colour)}};
}

Json line(LineKind kind, const std::vector<Eigen::Vector3d>& points, double thickness_m,
          const Colour& colour) {
  return {{"type", static_cast<int>(kind)}, {"pose", pose(Eigen::Vector3d::Zero())},
          {"thickness", thickness_m},       {"scale_invariant", false},
          {"points", vectors(points)},      {"color", colour_json(colour)},
          {"colors", Json::array()},        {"indices", Json::array()}};
}

Json triangles(const Json& pose, const std::vector<Eigen::Vector3d>& corners,
               const Colour& colour) {
  return {{"pose", pose},
          {"points", vectors(corners)},
          {"color", colour_json(colour)},
          {"colors", Json::array()},
          {"indices", Json::array()}};
}

Json entity(TimeUs t_us, const std::string& frame, const std::string& id) {
  Json entity = {{"timestamp", time(t_us)},
                 {"frame_id", frame},
                 {"id", id},
                 {"lifetime", time(0)},
                 {"frame_locked", true}};
  for (const char* array : {"metadata", "arrows", "cubes", "spheres", "cylinders", "lines",
                            "triangles", "texts", "models"}) {
    entity[array] = Json::array();
  }
  return entity;
}

Json scene_update(const std::vector<Json>& entities) {
  return {{"deletions", Json::array()}, {"entities", entities}};
}

Json compressed_image(TimeUs t_us, const std::string& frame, const std::string& file) {
  return {
      {"timestamp", time(t_us)}, {"frame_id", frame}, {"data", base64(file)}, {"format", "png"}};
}

Json camera_calibration(TimeUs t_us, const std::string& frame, int width, int height, double f_px) {
  const double cx = (width - 1) / 2.0, cy = (height - 1) / 2.0;
  return {{"timestamp", time(t_us)},
          {"frame_id", frame},
          {"width", width},
          {"height", height},
          {"distortion_model", "plumb_bob"},
          {"D", {0, 0, 0, 0, 0}},
          {"K", {f_px, 0, cx, 0, f_px, cy, 0, 0, 1}},
          {"R", {1, 0, 0, 0, 1, 0, 0, 0, 1}},
          {"P", {f_px, 0, cx, 0, 0, f_px, cy, 0, 0, 0, 1, 0}}};
}

Json log(TimeUs t_us, Level level, const std::string& message) {
  return {{"timestamp", time(t_us)},
          {"level", static_cast<int>(level)},
          {"message", message},
          {"name", "dodgesim"},
          {"file", ""},
          {"line", 0}};
}

}  // namespace dodgesim::foxglove

// Messages as Foxglove and Lichtblick know them: their JSON, and the JSON schemas that say so
// (https://docs.foxglove.dev/docs/visualization/message-schemas). Vectors and quaternions are
// in the frame that a message names; lengths in metres.
#pragma once

#include <Eigen/Dense>
#include <string>
#include <vector>

#include "sim/base/time.h"
#include "sim/files/json.h"

namespace dodgesim::foxglove {

// Schemas of the messages below, and pieces to make others of.
namespace schema {
Json number();
Json text();
Json boolean();
Json vector();  // x, y, z
Json array_of(const Json& item);
Json object(const std::string& title, const Json& properties);
Json time();

Json frame_transforms();
Json pose_in_frame();
Json scene_update();
Json compressed_image();
Json camera_calibration();
Json log();
}  // namespace schema

Json time(TimeUs t_us);
Json vector(const Eigen::Vector3d& v);
Json quaternion(const Eigen::Quaterniond& q);
Json pose(const Eigen::Vector3d& p, const Eigen::Quaterniond& q = Eigen::Quaterniond::Identity());

// One of FrameTransforms: where `child` is in `parent`.
Json frame_transform(TimeUs t_us, const std::string& parent, const std::string& child,
                     const Eigen::Vector3d& p, const Eigen::Quaterniond& q);

Json pose_in_frame(TimeUs t_us, const std::string& frame, const Eigen::Vector3d& p,
                   const Eigen::Quaterniond& q);

// Red, green, blue, opacity, each 0 to 1.
using Colour = Eigen::Vector4d;

Json cube(const Json& pose, const Eigen::Vector3d& size_m, const Colour& colour);
Json ellipsoid(const Json& pose, const Eigen::Vector3d& diameters_m, const Colour& colour);
Json cylinder(const Json& pose, double diameter_m, double length_m, const Colour& colour);
Json arrow(const Json& pose, double length_m, double diameter_m, const Colour& colour);
enum class LineKind { kStrip = 0, kLoop = 1 };
Json line(LineKind kind, const std::vector<Eigen::Vector3d>& points, double thickness_m,
          const Colour& colour);
Json triangles(const Json& pose, const std::vector<Eigen::Vector3d>& corners, const Colour& colour);

// An entity of a SceneUpdate; the primitives above go into its arrays "cubes", "spheres",
// "cylinders", "arrows", "lines" and "triangles". It stays, and moves with its frame, until another
// of its name comes.
Json entity(TimeUs t_us, const std::string& frame, const std::string& id);
Json scene_update(const std::vector<Json>& entities);

// `file`: the bytes of a PNG.
Json compressed_image(TimeUs t_us, const std::string& frame, const std::string& file);

// A pinhole without distortion; the centre of the top-left pixel is (0, 0).
Json camera_calibration(TimeUs t_us, const std::string& frame, int width, int height, double f_px);

enum class Level { kInfo = 2, kWarning = 3, kError = 4 };
Json log(TimeUs t_us, Level level, const std::string& message);

}  // namespace dodgesim::foxglove

// How a ray-cast solid appears to a camera: what its painter needs, computed in double precision.
#pragma once

#include <Eigen/Dense>

#include "sim/camera/camera.h"
#include "sim/render/scene_geometry.h"

namespace dodgesim {

struct PrimitiveView {
  bool visible;           // in front of the camera, and the camera is not inside it
  Rect bounds;            // pixels it can touch, clipped to the image
  bool in_front;          // all of it
  double distance;        // of its centre [m], for drawing back to front
  Eigen::Matrix3d R_GC;   // rotates camera rays into the geom's frame G
  Eigen::Vector3d eye_G;  // camera centre in G [m]
  double margin;          // a ray that misses the solid by more leaves its pixel uncovered [m]
  // Outline of an ellipsoid or of the endless cylinder around a cylinder's or capsule's side: {(x,
  // y, 1) conic (x, y, 1)^T = 0}, positive inside, where (x, y) are pixel coordinates relative to
  // conic_origin.
  Eigen::Matrix3d conic = Eigen::Matrix3d::Zero();
  Eigen::Vector2d conic_origin = Eigen::Vector2d::Zero();
  // Straight pieces along the side of a pixel that follow this outline to within 0.003 px of area,
  // but four at most: what is smaller than a pixel across is drawn too large, a ball of 0.4 px by
  // an eighth, one of 0.2 px by half, a stick of 0.08 px by a third.
  int outline_pieces = 1;
};

PrimitiveView view_primitive(const Primitive& primitive, const Eigen::Isometry3d& X_WG,
                             const Eigen::Isometry3d& X_WC, const Intrinsics& intrinsics,
                             double near_m);

}  // namespace dodgesim

// What of a thrown object the cameras could see, from the truth.
#pragma once

#include <Eigen/Dense>
#include <optional>
#include <vector>

#include "sim/camera/camera.h"
#include "sim/config/scenario.h"
#include "sim/outcome/result.h"
#include "sim/outcome/trajectory.h"

namespace dodgesim {

// The event cameras that a scenario's pilot uses; the first is the reference.
struct CameraRig {
  Intrinsics intrinsics;
  std::vector<Eigen::Isometry3d> X_BC;
};

// Loads the vehicle's model. Throws ScenarioError.
CameraRig camera_rig(const Scenario& scenario);

// The camera's model has no margin: pixels -0.5 to width - 0.5.
bool centre_in_image(const Intrinsics& intrinsics, const Eigen::Vector3d& p_C);

// Whether the outline of a sphere lies wholly in the image: its distance from each of the four
// planes of the field of view is at least its radius.
bool whole_in_image(const Intrinsics& intrinsics, const Eigen::Vector3d& p_C, double radius_m);

// An object as the cameras see it at one instant.
struct ObjectView {
  Eigen::Isometry3d X_WC = Eigen::Isometry3d::Identity();  // the reference camera
  Eigen::Vector3d p_C = Eigen::Vector3d::Zero();           // the object's centre in it
  double radius_m = 0;
  bool centre_in_view = false;  // in the image of every camera
  bool whole_in_view = false;

  double range_m() const { return p_C.norm(); }
  double depth_m() const { return p_C.z(); }  // along the optical axis
};

ObjectView view_of(const CameraRig& rig, const Eigen::Isometry3d& X_WB, const Eigen::Vector3d& p_W,
                   double radius_m);

// Where a detection puts the object's centre in the world.
Eigen::Vector3d position_of(const DetectionRow& row);

// How far beyond an object's outline a detection may lie to be of the object: some 10 px.
inline constexpr double kOutlineMarginRad = 0.05;

// Whether a detection at p_W is of the object: the direction to it lies within the object's outline
// or at most kOutlineMarginRad beyond. Says nothing of the distance, so that an error of the depth,
// however great, counts as an error and not as another object.
bool on_outline(const ObjectView& view, const Eigen::Vector3d& p_W);

// An object's flight through the view, between the samples of a trajectory: positions linear (half
// a millimetre off for free fall), orientations by slerp. The trajectory itself is rounded to a
// millimetre and a degree, which moves the edge of the view by three pixels at most.
class Passage {
 public:
  Passage(const Trajectory& trajectory, const CameraRig& rig, std::size_t object = 0);

  TimeUs start_us() const { return trajectory_.start_us; }
  TimeUs end_us() const { return trajectory_.end_us; }

  // Empty outside of the trajectory and before the object is launched.
  std::optional<ObjectView> at(TimeUs t_us) const;

 private:
  TimeUs sample_us(std::size_t i) const;

  Trajectory trajectory_;
  CameraRig rig_;
  std::size_t object_;
};

}  // namespace dodgesim

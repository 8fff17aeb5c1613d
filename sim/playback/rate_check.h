// Whether the angular rates of a log fit the events of a camera.
//
// Turned back by the right rates, the events of a static scene fall onto few pixels: their contrast
// is high (Gallego, Rebecq and Scaramuzza, "A unifying contrast maximization framework for event
// cameras", CVPR 2018). Here contrast is the number of pairs of events of a window that share a
// pixel, but at least of those that do by chance. Windows in which the camera turns far enough are
// turned back by the rates as they are given, by the same rates along other axes, and by those of a
// little earlier or later.
#pragma once

#include <Eigen/Dense>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "dodge/camera_model.h"
#include "dodge/detect/ego_motion.h"
#include "sim/events/event.h"
#include "sim/sensors/readings.h"

namespace dodgesim {

class RateCheck {
 public:
  static constexpr int kFewestWindows = 10;  // of which other axes or stamps are named

  // R_BG: from the axes of the sensor to those of B, as they are taken to be; `rates` are in B.
  RateCheck(const dodge::CameraModel& camera, const std::vector<ImuReading>& rates,
            const Eigen::Matrix3d& R_BG);

  // The next events of the camera, in order of time; others are passed over.
  void add(std::span<const Event> events);

  struct Fit {
    int windows = 0;   // that were looked at
    double given = 1;  // contrast with the rates as they are, over that without turning back
    // With other axes, or the sensor's stamps moved by shift_us; empty and 0 unless surely better.
    std::string axes;  // right-handed ones if any of those are as good
    bool right_handed = true;
    int as_good = 0;  // others, as of a camera that turns about one axis only
    TimeUs shift_us = 0;
    double with_axes = 1, with_shift = 1;
  };
  Fit fit() const;

 private:
  // How the rates might be meant, and how much sharper than as they are given that is.
  struct Reading {
    Eigen::Matrix3d R_BG;
    TimeUs shift_us = 0;
    double sum = 0, sum_of_squares = 0;  // of ln(contrast / that of the rates as given)

    double mean(int windows) const { return sum / windows; }
    bool surely_better(int windows) const;
  };

  Eigen::Vector3d turned_until(TimeUs t_us) const;
  Eigen::Vector3d turn(TimeUs shift_us) const;
  double contrast(const Eigen::Vector3d& turn_B);
  double pairs_by_chance() const;
  void end_window_if_due();
  void look_at_window();
  const Reading* best(std::span<const Reading> readings) const;

  Eigen::Matrix3d R_GB_, R_CB_;
  int width_, height_;
  double px_per_rad_;
  std::vector<TimeUs> stamps_us_;       // of the rates
  std::vector<Eigen::Vector3d> turns_;  // their integral up to each stamp [rad]
  std::vector<Reading> axes_, shifts_;

  std::vector<dodge::Event> window_;
  TimeUs begin_us_ = 0, end_us_ = 0;  // of the window
  TimeUs checked_us_ = 0;             // when it was last asked whether the window ends
  TimeUs first_us_ = 0, rest_until_us_ = 0;
  bool started_ = false;
  int windows_ = 0;
  double by_chance_ = 1;  // pairs, of the window
  double gain_ = 0;       // sum of ln(contrast with the rates as given / without any)

  dodge::EgoMotion ego_motion_;
  std::vector<float> u_, v_;
  std::vector<int> pixels_;            // with events
  std::vector<std::uint32_t> counts_;  // by pixel
};

}  // namespace dodgesim

#include "sim/playback/detection_files.h"

#include <array>

#include "dodge/dodger.h"
#include "sim/base/vector3.h"
#include "sim/files/csv.h"

namespace dodgesim {

namespace {

struct CycleRow {
  TimeUs cycle_us = 0;  // its start
  int clusters = 0, detections = 0, obstacles = 0;
  bool evading = false, landing = false;
  std::array<double, 3> v_W_mps{};  // commanded

  template <class Visitor>
  void visit(Visitor& v) {
    v("cycle_us", cycle_us);
    v("clusters", clusters);
    v("detections", detections);
    v("obstacles", obstacles);
    v("evading", evading);
    v("landing", landing);
    v("v_W_mps", v_W_mps);
  }
};

struct ClusterRow {
  TimeUs cycle_us = 0;
  int camera = 0;                       // 0: the first
  double x_px = 0, y_px = 0;            // the rectangle's centre, in compensated pixels
  double width_px = 0, height_px = 0;   // its sides
  double angle_deg = 0;                 // of the first side, clockwise from x
  std::array<double, 2> velocity_px{};  // in a window
  double rho = 0;                       // mean normalised mean time stamp
  int pixels = 0, events = 0;

  template <class Visitor>
  void visit(Visitor& v) {
    v("cycle_us", cycle_us);
    v("camera", camera);
    v("x_px", x_px);
    v("y_px", y_px);
    v("width_px", width_px);
    v("height_px", height_px);
    v("angle_deg", angle_deg);
    v("velocity_px", velocity_px);
    v("rho", rho);
    v("pixels", pixels);
    v("events", events);
  }
};

struct FoundRow {
  TimeUs cycle_us = 0;
  TimeUs t_us = 0;  // the instant that the position speaks of
  int obstacle_id = -1;
  std::array<double, 3> p_W{};  // [m]
  double size_m = 0, depth_m = 0, depth_sigma_m = 0;

  template <class Visitor>
  void visit(Visitor& v) {
    v("cycle_us", cycle_us);
    v("t_us", t_us);
    v("obstacle_id", obstacle_id);
    v("p_W", p_W);
    v("size_m", size_m);
    v("depth_m", depth_m);
    v("depth_sigma_m", depth_sigma_m);
  }
};

struct ObstacleRow {
  TimeUs cycle_us = 0;
  TimeUs t_us = 0;
  int obstacle_id = -1;
  int detections = 0;  // so far
  std::array<double, 3> p_W{}, v_W_mps{};
  double size_m = 0;

  template <class Visitor>
  void visit(Visitor& v) {
    v("cycle_us", cycle_us);
    v("t_us", t_us);
    v("obstacle_id", obstacle_id);
    v("detections", detections);
    v("p_W", p_W);
    v("v_W_mps", v_W_mps);
    v("size_m", size_m);
  }
};

}  // namespace

DetectionFiles::DetectionFiles(const std::filesystem::path& directory)
    : directory_(directory),
      cycles_(directory / kNames[0]),
      clusters_(directory / kNames[1]),
      detections_(directory / kNames[2]),
      obstacles_(directory / kNames[3]) {
  cycles_.write(csv_header<CycleRow>());
  clusters_.write(csv_header<ClusterRow>());
  detections_.write(csv_header<FoundRow>());
  obstacles_.write(csv_header<ObstacleRow>());
}

int DetectionFiles::add(TimeUs now_us, const dodge::Pilot& pilot,
                        const dodge::VelocityCommand& command) {
  for (const dodge::Detection& d : pilot.detections()) {
    detections_.write(csv_row(FoundRow{now_us, d.t_us, d.obstacle_id, to_array(d.centre_W),
                                       d.size_m, d.depth_m, d.depth_sigma_m}));
  }
  for (const dodge::Obstacle& o : pilot.obstacles()) {
    obstacles_.write(csv_row(ObstacleRow{now_us, o.t_us, o.id, o.detections, to_array(o.p_WO),
                                         to_array(o.v_WO), o.size_m}));
  }
  const int clusters = add_clusters(now_us, pilot);
  cycles_.write(csv_row(CycleRow{now_us, clusters, static_cast<int>(pilot.detections().size()),
                                 static_cast<int>(pilot.obstacles().size()), command.evading,
                                 command.landing, to_array(command.v_W)}));
  return clusters;
}

int DetectionFiles::add_clusters(TimeUs now_us, const dodge::Pilot& pilot) {
  const auto* dodger = dynamic_cast<const dodge::Dodger*>(&pilot);
  if (dodger == nullptr) return 0;
  int count = 0;
  for (const int camera : {0, 1}) {
    for (const dodge::Cluster& c : dodger->clusters(camera)) {
      const cv::RotatedRect& r = c.rectangle;
      clusters_.write(csv_row(ClusterRow{now_us,
                                         camera,
                                         r.center.x,
                                         r.center.y,
                                         r.size.width,
                                         r.size.height,
                                         r.angle,
                                         {c.velocity.x(), c.velocity.y()},
                                         c.rho,
                                         c.pixels,
                                         c.events}));
      ++count;
    }
  }
  return count;
}

void DetectionFiles::finish() {
  for (OutputFile* file : {&cycles_, &clusters_, &detections_, &obstacles_}) file->finish();
  for (OutputFile* file : {&cycles_, &clusters_, &detections_, &obstacles_}) file->commit();
}

}  // namespace dodgesim

#include "sim/bench/stage_curves.h"

#include <algorithm>

#include "sim/files/directory.h"
#include "sim/files/output_file.h"
#include "sim/files/text_table.h"
#include "sim/plot/plot.h"

namespace dodgesim {

namespace {

struct Line {
  double at_0 = 0, slope = 0;
};

// y = at_0 + slope * x with the least squares.
Line fit(const std::vector<double>& x, const std::vector<double>& y) {
  const auto n = static_cast<double>(x.size());
  double mean_x = 0, mean_y = 0, xx = 0, xy = 0;
  for (std::size_t i = 0; i < x.size(); ++i) {
    mean_x += x[i] / n;
    mean_y += y[i] / n;
  }
  for (std::size_t i = 0; i < x.size(); ++i) {
    xx += (x[i] - mean_x) * (x[i] - mean_x);
    xy += (x[i] - mean_x) * (y[i] - mean_y);
  }
  const double slope = xx > 0 ? xy / xx : 0;
  return {mean_y - slope * mean_x, slope};
}

std::vector<double> all(const std::vector<WindowTimes>& windows, double WindowTimes::*member) {
  std::vector<double> values;
  values.reserve(windows.size());
  for (const WindowTimes& window : windows) values.push_back(window.*member);
  return values;
}

Line line_of(const std::vector<WindowTimes>& windows, double WindowTimes::*load,
             double WindowTimes::*time_us) {
  return fit(all(windows, load), all(windows, time_us));
}

void draw_curve(const std::filesystem::path& file, const std::string& title,
                const std::string& load_name, const std::vector<WindowTimes>& windows,
                double WindowTimes::*load, double WindowTimes::*time_us) {
  const std::vector<double> x = all(windows, load);
  const Line line = line_of(windows, load, time_us);
  const double most = x.empty() ? 1 : *std::ranges::max_element(x);
  Plot plot;
  plot.title = title;
  plot.x = {load_name, 0, std::max(1.0, most), false};
  plot.y = {"time [us]", 0, 0, false};
  plot.series.push_back({"windows", Series::Kind::kPoints, 0, x, all(windows, time_us), {}});
  plot.series.push_back({"least squares",
                         Series::Kind::kLine,
                         1,
                         {0, most},
                         {line.at_0, line.at_0 + line.slope * most},
                         {}});
  write_file(file, png_of(plot));
}

}  // namespace

double ego_motion_us_per_event(const std::vector<WindowTimes>& windows) {
  return line_of(windows, &WindowTimes::events, &WindowTimes::ego_motion_us).slope;
}

double clustering_us_per_pixel(const std::vector<WindowTimes>& windows) {
  return line_of(windows, &WindowTimes::pixels, &WindowTimes::clustering_us).slope;
}

void write_stage_curves(const std::filesystem::path& directory,
                        const std::vector<WindowTimes>& windows) {
  make_directory(directory);
  draw_curve(directory / "ego_motion.png", "Ego-motion compensation and time image",
             "events in 10 ms", windows, &WindowTimes::events, &WindowTimes::ego_motion_us);
  draw_curve(directory / "clustering.png", "Optical flow and clustering",
             "pixels of moving objects with events", windows, &WindowTimes::pixels,
             &WindowTimes::clustering_us);
  TextTable csv;
  csv.head = {"events", "pixels", "ego_motion_us", "clustering_us"};
  for (const WindowTimes& window : windows) {
    csv.rows.push_back({fixed_text(window.events, 0), fixed_text(window.pixels, 0),
                        fixed_text(window.ego_motion_us, 2), fixed_text(window.clustering_us, 2)});
  }
  write_file(directory / "windows.csv", csv.to_csv());
}

}  // namespace dodgesim

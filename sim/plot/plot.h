// Plots for reports: points, lines and histograms over one pair of axes.
#pragma once

#include <opencv2/core.hpp>
#include <string>
#include <vector>

namespace dodgesim {

struct Series {
  enum class Kind { kLine, kPoints, kBars };
  std::string name;  // in the legend; empty: not there
  Kind kind = Kind::kLine;
  int colour = 0;  // 0 to 5
  std::vector<double> x = {}, y = {};
  std::vector<double> spread = {};  // half-length of a bar about each point; empty: none

  void add(double at_x, double at_y) {
    x.push_back(at_x);
    y.push_back(at_y);
  }
};

struct PlotAxis {
  std::string label;
  double from = 0, to = 0;  // from == to: as the data ask for
  bool logarithmic = false;
};

struct Plot {
  std::string title;
  PlotAxis x, y;
  std::vector<Series> series;
};

// A histogram of `values` with bars over [from, to); what lies outside is left out. The heights are
// shares of all values.
Series histogram(const std::string& name, int colour, const std::vector<double>& values,
                 double from, double to, int bins);

// 640 x 400 px, and above the axes the lines that the names take [BGR].
cv::Mat3b draw(const Plot& plot);

// The bytes of that picture's PNG file.
std::string png_of(const Plot& plot);

}  // namespace dodgesim

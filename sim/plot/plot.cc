#include "sim/plot/plot.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <opencv2/imgproc.hpp>
#include <utility>

#include "sim/base/formatted.h"
#include "sim/files/png.h"

namespace dodgesim {

namespace {

constexpr int kWidth = 640, kHeight = 400;
constexpr int kLeft = 84, kRight = 20, kTop = 36, kBottom = 56;  // of the frame
constexpr int kFont = cv::FONT_HERSHEY_SIMPLEX;
constexpr double kTextScale = 0.42;
constexpr double kHeadRoom = 1.1;  // above the highest value
constexpr int kTicks = 6;          // on an axis, about the fewest

const cv::Scalar kInk(40, 40, 40), kGrid(225, 225, 225);
const std::array<cv::Scalar, 6> kColours = {cv::Scalar(180, 100, 30), cv::Scalar(40, 90, 220),
                                            cv::Scalar(80, 160, 60),  cv::Scalar(160, 60, 140),
                                            cv::Scalar(30, 160, 210), cv::Scalar(110, 110, 110)};

const cv::Scalar& colour_of(const Series& series) {
  return kColours[static_cast<std::size_t>(series.colour) % kColours.size()];
}

// From values to pixels along one axis.
struct Scale {
  double from, to;
  bool logarithmic;
  double pixel_from, pixel_to;

  double place(double value) const {
    const auto map = [this](double v) { return logarithmic ? std::log10(v) : v; };
    const double share = (map(value) - map(from)) / (map(to) - map(from));
    return pixel_from + std::clamp(share, -1.0, 2.0) * (pixel_to - pixel_from);
  }
  int pixel(double value) const { return static_cast<int>(std::lround(place(value))); }
};

// The range of an axis: as asked for, or that of the data.
std::pair<double, double> range(const PlotAxis& axis, const Plot& plot, bool horizontal) {
  if (axis.from != axis.to) return {axis.from, axis.to};
  double low = INFINITY, high = -INFINITY;
  for (const Series& series : plot.series) {
    const std::vector<double>& values = horizontal ? series.x : series.y;
    for (std::size_t i = 0; i < values.size(); ++i) {
      if (!std::isfinite(values[i]) || (axis.logarithmic && values[i] <= 0)) continue;
      const double reach = horizontal || series.spread.empty() ? 0 : series.spread[i];
      low = std::min(low, values[i] - (axis.logarithmic ? 0 : reach));
      high = std::max(high, values[i] + reach);
    }
    if (!horizontal && series.kind == Series::Kind::kBars) low = std::min(low, 0.0);
  }
  if (!(low <= high)) return {axis.logarithmic ? 0.1 : 0, 1};
  if (axis.logarithmic) return {low / 1.5, high * 1.5};
  if (horizontal) return low < high ? std::pair{low, high} : std::pair{low - 1, high + 1};
  const double margin = low < high ? (kHeadRoom - 1) * (high - low) : 1;
  return {low == 0 ? 0 : low - margin, high + margin};
}

std::vector<double> ticks(const Scale& scale) {
  std::vector<double> values;
  if (scale.logarithmic) {
    const int first = static_cast<int>(std::ceil(std::log10(scale.from) - 1e-9));
    const int last = static_cast<int>(std::floor(std::log10(scale.to) + 1e-9));
    const bool few = last - first < 2;
    for (int decade = first - 1; decade <= last; ++decade) {
      for (const double m : {1.0, 2.0, 5.0}) {
        const double value = m * std::pow(10.0, decade);
        if (value < scale.from || value > scale.to || (m > 1 && !few)) continue;
        values.push_back(value);
      }
    }
    return values;
  }
  const double rough = (scale.to - scale.from) / kTicks;
  const double decade = std::pow(10.0, std::floor(std::log10(rough)));
  double step = 10 * decade;
  for (const double m : {5.0, 2.0, 1.0}) {
    if (m * decade >= rough) step = m * decade;
  }
  const double first = std::ceil(scale.from / step - 1e-9);
  for (int i = 0; (first + i) * step <= scale.to + 1e-9 * step; ++i) {
    values.push_back((first + i) * step);
  }
  return values;
}

std::string tick_text(double value) {
  return formatted("%g", std::abs(value) < 1e-12 ? 0.0 : value);
}

void write(cv::Mat3b& image, const std::string& text, cv::Point at, double align) {
  const cv::Size size = cv::getTextSize(text, kFont, kTextScale, 1, nullptr);
  at.x -= static_cast<int>(align * size.width);
  cv::putText(image, text, at, kFont, kTextScale, kInk, 1, cv::LINE_AA);
}

void write_upright(cv::Mat3b& image, const std::string& text, int x, int y_middle) {
  const cv::Size size = cv::getTextSize(text, kFont, kTextScale, 1, nullptr);
  cv::Mat3b strip(size.height + 8, size.width + 2, cv::Vec3b(255, 255, 255));
  cv::putText(strip, text, {1, size.height + 2}, kFont, kTextScale, kInk, 1, cv::LINE_AA);
  cv::rotate(strip, strip, cv::ROTATE_90_COUNTERCLOCKWISE);
  const cv::Rect place(x, std::max(0, y_middle - strip.rows / 2), strip.cols, strip.rows);
  strip(cv::Rect(0, 0, strip.cols, std::min(strip.rows, image.rows - place.y)))
      .copyTo(image(
          cv::Rect(place.x, place.y, strip.cols, std::min(strip.rows, image.rows - place.y))));
}

void draw_frame(cv::Mat3b& image, const Plot& plot, const Scale& x, const Scale& y) {
  for (const double value : ticks(x)) {
    const int at = x.pixel(value);
    cv::line(image, {at, kTop}, {at, kHeight - kBottom}, kGrid);
    write(image, tick_text(value), {at, kHeight - kBottom + 16}, 0.5);
  }
  for (const double value : ticks(y)) {
    const int at = y.pixel(value);
    cv::line(image, {kLeft, at}, {kWidth - kRight, at}, kGrid);
    write(image, tick_text(value), {kLeft - 6, at + 4}, 1);
  }
  cv::rectangle(image, {kLeft, kTop}, {kWidth - kRight, kHeight - kBottom}, kInk);
  write(image, plot.title, {kWidth / 2, 22}, 0.5);
  write(image, plot.x.label, {(kLeft + kWidth - kRight) / 2, kHeight - 14}, 0.5);
  write_upright(image, plot.y.label, 2, (kTop + kHeight - kBottom) / 2);
}

void draw_bars(cv::Mat3b& image, const Series& series, const Scale& x, const Scale& y) {
  if (series.x.size() < 2) return;
  const double half = 0.5 * (series.x[1] - series.x[0]);
  for (std::size_t i = 0; i < series.x.size(); ++i) {
    const cv::Rect bar(cv::Point(x.pixel(series.x[i] - half), y.pixel(series.y[i])),
                       cv::Point(x.pixel(series.x[i] + half), y.pixel(0)));
    const cv::Rect visible = bar & cv::Rect(0, 0, kWidth, kHeight);
    if (visible.empty()) continue;
    cv::Mat part = image(visible);
    const cv::Mat paint(part.size(), CV_8UC3, colour_of(series));
    cv::addWeighted(part, 0.45, paint, 0.55, 0, part);
  }
}

void draw_points(cv::Mat3b& image, const Series& series, const Scale& x, const Scale& y) {
  const cv::Scalar& colour = colour_of(series);
  cv::Point last;
  bool started = false;
  for (std::size_t i = 0; i < series.x.size(); ++i) {
    if (!std::isfinite(series.y[i]) || (y.logarithmic && series.y[i] <= 0)) {
      started = false;
      continue;
    }
    const cv::Point at(x.pixel(series.x[i]), y.pixel(series.y[i]));
    if (series.kind == Series::Kind::kPoints) {
      cv::circle(image, at, 3, colour, cv::FILLED, cv::LINE_AA);
      if (!series.spread.empty()) {
        const double low = series.y[i] - series.spread[i];
        cv::line(image, {at.x, y.pixel(series.y[i] + series.spread[i])},
                 {at.x, y.logarithmic && low <= 0 ? kHeight - kBottom : y.pixel(low)}, colour, 1,
                 cv::LINE_AA);
      }
    } else if (started) {
      cv::line(image, last, at, colour, 1, cv::LINE_AA);
    }
    last = at;
    started = true;
  }
}

// The names of the series in lines as wide as the frame; empty if they have none.
cv::Mat3b legend(const Plot& plot) {
  constexpr int kLineHeight = 17, kMarkWidth = 16, kGap = 14;
  std::vector<std::pair<cv::Point, const Series*>> entries;
  cv::Point at(kLeft, 12);
  for (const Series& series : plot.series) {
    if (series.name.empty()) continue;
    const int width =
        kMarkWidth + cv::getTextSize(series.name, kFont, kTextScale, 1, nullptr).width;
    if (at.x > kLeft && at.x + width > kWidth - kRight) at = {kLeft, at.y + kLineHeight};
    entries.emplace_back(at, &series);
    at.x += width + kGap;
  }
  if (entries.empty()) return {};
  cv::Mat3b strip(at.y + 5, kWidth, cv::Vec3b(255, 255, 255));
  for (const auto& [place, series] : entries) {
    cv::rectangle(strip, place + cv::Point(0, -7), place + cv::Point(10, 1), colour_of(*series),
                  cv::FILLED);
    write(strip, series->name, place + cv::Point(kMarkWidth, 0), 0);
  }
  return strip;
}

}  // namespace

Series histogram(const std::string& name, int colour, const std::vector<double>& values,
                 double from, double to, int bins) {
  Series series{name, Series::Kind::kBars, colour};
  const double width = (to - from) / bins;
  for (int i = 0; i < bins; ++i) series.x.push_back(from + (i + 0.5) * width);
  series.y.resize(static_cast<std::size_t>(bins));
  for (const double value : values) {
    const double bin = std::floor((value - from) / width);
    if (!(bin >= 0 && bin < bins)) continue;
    series.y[static_cast<std::size_t>(bin)] += 1.0 / static_cast<double>(values.size());
  }
  return series;
}

cv::Mat3b draw(const Plot& plot) {
  cv::Mat3b image(kHeight, kWidth, cv::Vec3b(255, 255, 255));
  const auto [x_from, x_to] = range(plot.x, plot, true);
  const auto [y_from, y_to] = range(plot.y, plot, false);
  const Scale x{x_from, x_to, plot.x.logarithmic, kLeft, kWidth - kRight};
  const Scale y{y_from, y_to, plot.y.logarithmic, kHeight - kBottom, kTop};
  draw_frame(image, plot, x, y);
  cv::Mat3b inside = image.clone();
  for (const Series& series : plot.series) {
    if (series.kind == Series::Kind::kBars) {
      draw_bars(inside, series, x, y);
    } else {
      draw_points(inside, series, x, y);
    }
  }
  const cv::Rect frame(kLeft + 1, kTop + 1, kWidth - kRight - kLeft - 1,
                       kHeight - kBottom - kTop - 1);
  inside(frame).copyTo(image(frame));
  const cv::Mat3b names = legend(plot);
  if (names.empty()) return image;
  constexpr int kBelowTitle = 28;
  cv::vconcat(std::vector<cv::Mat3b>{image.rowRange(0, kBelowTitle), names,
                                     image.rowRange(kBelowTitle, kHeight)},
              image);
  return image;
}

std::string png_of(const Plot& plot) { return png_of(draw(plot)); }

}  // namespace dodgesim

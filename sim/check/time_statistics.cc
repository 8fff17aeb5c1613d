#include "sim/check/time_statistics.h"

#include <algorithm>
#include <tuple>

#include "sim/flight/plan.h"
#include "sim/loop.h"
#include "sim/observers/event_truth.h"

namespace dodgesim {

namespace {

constexpr std::size_t kLeastPixels = 300;  // of a region, to say anything about it
constexpr int kStatisticsBins = 50;

enum Shown : unsigned char { kNothing, kFixed, kDynamic, kOther };

// What fired a pixel: one cause only, or several and noise.
Shown merged(unsigned char before, Cause cause) {
  Shown now = kOther;
  if (cause == kCauseScene) now = kFixed;
  if (of_object(cause)) now = kDynamic;
  return before == kNothing || before == now ? now : kOther;
}

class Statistician : public EventTruth {
 public:
  explicit Statistician(TimeStatistics& out) : out_(out) {}

  void on_dodger_cycle(TimeUs now_us, const dodge::Dodger& dodger) override {
    const std::size_t rows_before = rows().size();
    EventTruth::on_dodger_cycle(now_us, dodger);
    if (rows().size() == rows_before) return;
    const dodge::StageImages& stages = dodger.stage_images(0);
    std::vector<unsigned char> shown(stages.rho.total(), kNothing);
    for (const WindowEvent& event : window(0)) {
      if (event.pixel < 0) continue;
      unsigned char& pixel = shown[static_cast<std::size_t>(event.pixel)];
      pixel = merged(pixel, event.cause);
    }
    TimeStatistics::Regions& regions = rows().back().evading ? out_.evading : out_.hovering;
    for (std::size_t i = 0; i < shown.size(); ++i) {
      const PixelTime time{stages.rho.ptr<float>()[i], stages.averaged.ptr<float>()[i]};
      if (shown[i] == kFixed) regions.fixed.push_back(time);
      if (shown[i] == kDynamic) regions.dynamic.push_back(time);
    }
  }

 private:
  TimeStatistics& out_;
};

double share_above(const std::vector<PixelTime>& pixels, double threshold) {
  const auto above = std::ranges::count_if(
      pixels, [threshold](const PixelTime& p) { return p.averaged >= threshold; });
  return 100 * static_cast<double>(above) / static_cast<double>(pixels.size());
}

std::vector<double> values(const std::vector<PixelTime>& pixels, double PixelTime::*member) {
  std::vector<double> out;
  out.reserve(pixels.size());
  for (const PixelTime& pixel : pixels) out.push_back(pixel.*member);
  return out;
}

Plot plot(const std::string& title, const std::string& label,
          const TimeStatistics::Regions& regions, double PixelTime::*member) {
  return {title,
          {label, -0.6, 0.6, false},
          {"share of the region's pixels", 0, 0, false},
          {histogram("static", 5, values(regions.fixed, member), -0.6, 0.6, kStatisticsBins),
           histogram("dynamic", 3, values(regions.dynamic, member), -0.6, 0.6, kStatisticsBins)}};
}

}  // namespace

TimeStatistics measure_time_statistics(const Scenario& scenario, int throw_index) {
  TimeStatistics statistics;
  statistics.threshold = scenario.dodger.time_image.threshold_b;
  FlightPlan plan = plan_throw(scenario, throw_index);
  plan.end_us = plan.launches.at(0).drawn.arrival_us() / kTickUs * kTickUs;
  Statistician statistician(statistics);
  fly(scenario, plan, &statistician);
  return statistics;
}

Check judge(const TimeStatistics& statistics) {
  Check check{
      "Time statistics of static and dynamic regions",
      "After the caption of figure S2 of Falanga et al. 2020 (the figure itself was not at hand): "
      "the normalised mean time stamp rho, equation (4), of the pixels of the top camera's "
      "compensated windows while a ball flies at the vehicle. Dynamic are pixels that only the "
      "ball fired, static those that only the room fired, by the true causes of their events. Both "
      "have the mean 0 and much the same spread pixel by pixel; averaged over neighbours the "
      "static ones draw together, while the side of a moving object where new events are stays "
      "apart. So more dynamic pixels than static ones must be above the pilot's threshold for a "
      "camera at rest."};
  for (const auto& [name, title, regions] :
       {std::tuple{"hovering", "before the vehicle evades", statistics.hovering},
        std::tuple{"evading", "while the vehicle evades", statistics.evading}}) {
    const std::string prefix = std::string("regions.") + name;
    if (regions.fixed.size() < kLeastPixels || regions.dynamic.size() < kLeastPixels) {
      check.off(prefix, "too few pixels of one of the regions");
      continue;
    }
    const double fixed = share_above(regions.fixed, statistics.threshold);
    const double dynamic = share_above(regions.dynamic, statistics.threshold);
    check.between(prefix + ".dynamic_above", dynamic, fixed, 100, "%", 2);
    check.plots.push_back(
        plot(std::string("rho of a pixel, ") + title, "rho", regions, &PixelTime::rho));
    check.plots.push_back(
        plot(std::string("rho averaged, ") + title, "averaged rho", regions, &PixelTime::averaged));
  }
  return check;
}

}  // namespace dodgesim

#include "tools/commands/detect_report.h"

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <numeric>

#include "dodge/dodger.h"
#include "sim/files/text_table.h"
#include "sim/world/vehicle_parameters.h"

namespace dodgesim {

namespace {

std::vector<std::int64_t> sizes_kb(const std::vector<std::string>& files) {
  std::vector<std::int64_t> sizes;
  sizes.reserve(files.size());
  for (const std::string& file : files) {
    sizes.push_back(static_cast<std::int64_t>(std::filesystem::file_size(file) / 1000));
  }
  return sizes;
}

void report_events(const Playback& playback, int cameras) {
  for (int camera = 0; camera < cameras; ++camera) {
    if (cameras > 1) std::printf("%s camera: ", kCameraNames[static_cast<std::size_t>(camera)]);
    std::printf("%s", count_text(playback.events(camera), "event").c_str());
    if (playback.late(camera) > 0) {
      std::printf(
          ", %lld of which stand more than 10 ms too late in their file: our pilots drop them",
          static_cast<long long>(playback.late(camera)));
    }
    std::printf("\n");
    const auto strays = static_cast<long long>(playback.strays(camera));
    if (strays == 0) continue;
    std::printf("%lld more passed over: stamped far ahead of the others\n", strays);
  }
}

void report_clocks_of_cameras(const Playback& playback) {
  if (playback.events(0) == 0 || playback.events(1) == 0) return;
  const TimeUs begin_us = std::max(playback.first_event_us(0), playback.first_event_us(1));
  const TimeUs end_us = std::min(playback.last_event_us(0), playback.last_event_us(1));
  const TimeUs shorter_us = std::min(playback.last_event_us(0) - playback.first_event_us(0),
                                     playback.last_event_us(1) - playback.first_event_us(1));
  if (2 * (end_us - begin_us) >= shorter_us) return;
  std::printf("Both cameras see something in %.3f s only: have their events one clock?\n",
              seconds(std::max<TimeUs>(end_us - begin_us, 0)));
}

}  // namespace

PlaybackProgress::PlaybackProgress(const std::vector<std::string>& files)
    : sizes_kb_(sizes_kb(files)),
      progress_(std::accumulate(sizes_kb_.begin(), sizes_kb_.end(), std::int64_t{0}),
                "kB of events") {}

void PlaybackProgress::show(const Playback& playback) {
  double played_kb = 0;
  for (std::size_t i = 0; i < sizes_kb_.size(); ++i) {
    played_kb += static_cast<double>(sizes_kb_[i]) * playback.part_played(static_cast<int>(i));
  }
  if (played_kb >= 1) progress_.show(static_cast<std::int64_t>(played_kb));
}

void Coverage::report(TimeUs begin_us, TimeUs end_us, TimeUs period_us) const {
  if (stamps_us_.empty()) return;
  if (*lacking_ != 0 && stamps_us_.front() > begin_us + period_us) {
    std::printf("%s: before its first reading, %.3f s after the first event, %s\n", name_,
                seconds(stamps_us_.front() - begin_us), lacking_);
  }
  if (stamps_us_.size() == 1 && *lacking_ != 0) {  // the state of a camera at rest
    std::printf("%s: 1 reading\n", name_);
    return;
  }
  const TimeUs covered_us =
      std::min(end_us, stamps_us_.back()) - std::max(begin_us, stamps_us_.front());
  constexpr std::ptrdiff_t kMany = 10;  // readings; few may be of a camera that hardly moves
  TimeUs longest_gap_us = 0;
  for (std::size_t i = 1; i < stamps_us_.size(); ++i) {
    const TimeUs from_us = stamps_us_[i - 1], to_us = stamps_us_[i];
    if (to_us > begin_us && from_us < end_us) {
      longest_gap_us = std::max(longest_gap_us, to_us - from_us);
    }
  }
  const bool little = 10 * covered_us < end_us - begin_us;
  const bool sparse = std::ssize(stamps_us_) > kMany && 2 * longest_gap_us > end_us - begin_us;
  std::printf("%s: %s, covers %.3f of %.3f s, longest gap %.1f ms%s\n", name_,
              count_text(std::ssize(stamps_us_), "reading").c_str(),
              seconds(std::max<TimeUs>(covered_us, 0)), seconds(end_us - begin_us),
              1e-3 * static_cast<double>(longest_gap_us),
              little || sparse ? ": are all times in microseconds, of one clock?" : "");
}

void report_rates(const char* log, const char* axes, const RateCheck::Fit& fit) {
  if (fit.windows == 0) {
    std::printf(
        "%s: the camera turns too little, or sees too little, to tell whether its rates fit\n",
        log);
    return;
  }
  const bool few = fit.windows < RateCheck::kFewestWindows;
  std::printf("%s: turned back by its rates, events are %.2f times as sharp as they are (%s%s)\n",
              log, fit.given, count_text(fit.windows, "window").c_str(),
              few ? ", too few to tell whether others would fit better" : "");
  if (!fit.axes.empty() && fit.with_axes >= fit.with_shift) {
    std::printf(
        "%s: with %s %s%s they would be %.2f times as sharp%s%s\n", log, axes, fit.axes.c_str(),
        fit.right_handed ? "" : ", which no sensor has,", fit.with_axes,
        fit.right_handed ? "" : ": is a sign wrong?",
        fit.as_good == 0 ? "" : (" (" + std::to_string(fit.as_good) + " others alike)").c_str());
  } else if (fit.shift_us != 0) {
    std::printf("%s: with its instants moved by %+g ms they would be %.2f times as sharp\n", log,
                1e-3 * static_cast<double>(fit.shift_us), fit.with_shift);
  }
}

bool report_degrees(const char* log, const RateCheck::Fit& fit) {
  // Of rates in radians a 57th hardly ever turns far enough to be looked at.
  constexpr double kSurelySharper = 1.5;
  if (fit.windows < RateCheck::kFewestWindows || fit.given < kSurelySharper) return false;
  std::printf(
      "%s: turned back by its rates as if they were degrees a second, events are %.2f times as "
      "sharp as they are (%s): t_us, wx, wy, wz are to be in rad/s\n",
      log, fit.given, count_text(fit.windows, "window").c_str());
  return true;
}

void report_ranges(const std::vector<RangeReading>& ranges,
                   const dodge::RangeSensorConfig& config) {
  const auto usable = [&config](const RangeReading& reading) {
    return reading.range_m >= config.min_range_m && reading.range_m <= config.max_range_m;
  };
  if (std::ranges::any_of(ranges, usable)) return;
  std::printf("Range: no reading (of %zd) lies within %g to %g m: are they in metres?\n",
              std::ssize(ranges), config.min_range_m, config.max_range_m);
}

void report_order(const CameraOrder& order) {
  if (!order.surely_swapped()) return;
  std::printf(
      "In %d of %d cycles in which each camera sees one thing, and both the same columns, the "
      "first "
      "camera's stands higher, as a lower camera's does: are their events swapped?\n",
      order.swapped(), order.counted());
}

void Sums::add(int clusters, const Playback& playback) {
  const auto found = static_cast<long long>(playback.pilot().detections().size());
  ++cycles_;
  with_clusters_ += clusters > 0 ? 1 : 0;
  with_detections_ += found > 0 ? 1 : 0;
  detections_ += found;
  evading_ += playback.command().evading ? 1 : 0;
  if (playback.command().landing && landing_++ == 0) {
    landing_since_us_ = playback.now_us() - playback.first_event_us();
  }
  if (const auto* dodger = dynamic_cast<const dodge::Dodger*>(&playback.pilot())) {
    const dodge::StageTimes& times = dodger->stage_times();
    stages_us_ += times.ego_motion_us + times.threshold_us + times.morphology_us +
                  times.clustering_us + times.rest_us;
  }
}

void Sums::report(const Playback& playback, int cameras, TimeUs period_us) const {
  report_events(playback, cameras);
  if (cameras == 2) report_clocks_of_cameras(playback);
  std::printf("%.3f s, %s: something moves in %lld, is measured in %lld (%s), is evaded in %lld\n",
              seconds(playback.last_event_us() - playback.first_event_us()),
              count_text(cycles_, "cycle").c_str(), with_clusters_, with_detections_,
              count_text(detections_, "detection").c_str(), evading_);
  const bool ours = dynamic_cast<const dodge::Dodger*>(&playback.pilot()) != nullptr;
  if (landing_ > 0) {
    std::printf("The pilot lands in %s, from %.3f s on%s\n", count_text(landing_, "cycle").c_str(),
                seconds(landing_since_us_),
                ours ? ": its height estimate and the range readings disagree" : "");
  }
  if (!ours) return;
  std::printf("The pilot's stages take %.3f ms a cycle here; a cycle comes every %g ms\n",
              1e-3 * stages_us_ / static_cast<double>(cycles_),
              1e-3 * static_cast<double>(period_us));
}

}  // namespace dodgesim

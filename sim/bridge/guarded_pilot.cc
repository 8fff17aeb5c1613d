#include "sim/bridge/guarded_pilot.h"

#include <algorithm>
#include <cmath>
#include <new>
#include <optional>

#include "sim/base/error.h"
#include "sim/base/formatted.h"
#include "sim/base/memory_limit.h"
#include "sim/base/process_state.h"
#include "sim/base/utf8.h"
#include "sim/bridge/no_exit.h"
#include "sim/world/snapshot.h"

namespace dodgesim {

namespace {

// Numbers beyond could overflow.
constexpr double kFastestMps = 1e6, kFarthestM = 1e6;

template <class Call>
auto guarded(Call call) -> decltype(call()) {
  const KeptRounding rounding;
  const NoExit no_exit;
  try {
    return call();
  } catch (const std::bad_alloc&) {
    throw MemoryError("The pilot " + threw_bad_alloc());
  } catch (const std::exception& error) {
    throw SimulationError("The pilot failed: " + sentence_of(error));
  } catch (...) {
    throw SimulationError("The pilot threw what is no std::exception.");
  }
}

[[noreturn]] void refuse(const char* what, dodge::TimeUs now_us) {
  throw SimulationError(formatted("The pilot %s at %g s.", what, dodge::seconds(now_us)));
}

// What is written of it to detections.csv.
void check_detection(const dodge::Detection& detection, dodge::TimeUs now_us) {
  if (detection.t_us > now_us) refuse("gave a detection a time stamp in the future", now_us);
  if (detection.t_us <= 0) refuse("gave a detection no instant, or one before the flight", now_us);
  if (detection.t_us < now_us - SnapshotHistory::kKeptUs) {
    refuse("gave a detection an instant more than a second ago", now_us);
  }
  if (!(detection.centre_W.array().abs() <= kFarthestM).all()) {  // false for NaN
    refuse("detected something that is nowhere, or more than a million m away", now_us);
  }
  if (!(detection.size_m >= 0 && detection.size_m <= kFarthestM)) {
    refuse("gave a detection a size_m that is not between 0 and a million m", now_us);
  }
  if (!(std::abs(detection.depth_m) <= kFarthestM)) {
    refuse("gave a detection a depth_m that is no number, or more than a million m", now_us);
  }
  if (!(detection.depth_sigma_m >= 0 && detection.depth_sigma_m <= kFarthestM)) {
    refuse("gave a detection a depth_sigma_m that is not between 0 and a million m", now_us);
  }
}

}  // namespace

std::string sentence_of(const std::exception& error) {
  std::string text = valid_utf8(error.what());
  std::ranges::replace_if(
      text, [](unsigned char c) { return c < ' '; }, ' ');
  while (!text.empty() && text.back() == ' ') text.pop_back();
  if (text.empty()) return "an exception without a text.";
  return text.back() == '.' ? text : text + ".";
}

std::string threw_bad_alloc() {
  const std::optional<std::int64_t> limit_mb = memory_limit_mb();
  return "threw std::bad_alloc, as when there is not enough memory" +
         (limit_mb ? ": the limit is " + std::to_string(*limit_mb) + " MB." : ".");
}

GuardedPilot::~GuardedPilot() {
  const NoExit no_exit;
  pilot_.reset();
}

void GuardedPilot::add_events(int camera, std::span<const dodge::Event> events) {
  guarded([&] { pilot_->add_events(camera, events); });
}

void GuardedPilot::add_imu(const dodge::ImuSample& sample) {
  guarded([&] { pilot_->add_imu(sample); });
}

void GuardedPilot::add_state(const dodge::StateEstimate& state) {
  guarded([&] { pilot_->add_state(state); });
}

void GuardedPilot::add_range(const dodge::RangeReading& reading) {
  guarded([&] { pilot_->add_range(reading); });
}

void GuardedPilot::set_goal(const dodge::Goal& goal) {
  guarded([&] { pilot_->set_goal(goal); });
}

dodge::VelocityCommand GuardedPilot::update(dodge::TimeUs now_us) {
  dodge::VelocityCommand command = guarded([&] { return pilot_->update(now_us); });
  if (!command.v_W.allFinite()) refuse("commanded a velocity that is no number", now_us);
  if (command.v_W.cwiseAbs().maxCoeff() > kFastestMps) {
    refuse("commanded a velocity beyond a million m/s", now_us);
  }
  if (command.t_us > now_us) refuse("gave a command a time stamp in the future", now_us);
  for (const dodge::Detection& detection : detections()) check_detection(detection, now_us);
  return command;
}

std::span<const dodge::Detection> GuardedPilot::detections() const {
  return guarded([&] { return pilot_->detections(); });
}

std::span<const dodge::Obstacle> GuardedPilot::obstacles() const {
  return guarded([&] { return pilot_->obstacles(); });
}

}  // namespace dodgesim

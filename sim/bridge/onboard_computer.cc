#include "sim/bridge/onboard_computer.h"

#include "sim/base/gravity.h"
#include "sim/bridge/to_dodge.h"

namespace dodgesim {

static_assert(dodge::kGravityMps2 == kGravityMps2);

OnboardComputer::OnboardComputer(const DelaySpec& delays, std::unique_ptr<dodge::Pilot> pilot)
    : pilot_(std::move(pilot)),
      delays_(delays),
      next_cycle_us_(delays.period_us()),
      imu_(delays.imu_us),
      states_(delays.state_estimate_us),
      ranges_(delays.range_us),
      commands_(delays.pilot_us()) {}

void OnboardComputer::send_events(int camera, TimeUs packet_end_us, std::span<const Event> packet) {
  Packet out;
  out.reserve(packet.size());
  for (const Event& e : packet) out.push_back(to_dodge(e));
  const auto line = static_cast<std::size_t>(camera);
  while (packets_.size() <= line) {
    packets_.emplace_back(delays_.transport_us_of(static_cast<int>(packets_.size())));
  }
  packets_[line].push(packet_end_us, std::move(out));
}

void OnboardComputer::send_imu(const ImuReading& reading) {
  imu_.push(reading.t_us, to_dodge(reading));
}

void OnboardComputer::send_state(const StateReading& reading) {
  states_.push(reading.t_us, to_dodge(reading));
}

void OnboardComputer::send_range(const RangeReading& reading) {
  ranges_.push(reading.t_us, to_dodge(reading));
}

bool OnboardComputer::run_cycle(TimeUs now_us) {
  if (now_us < next_cycle_us_) return false;
  next_cycle_us_ = now_us + delays_.period_us();
  imu_.deliver(now_us, [&](const dodge::ImuSample& sample) { pilot_->add_imu(sample); });
  states_.deliver(now_us, [&](const dodge::StateEstimate& state) { pilot_->add_state(state); });
  ranges_.deliver(now_us, [&](const dodge::RangeReading& reading) { pilot_->add_range(reading); });
  for (int camera = 0; camera < static_cast<int>(packets_.size()); ++camera) {
    packets_[static_cast<std::size_t>(camera)].deliver(
        now_us, [&](const Packet& packet) { pilot_->add_events(camera, packet); });
  }
  commands_.push(now_us, pilot_->update(now_us));
  return true;
}

std::optional<dodge::VelocityCommand> OnboardComputer::take_command(TimeUs now_us) {
  std::optional<dodge::VelocityCommand> newest;
  commands_.deliver(now_us, [&](const dodge::VelocityCommand& command) { newest = command; });
  return newest;
}

}  // namespace dodgesim

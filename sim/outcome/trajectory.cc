#include "sim/outcome/trajectory.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <utility>

#include "sim/base/error.h"

namespace dodgesim {

namespace {

using Eigen::Vector3d;

constexpr double kMillimetre = 1e-3, kCentimetre = 1e-2;
constexpr double kSpeedMps = 0.1, kQuaternion = 0.01;
constexpr TimeUs kMillisecondUs = 1000;

using Steps = std::array<std::int64_t, 3>;

// What a sample's head says.
constexpr std::uint64_t kEvading = 1, kSameCommand = 2;
constexpr int kFirstObjectBit = 2;
constexpr std::uint64_t kMostObjects = 60;

constexpr std::uint64_t kMostTicks = std::uint64_t{1} << 40;

// Damaged bytes may hold any number.
std::int64_t wrapping_sum(std::int64_t a, std::int64_t b) {
  return static_cast<std::int64_t>(static_cast<std::uint64_t>(a) + static_cast<std::uint64_t>(b));
}

std::int64_t wrapping_difference(std::int64_t a, std::int64_t b) {
  return static_cast<std::int64_t>(static_cast<std::uint64_t>(a) - static_cast<std::uint64_t>(b));
}

Steps steps(const Vector3d& v, double unit) {
  return {std::llround(v.x() / unit), std::llround(v.y() / unit), std::llround(v.z() / unit)};
}

Vector3d vector(const Steps& s, double unit) {
  return unit *
         Vector3d(static_cast<double>(s[0]), static_cast<double>(s[1]), static_cast<double>(s[2]));
}

// The vector part of the quaternion with a scalar part that is not negative.
Vector3d vector_part(const Eigen::Quaterniond& q) {
  return q.w() < 0 ? Vector3d(-q.vec()) : Vector3d(q.vec());
}

Eigen::Quaterniond with_vector_part(const Vector3d& v) {
  const double scalar = std::sqrt(std::max(0.0, 1 - v.squaredNorm()));
  return Eigen::Quaterniond(scalar, v.x(), v.y(), v.z()).normalized();
}

// Predicts the next of a row of positions.
class Motion {
 public:
  Steps predicted() const {
    Steps next{};
    for (std::size_t i = 0; i < 3; ++i) next[i] = wrapping_sum(last_[i], velocity_[i]);
    return next;
  }
  void add(const Steps& at) {
    for (std::size_t i = 0; i < 3; ++i)
      velocity_[i] = started_ ? wrapping_difference(at[i], last_[i]) : 0;
    last_ = at;
    started_ = true;
  }

 private:
  Steps last_{}, velocity_{};
  bool started_ = false;
};

class TrajectoryWriter {
 public:
  std::string take() { return std::move(bytes_); }

  void count(std::uint64_t value) {
    for (; value > 127; value >>= 7) bytes_ += static_cast<char>((value & 127) | 128);
    bytes_ += static_cast<char>(value);
  }
  void difference(const Steps& value, const Steps& predicted) {
    for (std::size_t i = 0; i < 3; ++i) {
      const std::int64_t d = value[i] - predicted[i];
      count(static_cast<std::uint64_t>(d) << 1 ^ static_cast<std::uint64_t>(d >> 63));
    }
  }
  void moved(Motion& motion, const Steps& value) {
    difference(value, motion.predicted());
    motion.add(value);
  }

 private:
  std::string bytes_;
};

class TrajectoryReader {
 public:
  explicit TrajectoryReader(std::string_view bytes) : bytes_(bytes) {}
  bool at_end() const { return bytes_.empty(); }

  std::uint64_t count() {
    std::uint64_t value = 0;
    for (int shift = 0; shift < 64; shift += 7) {
      if (bytes_.empty()) break;
      const auto byte = static_cast<unsigned char>(bytes_.front());
      bytes_.remove_prefix(1);
      value |= static_cast<std::uint64_t>(byte & 127) << shift;
      if (byte < 128) return value;
    }
    throw IoError("A trajectory is not whole.");
  }
  std::uint64_t count_up_to(std::uint64_t most) {
    const std::uint64_t value = count();
    if (value > most) throw IoError("A trajectory is damaged.");
    return value;
  }
  // How many of something follow, each at least a byte.
  std::uint64_t bounded_count() { return count_up_to(bytes_.size()); }
  TimeUs time_us() { return static_cast<TimeUs>(count_up_to(kMostTicks)) * kTickUs; }
  Steps difference(const Steps& predicted) {
    Steps value = predicted;
    for (std::int64_t& component : value) {
      const std::uint64_t zigzag = count();
      const auto d = static_cast<std::int64_t>(zigzag >> 1 ^ (~(zigzag & 1) + 1));
      component = wrapping_sum(component, d);
    }
    return value;
  }
  Steps moved(Motion& motion) {
    const Steps value = difference(motion.predicted());
    motion.add(value);
    return value;
  }

 private:
  std::string_view bytes_;
};

// What both directions keep from one sample to the next.
struct State {
  explicit State(std::size_t object_count) : objects(object_count) {}
  Motion vehicle;
  Steps attitude{}, command{};
  std::vector<Motion> objects;
};

void write_sample(TrajectoryWriter& writer, State& state, const Trajectory::Sample& sample) {
  const Steps command = steps(sample.command_W, kSpeedMps);
  std::uint64_t head = sample.evading ? kEvading : 0;
  if (command == state.command) head |= kSameCommand;
  for (std::size_t i = 0; i < sample.objects.size(); ++i) {
    if (sample.objects[i]) head |= std::uint64_t{1} << (kFirstObjectBit + i);
  }
  writer.count(head);
  writer.moved(state.vehicle, steps(sample.p_W, kMillimetre));
  const Steps attitude = steps(vector_part(sample.q_W), kQuaternion);
  writer.difference(attitude, state.attitude);
  state.attitude = attitude;
  if (command != state.command) writer.difference(command, state.command);
  state.command = command;
  for (std::size_t i = 0; i < sample.objects.size(); ++i) {
    if (sample.objects[i]) writer.moved(state.objects[i], steps(*sample.objects[i], kMillimetre));
  }
}

Trajectory::Sample read_sample(TrajectoryReader& reader, State& state) {
  Trajectory::Sample sample;
  const std::uint64_t head = reader.count();
  sample.evading = (head & kEvading) != 0;
  sample.p_W = vector(reader.moved(state.vehicle), kMillimetre);
  state.attitude = reader.difference(state.attitude);
  sample.q_W = with_vector_part(vector(state.attitude, kQuaternion));
  if ((head & kSameCommand) == 0) state.command = reader.difference(state.command);
  sample.command_W = vector(state.command, kSpeedMps);
  sample.objects.resize(state.objects.size());
  for (std::size_t i = 0; i < state.objects.size(); ++i) {
    if ((head >> (kFirstObjectBit + i) & 1) == 0) continue;
    sample.objects[i] = vector(reader.moved(state.objects[i]), kMillimetre);
  }
  return sample;
}

}  // namespace

std::string to_bytes(const Trajectory& trajectory) {
  TrajectoryWriter writer;
  writer.count(static_cast<std::uint64_t>(trajectory.start_us / kTickUs));
  writer.count(static_cast<std::uint64_t>(trajectory.period_us / kTickUs));
  writer.count(static_cast<std::uint64_t>((trajectory.end_us - trajectory.start_us) / kTickUs));
  writer.count(trajectory.sizes_m.size());
  for (const double size_m : trajectory.sizes_m) {
    writer.count(static_cast<std::uint64_t>(std::llround(size_m / kMillimetre)));
  }
  writer.count(trajectory.samples.size());
  State state(trajectory.sizes_m.size());
  for (const auto& sample : trajectory.samples) write_sample(writer, state, sample);
  writer.count(trajectory.detections.size());
  std::int64_t last_ms = trajectory.start_us / kMillisecondUs;
  Steps last{};
  for (const auto& detection : trajectory.detections) {
    const std::int64_t ms = std::max(last_ms, detection.output_us / kMillisecondUs);
    writer.count(static_cast<std::uint64_t>(ms - last_ms) << 1 | (detection.true_object ? 1 : 0));
    const Steps at = steps(detection.p_W, kCentimetre);
    writer.difference(at, last);
    last = at;
    last_ms = ms;
  }
  return writer.take();
}

Trajectory trajectory_from_bytes(std::string_view bytes) {
  TrajectoryReader reader(bytes);
  Trajectory trajectory;
  trajectory.start_us = reader.time_us();
  trajectory.period_us = reader.time_us();
  trajectory.end_us = trajectory.start_us + reader.time_us();
  trajectory.sizes_m.resize(reader.count_up_to(kMostObjects));
  for (double& size_m : trajectory.sizes_m) {
    size_m = kMillimetre * static_cast<double>(reader.count());
  }
  const std::uint64_t samples = reader.bounded_count();
  State state(trajectory.sizes_m.size());
  for (std::uint64_t i = 0; i < samples; ++i) {
    trajectory.samples.push_back(read_sample(reader, state));
  }
  trajectory.detections.resize(reader.bounded_count());
  std::int64_t ms = trajectory.start_us / kMillisecondUs;
  Steps at{};
  for (auto& detection : trajectory.detections) {
    const std::uint64_t head = reader.count_up_to(kMostTicks);
    ms += static_cast<std::int64_t>(head >> 1);
    at = reader.difference(at);
    detection = {ms * kMillisecondUs, vector(at, kCentimetre), (head & 1) != 0};
  }
  if (!reader.at_end()) throw IoError("A trajectory is longer than one.");
  return trajectory;
}

}  // namespace dodgesim

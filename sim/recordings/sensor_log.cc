#include "sim/recordings/sensor_log.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <initializer_list>
#include <numbers>
#include <optional>

#include "sim/base/error.h"
#include "sim/base/joined.h"
#include "sim/base/numbers.h"
#include "sim/recordings/raw_event.h"
#include "sim/recordings/text_columns.h"

namespace dodgesim {

namespace {

constexpr std::array<const char*, 3> kRates = {"wx", "wy", "wz"}, kForces = {"ax", "ay", "az"};

// Calls read() for every line, which may return nothing, and sees to it that time goes on.
template <class Reading, class Read>
std::vector<Reading> read_log(TextColumns& file, Read read) {
  const Column t_us = file.column("t_us");
  std::vector<Reading> log;
  std::optional<TimeUs> last_us;
  while (file.next()) {
    const TimeUs stamp = file.integer(t_us);
    if (stamp < -kLastUs || stamp > kLastUs) file.refuse(t_us, "nearer to 0");
    if (last_us && stamp <= *last_us) {
      throw ScenarioError(file.place() + ": t_us is " + to_text(stamp) +
                          ", but must be later than in the row before, " + to_text(*last_us) + ".");
    }
    last_us = stamp;
    std::optional<Reading> reading = read();
    if (!reading) continue;
    reading->t_us = stamp;
    log.push_back(*reading);
  }
  return log;
}

template <class Reading>
void expect_any(const std::vector<Reading>& log, const TextColumns& file) {
  if (log.empty()) throw ScenarioError(file.path() + " has no reading.");
}

// No vehicle is as far or as fast, in whatever units; sums of such numbers stay finite.
double number(const TextColumns& file, const Column& column) {
  constexpr double kMost = 1e9;
  const double value = file.number(column);
  if (std::abs(value) > kMost) file.refuse(column, "nearer to 0");
  return value;
}

// Three columns.
class VectorColumns {
 public:
  VectorColumns(const TextColumns& file, std::array<const char*, 3> names)
      : file_(file),
        x_(file.column(names[0])),
        y_(file.column(names[1])),
        z_(file.column(names[2])) {}

  Eigen::Vector3d read() const { return {number(file_, x_), number(file_, y_), number(file_, z_)}; }

 private:
  const TextColumns& file_;
  Column x_, y_, z_;
};

// Of columns that may be missing as a group.
std::optional<VectorColumns> if_any(const TextColumns& file, std::array<const char*, 3> names) {
  const auto has = [&file](const char* name) { return file.has(name); };
  const auto given = std::ranges::find_if(names, has);
  if (given == names.end()) return std::nullopt;
  const auto missing = std::ranges::find_if_not(names, has);
  if (missing == names.end()) return VectorColumns(file, names);
  throw ScenarioError(file.path() + " has a column " + *given + ", but no column " + *missing +
                      ": " + joined(names, {}, " and ") + " must be there all or not at all.");
}

Eigen::Vector3d read(const std::optional<VectorColumns>& columns) {
  return columns ? columns->read() : Eigen::Vector3d::Zero();
}

Eigen::Quaterniond rotation(const TextColumns& file, double w, const Eigen::Vector3d& xyz) {
  Eigen::Quaterniond q(w, xyz.x(), xyz.y(), xyz.z());
  constexpr double kRoundingOfText = 0.01, kExact = 1e-12;
  const double error = std::abs(q.norm() - 1);
  if (error < kExact) return q;  // to the last bit
  if (error < kRoundingOfText) return q.normalized();
  throw ScenarioError(file.place() + ": qw, qx, qy, qz have the length " + to_text(q.norm()) +
                      ", but must be a unit quaternion.");
}

// In the mean from one attitude to the next.
Eigen::Vector3d rate_between(const StateReading& now, const StateReading& next) {
  const Eigen::AngleAxisd turn(now.q_W.conjugate() * next.q_W);
  const double angle = std::remainder(turn.angle(), 2 * std::numbers::pi);  // the shorter way
  return angle / seconds(next.t_us - now.t_us) * turn.axis();
}

// A mean holds for the middle between two states; between two middles the rate is linear. The first
// and the last state turn as in the mean beside them.
void fill_in_rates(std::vector<StateReading>& states) {
  for (std::size_t i = 0; i + 1 < states.size(); ++i) {
    const Eigen::Vector3d ahead = rate_between(states[i], states[i + 1]);
    if (i == 0) {
      states[i].w_B = ahead;
    } else {  // it has the mean behind it so far
      const double since_s = seconds(states[i].t_us - states[i - 1].t_us);
      const double until_s = seconds(states[i + 1].t_us - states[i].t_us);
      states[i].w_B = (until_s * states[i].w_B + since_s * ahead) / (since_s + until_s);
    }
    states[i + 1].w_B = ahead;
  }
}

std::string line(TimeUs t_us, std::initializer_list<double> values) {
  std::string text = to_text(t_us);
  for (const double value : values) text += "," + to_text(value);
  return text + "\n";
}

}  // namespace

std::vector<ImuReading> read_imu_log(const std::string& path) {
  TextColumns file(path);
  file.read_names({"t_us", "wx", "wy", "wz"});
  const VectorColumns w(file, kRates);
  const auto f = if_any(file, kForces);
  auto log = read_log<ImuReading>(file, [&] { return ImuReading{0, w.read(), read(f)}; });
  expect_any(log, file);
  return log;
}

std::vector<StateReading> read_state_log(const std::string& path) {
  TextColumns file(path);
  file.read_names({"t_us", "x", "y", "z", "qw", "qx", "qy", "qz", "vx", "vy", "vz"});
  const VectorColumns p(file, {"x", "y", "z"}), q(file, {"qx", "qy", "qz"}),
      v(file, {"vx", "vy", "vz"});
  const Column qw = file.column("qw");
  const auto w = if_any(file, kRates);
  auto states = read_log<StateReading>(file, [&] {
    return StateReading{0, p.read(), rotation(file, number(file, qw), q.read()), v.read(), read(w)};
  });
  expect_any(states, file);
  if (!w) fill_in_rates(states);
  return states;
}

std::vector<RangeReading> read_range_log(const std::string& path) {
  TextColumns file(path);
  file.read_names({"t_us", "range_m"});
  const Column range_m = file.column("range_m");
  return read_log<RangeReading>(file, [&]() -> std::optional<RangeReading> {
    // "inf" and "nan", by which drivers say that nothing is in range.
    if (number_form(file.text(range_m)) == NumberForm::kNotFinite) return std::nullopt;
    return RangeReading{0, number(file, range_m)};
  });
}

std::string imu_header() { return "t_us,wx,wy,wz,ax,ay,az\n"; }
std::string state_header() { return "t_us,x,y,z,qw,qx,qy,qz,vx,vy,vz,wx,wy,wz\n"; }
std::string range_header() { return "t_us,range_m\n"; }

std::string log_line(const ImuReading& reading) {
  const Eigen::Vector3d &w = reading.w_B_radps, &f = reading.f_B_mps2;
  return line(reading.t_us, {w.x(), w.y(), w.z(), f.x(), f.y(), f.z()});
}

std::string log_line(const StateReading& reading) {
  const Eigen::Vector3d &p = reading.p_W, &v = reading.v_W, &w = reading.w_B;
  const Eigen::Quaterniond& q = reading.q_W;
  return line(reading.t_us, {p.x(), p.y(), p.z(), q.w(), q.x(), q.y(), q.z(), v.x(), v.y(), v.z(),
                             w.x(), w.y(), w.z()});
}

std::string log_line(const RangeReading& reading) { return line(reading.t_us, {reading.range_m}); }

}  // namespace dodgesim

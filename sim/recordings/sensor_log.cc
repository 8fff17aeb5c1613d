#include "sim/recordings/sensor_log.h"

#include <array>
#include <cmath>
#include <initializer_list>
#include <numbers>
#include <optional>

#include "sim/base/error.h"
#include "sim/base/numbers.h"
#include "sim/files/csv_table.h"

namespace dodgesim {

namespace {

// Calls read(table, row) for every row and sees to it that time goes on.
template <class Reading, class Read>
std::vector<Reading> read_log(const std::string& path, Read read) {
  const CsvTable table{std::filesystem::path(path)};
  std::vector<Reading> log;
  for (std::size_t row = 0; row < table.rows(); ++row) {
    const std::string place = path + ":" + std::to_string(table.line(row));
    const std::string& t_us = table.at(row, "t_us");
    const bool whole = number_form(t_us) == NumberForm::kInteger;
    const std::optional<TimeUs> stamp = whole ? parse_integer<TimeUs>(t_us) : std::nullopt;
    if (!stamp) throw ScenarioError(place + ": t_us is \"" + t_us + "\", but must be whole.");
    if (!log.empty() && *stamp <= log.back().t_us) {
      throw ScenarioError(place + ": t_us is " + t_us + ", but must be later than in the row " +
                          "before, " + to_text(log.back().t_us) + ".");
    }
    log.push_back(read(table, row));
    log.back().t_us = *stamp;
  }
  if (log.empty()) throw ScenarioError(path + " has no reading.");
  return log;
}

Eigen::Vector3d vector(const CsvTable& table, std::size_t row, std::array<const char*, 3> names) {
  return {table.number(row, names[0]), table.number(row, names[1]), table.number(row, names[2])};
}

// Of columns that may be missing as a group.
Eigen::Vector3d vector_if_any(const CsvTable& table, std::size_t row,
                              std::array<const char*, 3> names) {
  const bool any = table.has(names[0]) || table.has(names[1]) || table.has(names[2]);
  return any ? vector(table, row, names) : Eigen::Vector3d::Zero();
}

Eigen::Quaterniond rotation(const CsvTable& table, std::size_t row) {
  Eigen::Quaterniond q(table.number(row, "qw"), table.number(row, "qx"), table.number(row, "qy"),
                       table.number(row, "qz"));
  constexpr double kRoundingOfText = 0.01;
  if (std::abs(q.norm() - 1) < kRoundingOfText) return q;
  throw ScenarioError(table.name() + ":" + std::to_string(table.line(row)) +
                      ": qw, qx, qy, qz have the length " + to_text(q.norm()) +
                      ", but must be a unit quaternion.");
}

// From one attitude to the next; the last state goes on turning as before.
void fill_in_rates(std::vector<StateReading>& states) {
  for (std::size_t i = 0; i + 1 < states.size(); ++i) {
    const StateReading &now = states[i], &next = states[i + 1];
    const Eigen::AngleAxisd turn(now.q_W.conjugate() * next.q_W);
    const double angle = std::remainder(turn.angle(), 2 * std::numbers::pi);  // the shorter way
    states[i].w_B = angle / seconds(next.t_us - now.t_us) * turn.axis();
  }
  if (states.size() > 1) states.back().w_B = states[states.size() - 2].w_B;
}

std::string line(TimeUs t_us, std::initializer_list<double> values) {
  std::string text = to_text(t_us);
  for (const double value : values) text += "," + to_text(value);
  return text + "\n";
}

}  // namespace

std::vector<ImuReading> read_imu_log(const std::string& path) {
  return read_log<ImuReading>(path, [](const CsvTable& table, std::size_t row) {
    return ImuReading{0, vector(table, row, {"wx", "wy", "wz"}),
                      vector_if_any(table, row, {"ax", "ay", "az"})};
  });
}

std::vector<StateReading> read_state_log(const std::string& path) {
  bool has_rates = false;
  auto states = read_log<StateReading>(path, [&](const CsvTable& table, std::size_t row) {
    has_rates = table.has("wx");
    return StateReading{0, vector(table, row, {"x", "y", "z"}), rotation(table, row),
                        vector(table, row, {"vx", "vy", "vz"}),
                        vector_if_any(table, row, {"wx", "wy", "wz"})};
  });
  if (!has_rates) fill_in_rates(states);
  return states;
}

std::vector<RangeReading> read_range_log(const std::string& path) {
  return read_log<RangeReading>(path, [](const CsvTable& table, std::size_t row) {
    return RangeReading{0, table.number(row, "range_m")};
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

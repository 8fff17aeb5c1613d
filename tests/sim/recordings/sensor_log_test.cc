#include "sim/recordings/sensor_log.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "sim/base/error.h"
#include "sim/base/random.h"
#include "tests/complaint.h"
#include "tests/sim/files/temporary_directory.h"

namespace dodgesim {
namespace {

using testing::complaint;
using ::testing::HasSubstr;
using testing::put;
using testing::TemporaryDirectory;

class SensorLog : public ::testing::Test {
 protected:
  std::string file(const std::string& text) const { return put(root_ / "log.csv", text); }
  std::string refusal(const std::string& text) const {
    return complaint<ScenarioError>([&] { read_imu_log(file(text)); });
  }
  Eigen::Vector3d vector() { return {random_.normal(), random_.normal(), 1e-9 * random_.normal()}; }

  TemporaryDirectory root_;
  RandomStream random_{11, 0, "log"};
};

TEST_F(SensorLog, ReadsBackToTheLastBit) {
  std::vector<ImuReading> imu;
  std::vector<StateReading> states;
  std::vector<RangeReading> ranges;
  std::string imu_text = imu_header(), state_text = state_header(), range_text = range_header();
  for (TimeUs t_us = 1600000000000000; t_us < 1600000000050000; t_us += 997) {
    imu.push_back({t_us, vector(), vector()});
    const Eigen::Quaterniond q =
        Eigen::Quaterniond(random_.normal(), random_.normal(), random_.normal(), random_.normal())
            .normalized();
    states.push_back({t_us, vector(), q, vector(), vector()});
    ranges.push_back({t_us, random_.normal()});
    imu_text += log_line(imu.back());
    state_text += log_line(states.back());
    range_text += log_line(ranges.back());
  }
  const auto imu_read = read_imu_log(file(imu_text));
  const auto states_read = read_state_log(file(state_text));
  const auto ranges_read = read_range_log(file(range_text));
  ASSERT_EQ(imu_read.size(), imu.size());
  ASSERT_EQ(states_read.size(), states.size());
  ASSERT_EQ(ranges_read.size(), ranges.size());
  for (std::size_t i = 0; i < imu.size(); ++i) {
    EXPECT_EQ(imu_read[i].t_us, imu[i].t_us);
    EXPECT_EQ(imu_read[i].w_B_radps, imu[i].w_B_radps);
    EXPECT_EQ(imu_read[i].f_B_mps2, imu[i].f_B_mps2);
    EXPECT_EQ(states_read[i].t_us, states[i].t_us);
    EXPECT_EQ(states_read[i].p_W, states[i].p_W);
    EXPECT_EQ(states_read[i].q_W.coeffs(), states[i].q_W.coeffs());
    EXPECT_EQ(states_read[i].v_W, states[i].v_W);
    EXPECT_EQ(states_read[i].w_B, states[i].w_B);
    EXPECT_EQ(ranges_read[i].range_m, ranges[i].range_m);
  }
}

TEST_F(SensorLog, OfRatesAloneHasNoForces) {
  const auto imu = read_imu_log(file("wz,wy,wx,t_us,temperature\n3,2,1,5,20\n"));
  ASSERT_EQ(imu.size(), 1u);
  EXPECT_EQ(imu[0].w_B_radps, Eigen::Vector3d(1, 2, 3));
  EXPECT_EQ(imu[0].f_B_mps2, Eigen::Vector3d::Zero());
}

std::string without_rates(const std::vector<StateReading>& states) {
  std::string text = "t_us,x,y,z,qw,qx,qy,qz,vx,vy,vz\n";
  for (const StateReading& state : states) {
    const std::string line = log_line(state);
    std::size_t end = line.size();
    for (int cell = 0; cell < 3; ++cell) end = line.rfind(',', end - 1);
    text += line.substr(0, end) + "\n";
  }
  return text;
}

// Turns at a constant rate about an axis of B, through all signs of the quaternion.
TEST_F(SensorLog, OfAttitudesAloneHasTheRatesBetweenThem) {
  const Eigen::Vector3d w(3, -7, 5);
  std::vector<StateReading> states;
  for (int i = 0; i < 300; ++i) {
    Eigen::Quaterniond q(Eigen::AngleAxisd(0.004 * i * w.norm(), w.normalized()));
    if (i % 3 == 0) q.coeffs() *= -1;  // the same attitude
    states.push_back({.t_us = 4000 * i, .q_W = q});
  }
  for (const StateReading& state : read_state_log(file(without_rates(states)))) {
    EXPECT_LT((state.w_B - w).norm(), 1e-6) << state.t_us;
  }
}

// Turns ever faster: neither too early nor too late, though one state is missing.
TEST_F(SensorLog, OfAttitudesAloneHasTheRatesOfItsInstants) {
  const double radps2 = 10;
  std::vector<StateReading> states;
  for (const TimeUs t_us : {0, 33'000, 66'000, 132'000, 165'000}) {
    const double angle = 0.5 * radps2 * seconds(t_us) * seconds(t_us);
    states.push_back(
        {.t_us = t_us,
         .q_W = Eigen::Quaterniond(Eigen::AngleAxisd(angle, Eigen::Vector3d::UnitZ()))});
  }
  const auto read = read_state_log(file(without_rates(states)));
  for (std::size_t i = 1; i + 1 < read.size(); ++i) {
    EXPECT_NEAR(read[i].w_B.z(), radps2 * seconds(read[i].t_us), 1e-6) << read[i].t_us;
  }
}

TEST_F(SensorLog, OfARangeSensorMayLackReturns) {
  const auto ranges = read_range_log(file("t_us,range_m\n1,inf\n2,1.5\n3,NaN\n4,-Inf\n5,2\n"));
  ASSERT_EQ(ranges.size(), 2u);
  EXPECT_EQ(ranges[0].t_us, 2);
  EXPECT_EQ(ranges[1].range_m, 2);
  EXPECT_TRUE(read_range_log(file(range_header())).empty());  // of a flight high above the ground
  EXPECT_THAT(complaint<ScenarioError>([&] { read_range_log(file("t_us,range_m\n1,inf\n1,2\n")); }),
              HasSubstr("log.csv:3: t_us is 1, but must be later"));
}

TEST_F(SensorLog, RefusesWhatCannotBeWithItsLine) {
  EXPECT_THAT(refusal("t_us,wx,wy,wz\n"), HasSubstr("has no reading"));
  EXPECT_THAT(refusal("t_us,wx,wy,wz\n7,0,0,0\n7,0,0,0\n"),
              HasSubstr("log.csv:3: t_us is 7, but must be later"));
  EXPECT_THAT(refusal("t_us,wx,wy,wz\n7.5,0,0,0\n"), HasSubstr("log.csv:2: t_us is \"7.5\""));
  EXPECT_THAT(refusal("t_us,wx,wy,wz\n2000000000000000000,0,0,0\n"), HasSubstr("nearer to 0"));
  EXPECT_THAT(refusal("t_us,wx,wy,wz\n7,0,fast,0\n"),
              HasSubstr("log.csv:2: wy is \"fast\", but must be a number."));
  EXPECT_THAT(refusal("t_us,wx,wy,wz\n7,0,0,1e300\n"), HasSubstr("wz is \"1e300\", but must be"));
  EXPECT_THAT(refusal("t_us,wx,wy\n7,0,0\n"), HasSubstr("there is no column wz"));
  EXPECT_THAT(
      refusal("t_us,wx,wy,wz,az\n7,0,0,0,0\n"),
      HasSubstr("log.csv has a column az, but no column ax: ax, ay and az must be there all "
                "or not at all."));
  EXPECT_THAT(complaint<ScenarioError>([&] {
                read_state_log(file("t_us,x,y,z,qw,qx,qy,qz,vx,vy,vz\n1,0,0,0,1,1,0,0,0,0,0\n"));
              }),
              HasSubstr("must be a unit quaternion"));
}

// The pilot takes none but unit ones.
TEST_F(SensorLog, MakesRoundedQuaternionsUnitOnes) {
  const auto states =
      read_state_log(file("t_us,x,y,z,qw,qx,qy,qz,vx,vy,vz\n1,0,0,0,0.71,0,0.71,0,0,0,0\n"));
  EXPECT_NEAR(states.front().q_W.norm(), 1, 1e-15);
  EXPECT_NEAR(states.front().q_W.w(), std::sqrt(0.5), 1e-15);
}

}  // namespace
}  // namespace dodgesim

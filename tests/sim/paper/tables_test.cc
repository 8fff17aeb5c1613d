// The tables of campaigns that nobody has flown, with errors and gaps that are known.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <map>
#include <sstream>
#include <string>
#include <vector>

#include "sim/base/error.h"
#include "sim/paper/experiment.h"
#include "sim/paper/paper_tables.h"
#include "tests/sim/paper/synthetic_passage.h"

namespace dodgesim {
namespace {

using Eigen::Vector3d;
using ::testing::HasSubstr;

// A ball that hangs still ahead of the upper camera, 12 cm ahead of the vehicle's centre.
constexpr TimeUs kSomeTimeUs = 1000000;

Vector3d ahead(double depth_m) { return {0.12 + depth_m, 0, 0.075}; }

ThrowResult hanging_ball(int index, int cell, double depth_m, double size_m) {
  ThrowResult result;
  result.index = index;
  result.cell = cell;
  result.size_m = size_m;
  result.flown.status = "ok";
  result.trajectory = to_bytes(straight_flight(ahead(depth_m), {0, 0, 0}, size_m));
  return result;
}

void detect(ThrowResult& result, double depth_m, double error_m) {
  result.detection_rows.push_back(
      detection(kSomeTimeUs, ahead(depth_m + error_m), ahead(depth_m), depth_m));
}

LoadedCampaign campaign(const std::string& depth, std::vector<ThrowResult> results) {
  LoadedCampaign campaign;
  campaign.scenario = paper_scenario(
      "throw: {}\ngrid: {size_m: [0.1, 0.2, 0.3]}\ndodger: {position: {depth: " + depth + "}}\n");
  campaign.results = std::move(results);
  return campaign;
}

std::string line_with(const std::string& text, const std::string& begin) {
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) {
    if (line.starts_with(begin)) return line;
  }
  return "";
}

TEST(Table1, PutsErrorsIntoBinsOfTheTrueDistance) {
  ThrowResult near = hanging_ball(0, 0, 0.4, 0.1), far = hanging_ball(1, 0, 1.2, 0.1);
  for (const double error_m : {0.01, 0.02, 0.06}) detect(near, 0.4, error_m);
  for (const double error_m : {-0.2, 0.1}) detect(far, 1.2, error_m);
  // A false detection, half a metre aside.
  near.detection_rows.push_back(
      detection(kSomeTimeUs, ahead(0.4) + Vector3d(0, 0.5, 0), ahead(0.4), 0.4));
  const LoadedCampaign mono = campaign("mono", {near, far}), empty = campaign("mono", {});
  const LoadedCampaign stereo = campaign("stereo", {far}), rigs = campaign("stereo", {near});

  const PaperTables tables =
      table1_experiment().analyse({mono, empty, empty, stereo, stereo, rigs});
  // setup, bin, throws, detections, mean with interval, paper, median with interval, paper, ...;
  // one throw tells no interval.
  EXPECT_EQ(line_with(tables.csv, "\"monocular, all detections\",0.2,0.5"),
            "\"monocular, all detections\",0.2,0.5,1,3,0.0300,,,0.0800,0.0200,,,0.0500,0.0265,"
            "0.1800,0.0200,0.0900,0.0300,0.0300");
  EXPECT_EQ(line_with(tables.csv, "\"monocular, all detections\",0.5"), "");
  EXPECT_THAT(line_with(tables.csv, "\"monocular, all detections\",1.0,1.5"),
              HasSubstr(",1,2,0.1500,"));
  EXPECT_THAT(line_with(tables.csv, "\"stereo by centres, all detections\",1.0,1.5"),
              HasSubstr(",1,2,0.1500,,,0.1300,"));
  EXPECT_THAT(line_with(tables.csv, "\"stereo by centres, rigs calibrated to a pixel or two"),
              HasSubstr(",0.2,0.5,1,3,0.0300,"));
  EXPECT_THAT(tables.markdown,
              HasSubstr("5 detections of the ball in 2 throws; false detections: 1."));
}

TEST(Table1, SaysHowMuchOfTheirLeadTwoCamerasLose) {
  const auto seen = [](double near_error_m, double far_error_m) {
    std::vector<ThrowResult> throws;
    for (int i = 0; i < 10; ++i) {
      throws.push_back(hanging_ball(2 * i, 0, 0.4, 0.05));
      detect(throws.back(), 0.4, near_error_m);
      throws.push_back(hanging_ball(2 * i + 1, 0, 1.2, 0.05));
      detect(throws.back(), 1.2, far_error_m);
    }
    return campaign("mono", throws);
  };
  const LoadedCampaign mono = seen(0.03, 0.05), stereo = seen(0.01, 0.06);
  const PaperTables tables = table1_experiment().analyse({mono, mono, mono, stereo, mono, mono});
  EXPECT_EQ(line_with(tables.markdown, "| the paper |"),
            "| the paper | -0.01 | 0.00 | 0.03 | 0.04 |");
  EXPECT_EQ(line_with(tables.markdown, "| stereo by centres, all detections; monocular"),
            "| stereo by centres, all detections; monocular, ball wholly in view | "
            "-0.020 (-0.020 to -0.020) |  | 0.010 (0.010 to 0.010) | 0.030 (0.030 to 0.030) |");
}

TEST(Table1, DiscardsWhatIsPartlyOutsideOfTheImageOnRequest) {
  // 0.3 m ahead the view is 0.5 m wide: a ball of 30 cm that is 15 cm aside is cut off.
  ThrowResult cut = hanging_ball(0, 0, 0.3, 0.3);
  cut.trajectory = to_bytes(straight_flight(ahead(0.3) + Vector3d(0, 0.15, 0), {0, 0, 0}, 0.3));
  detect(cut, 0.3, 0.05);
  ThrowResult whole = hanging_ball(1, 0, 0.7, 0.1);
  detect(whole, 0.7, 0.05);
  const LoadedCampaign mono = campaign("mono", {cut, whole}), empty = campaign("mono", {});
  const PaperTables tables = table1_experiment().analyse({mono, empty, empty, empty, empty, empty});
  EXPECT_NE(line_with(tables.csv, "\"monocular, all detections\",0.2"), "");
  EXPECT_EQ(line_with(tables.csv, "\"monocular, ball wholly in view\",0.2"), "");
  EXPECT_NE(line_with(tables.csv, "\"monocular, ball wholly in view\",0.5"), "");
}

TEST(Table2, CountsThePassagesOfEachCell) {
  std::vector<ThrowResult> results;
  for (int i = 0; i < 10; ++i) {
    results.push_back(hanging_ball(i, 1, 0.7, 0.15));
    for (TimeUs t_us = 500000; t_us < 1500000; t_us += 5000) {
      results.back().detection_rows.push_back(detection(t_us, ahead(0.72), ahead(0.7), 0.7));
    }
  }
  // Nobody could see it: it does not count.
  results.push_back(hanging_ball(10, 1, 1.8, 0.15));
  const PaperTables tables = table2_experiment().analyse({campaign("stereo", results)});
  const std::string reading = "\"bins of distance, centre in view\",";
  EXPECT_EQ(line_with(tables.csv, reading + "<= 0.2 m,<= 1 m"),
            reading + "<= 0.2 m,<= 1 m,10,10,1.0000,0.7225,1.0000,0.92,0");
  EXPECT_EQ(line_with(tables.csv, reading + "<= 0.2 m,<= 0.5 m"),
            reading + "<= 0.2 m,<= 0.5 m,0,0,,0.0000,1.0000,0.87,0");
  // A hundred pieces in each of ten seconds.
  EXPECT_THAT(tables.csv, HasSubstr("each 10 ms by itself\",<= 0.2 m,<= 1 m,1000,1000,1.0000,"));
  EXPECT_THAT(tables.markdown, HasSubstr("Nothing was missed."));
}

TEST(Table2, AMissedPieceWidensItsInterval) {
  std::vector<ThrowResult> results;
  for (int i = 0; i < 10; ++i) {
    results.push_back(hanging_ball(i, 1, 0.7, 0.15));
    for (TimeUs t_us = 500000; t_us < 1500000; t_us += 5000) {
      if (i == 0 && t_us >= 700000 && t_us < 710000) continue;
      results.back().detection_rows.push_back(detection(t_us, ahead(0.72), ahead(0.7), 0.7));
    }
  }
  const std::string csv = table2_experiment().analyse({campaign("stereo", results)}).csv;
  // 999 of 1000 pieces in ten passages: the same share of ten trials.
  EXPECT_THAT(csv,
              HasSubstr("each 10 ms by itself\",<= 0.2 m,<= 1 m,999,1000,0.9990,0.7210,1.0000"));
}

TEST(PaperExperiments, AreFoundByName) {
  const auto without_names = experiments_named({});
  EXPECT_EQ(without_names.size() + 1, paper_experiments().size());
  EXPECT_NE(without_names.back().name, "quiet") << "it takes more than an hour";
  EXPECT_EQ(experiments_named({"quiet"}).size(), 1u);
  const auto two = experiments_named({"table2", "table1", "table2"});
  ASSERT_EQ(two.size(), 2u);
  EXPECT_EQ(two[0].name, "table1");
  EXPECT_THROW(experiments_named({"table9"}), ScenarioError);
}

TEST(PaperExperiments, ShareTheirFlights) {
  const auto all = flights_of(experiments_named({"outdoor", "more_throws"}));
  // The flights of falanga2020 at the throws of outdoor.md.
  EXPECT_EQ(all.size() + outdoor_experiment().flights.size() / 2,
            outdoor_experiment().flights.size() + more_throws_experiment().flights.size());
}

TEST(PaperExperiments, ShareOnlyFlightsThatAreTheSame) {
  std::map<std::string, std::string> arguments;
  for (const PaperExperiment& experiment : paper_experiments()) {
    for (const PaperFlight& flight : experiment.flights) {
      const auto [known, added] = arguments.emplace(flight.name, flight.arguments());
      EXPECT_EQ(known->second, flight.arguments()) << flight.name;
    }
  }
}

TEST(Table1, IsFlownInTheOrderOfItsSetups) {
  std::vector<std::string> names;
  for (const PaperFlight& flight : table1_experiment().flights) names.push_back(flight.name);
  EXPECT_EQ(names, (std::vector<std::string>{"toward_mono_0.075m", "toward_mono_0.15m",
                                             "toward_mono_0.25m", "toward_centres", "toward",
                                             "toward_rigs"}));
}

TEST(Table1, GivesTheDifferenceOfOneAndTwoCamerasAnInterval) {
  std::vector<ThrowResult> one, two;
  for (int i = 0; i < 40; ++i) {
    one.push_back(hanging_ball(i, 0, 0.7, 0.1));
    two.push_back(one.back());
    detect(one.back(), 0.7, i % 2 == 0 ? 0.11 : 0.13);  // 0.12, its mean known to 0.0016 m
    detect(two.back(), 0.7, i % 2 == 0 ? 0.06 : 0.1);   // 0.08, 0.0032 m
  }
  const LoadedCampaign mono = campaign("mono", one), empty = campaign("mono", {}),
                       stereo = campaign("stereo", two);
  const std::string text =
      table1_experiment().analyse({mono, empty, empty, stereo, empty, empty}).markdown;
  const std::string row =
      line_with(text, "| stereo by centres, all detections; monocular, ball wholly in view |");
  double difference_m = 0, lo_m = 0, hi_m = 0;
  ASSERT_EQ(std::sscanf(row.substr(row.find("view |") + 6).c_str(), " | %lf (%lf to %lf)",
                        &difference_m, &lo_m, &hi_m),
            3)
      << row;
  const double half_m = 1.96 * std::hypot(0.01, 0.02) / std::sqrt(40);
  EXPECT_DOUBLE_EQ(difference_m, -0.04);
  EXPECT_NEAR(lo_m, -0.04 - half_m, 0.0011);
  EXPECT_NEAR(hi_m, -0.04 + half_m, 0.0011);
}

TEST(PaperExperiments, SayHowTheirFlightsAreFlown) {
  EXPECT_EQ(table1_experiment().flights[1].arguments(),
            "scenarios/paper/toward_mono.yaml --set throw.size_m=0.15 --set "
            "dodger.position.known_size_m=0.15");
}

TEST(PaperExperiments, FlyScenariosThatAreRight) {
  const std::string root = DODGESIM_SOURCE_DIR;
  for (const PaperFlight& flight : flights_of(paper_experiments())) {
    EXPECT_NO_THROW(load_scenario(root + "/scenarios/paper/" + flight.scenario, root + "/models",
                                  flight.settings))
        << flight.name;
  }
}

TEST(PaperExperiments, AreWrittenSoThatAShellReadsThem) {
  const PaperFlight flight{"x", "x.yaml", {paper_setting("throw.speed_mps", "!uniform [4, 6]")}};
  EXPECT_EQ(flight.arguments(), "scenarios/paper/x.yaml --set 'throw.speed_mps=!uniform [4, 6]'");
}

}  // namespace
}  // namespace dodgesim

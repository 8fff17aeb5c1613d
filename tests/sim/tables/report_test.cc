#include "sim/tables/report.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <string>

#include "sim/files/base64.h"
#include "sim/files/json.h"
#include "sim/outcome/trajectory.h"
#include "tests/sim/tables/fake_throws.h"

namespace dodgesim {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

std::string between(const std::string& text, const std::string& start, const std::string& end) {
  const std::size_t from = text.find(start);
  EXPECT_NE(from, std::string::npos) << start;
  const std::size_t at = from + start.size();
  return text.substr(at, text.find(end, at) - at);
}

// 1.4 s of a dodge as it is kept.
std::string course() {
  Trajectory trajectory;
  trajectory.start_us = 400000;
  trajectory.period_us = 20000;
  trajectory.end_us = 400000 + 70 * 20000;
  trajectory.sizes_m = {0.2};
  for (int i = 0; i <= 70; ++i) {
    const double t = 0.02 * i;
    Trajectory::Sample sample;
    sample.p_W = {-2, 2 * t * t, 2};
    sample.evading = i > 30;
    if (sample.evading) sample.command_W = {0, 5, 0};
    sample.objects.push_back(Eigen::Vector3d(3 - 5 * t, 0, 2));
    trajectory.samples.push_back(sample);
  }
  for (int i = 0; i < 20; ++i) {
    trajectory.detections.push_back({900000 + 20000 * i, {0, 0, 2}, true});
  }
  return to_bytes(trajectory);
}

LoadedCampaign campaign(int throws) {
  LoadedCampaign campaign;
  campaign.scenario.name = "a <title> & </script>";
  campaign.scenario.seed = 18446744073709551615U;
  campaign.scenario.repeats = throws;
  campaign.program = "0.1.0 abcdef";
  const std::string trajectory = course();
  for (int i = 0; i < throws; ++i) {
    ThrowResult result = ball(i, 0.1 * (1 + i % 3), 3 + i % 2, 4 + 2 * (i % 3));
    result.flown = flown(i % 4 == 0);
    result.none = result.oracle = flown(i % 5 != 0);
    if (result.flown.hit) result.cause = "wrong direction";
    result.trajectory = trajectory;
    result.wall_s = 2;
    campaign.results.push_back(result);
  }
  return campaign;
}

Json data_of(const std::string& html) {
  return parse_json(between(html, "id=\"data\">", "</script>"));
}

TEST(ReportPage, NeedsNothingButItself) {
  const std::string html = report_html(campaign(3), "out/x");
  for (const char* outside : {"https://", "src=", "href=", "@import", "url("}) {
    EXPECT_THAT(html, Not(HasSubstr(outside)));
  }
  for (const char* placeholder : {"@TITLE@", "@STYLE@", "@DATA@", "@TRACKS@", "@SCRIPT@"}) {
    EXPECT_THAT(html, Not(HasSubstr(placeholder)));
  }
  EXPECT_THAT(html, HasSubstr("</html>\n"));
}

TEST(ReportPage, TextsOfTheScenarioStayTexts) {
  const std::string html = report_html(campaign(3), "out/x");
  EXPECT_THAT(html, HasSubstr("<title>a &lt;title&gt; &amp; &lt;/script&gt; - dodgesim</title>"));
  EXPECT_EQ(data_of(html)["title"], "a <title> & </script>");
}

TEST(ReportPage, SaysWithWhatTheCampaignWasFlown) {
  const auto data = data_of(report_html(campaign(3), "out/x"));
  EXPECT_EQ(data["program"], "dodgesim 0.1.0 abcdef");
  EXPECT_EQ(data["seed"], "18446744073709551615");  // more than a number of JavaScript can hold
  EXPECT_EQ(data["wanted"], 3);
}

TEST(ReportPage, ReplayLinesSurviveAnyNameOfADirectory) {
  EXPECT_EQ(data_of(report_html(campaign(1), "out/x"))["replay"], "dodgesim replay out/x --throw ");
  EXPECT_EQ(data_of(report_html(campaign(1), "it's mine"))["replay"],
            "dodgesim replay 'it'\\''s mine' --throw ");
  LoadedCampaign own = campaign(1);
  own.scenario.models_dir = "my models";
  EXPECT_EQ(data_of(report_html(own, "out/x"))["replay"],
            "dodgesim replay out/x --models 'my models' --throw ");
}

TEST(ReportPage, ChartsShowTheCountsOfTheTables) {
  const auto section = data_of(report_html(campaign(60), "out/x"))["sections"][0];
  ASSERT_EQ(section["pilots"].size(), 3u);
  const auto& pilot = section["pilots"][0];
  // Throws 0 to 59: those with i % 5 != 0 would have hit, those with i % 4 == 0 were hit.
  EXPECT_EQ(pilot["total"][0], 36);
  EXPECT_EQ(pilot["total"][1], 48);
  EXPECT_EQ(section["pilots"][2]["total"][0], 48);
  EXPECT_EQ(section["pilots"][2]["total"][1], 60);
  int would_have_hit = 0;
  for (const auto& row : pilot["heat"]) {
    ASSERT_EQ(row.size(), 2u);
    for (const auto& cell : row) would_have_hit += cell[1].get<int>();
  }
  EXPECT_EQ(would_have_hit, 48);
}

TEST(ReportPage, TellsPilotsApartByTheirRoleWhateverTheirNames) {
  LoadedCampaign swept = campaign(20);
  for (ThrowResult& result : swept.results) {
    result.sweep = result.index / 10;
    result.sweep_values = {{"pilot", result.sweep == 0 ? "none" : "oracle"}};
  }
  const auto sections = data_of(report_html(swept, "out/x"))["sections"];
  const auto pilots = [&](int k) {
    std::string text;
    for (const auto& pilot : sections[k]["pilots"]) {
      text += pilot["role"].get<std::string>() + " " + pilot["name"].get<std::string>() + ", ";
    }
    return text;
  };
  EXPECT_EQ(pilots(0), "flown none, oracle oracle, none none, ");
  EXPECT_EQ(pilots(1), "flown oracle, none none, ");
}

TEST(ReportPage, ValuesOfASweepHaveChartsOfTheirOwn) {
  LoadedCampaign swept = campaign(20);
  for (ThrowResult& result : swept.results) {
    result.sweep = result.index / 10;
    result.sweep_values = {{"delays.compute_us", result.sweep == 0 ? "0" : "10000"}};
  }
  const auto data = data_of(report_html(swept, "out/x"));
  EXPECT_EQ(data["sweep_keys"], parse_json(R"(["delays.compute_us"])"));
  ASSERT_EQ(data["sections"].size(), 2u);
  EXPECT_EQ(data["sections"][1]["values"][0], "10000");
  EXPECT_EQ(data["sections"][1]["pilots"][2]["total"][1], 10);
}

TEST(ReportPage, ShowsTheCellsOfAnyGridAndTheHeatMapOfItsFirstTwoNumbers) {
  LoadedCampaign grid = campaign(48);
  for (ThrowResult& result : grid.results) {
    const int i = result.index;
    result.cell_values = {{"throw.object", i % 2 == 0 ? "ball" : "box"},
                          {"throw.bearing_deg", i % 6 < 2   ? "-20"
                                                : i % 6 < 4 ? "0"
                                                            : "20"},
                          {"delays.command_us", "5000"}};
  }
  const auto data = data_of(report_html(grid, "out/x"));
  EXPECT_EQ(data["heat"][0]["key"], "throw.bearing_deg");
  EXPECT_EQ(data["heat"][1]["key"], "delays.command_us");
  ASSERT_EQ(data["cells"]["values"].size(), 6u);
  EXPECT_EQ(data["cells"]["values"][4], parse_json(R"(["box", "0", "5000"])"));
  const auto& none = data["sections"][0]["pilots"][2];
  ASSERT_EQ(none["by_cell"].size(), 6u);
  for (const auto& rate : none["by_cell"]) EXPECT_EQ(rate[1], 8);
  EXPECT_EQ(none["heat"].size(), 3u);
  EXPECT_EQ(none["heat"][2][0][1], 16);
}

TEST(ReportPage, NamesTheObjectsThatWereThrownAndNotHowTheyWereDrawn) {
  LoadedCampaign grid = campaign(3);
  for (ThrowResult& result : grid.results) {
    result.cell_values = {{"object", "!choice [ball, box]"}};
    result.object = result.index == 1 ? "box" : "ball";
  }
  const auto data = data_of(report_html(grid, "out/x"));
  EXPECT_EQ(data["objects"], parse_json(R"(["ball", "box"])"));
  EXPECT_EQ(data["columns"]["object"]["values"], base64(std::string("\0\1\0", 3)));
}

TEST(ReportPage, SaysOfAThrowThatNobodyCanJudgeWhy) {
  LoadedCampaign one = campaign(1);
  one.results[0].flown = flown(false);
  one.results[0].none = failed("It diverged.");
  const auto data = data_of(report_html(one, "out/x"));
  EXPECT_EQ(data["errors"]["0"], "The flight of the pilot none failed: It diverged.");
  one.scenario.pilot = "none";
  one.results[0].flown = one.results[0].none;
  EXPECT_EQ(data_of(report_html(one, "out/x"))["errors"]["0"], "It diverged.");
  const auto fate = [&](const std::string& name) {
    const auto at = std::find(data["fates"].begin(), data["fates"].end(), name);
    return base64(std::string(1, static_cast<char>(at - data["fates"].begin())));
  };
  EXPECT_EQ(data["columns"]["fate"]["values"], fate("not judged"));
  one.results[0].oracle = failed("It diverged.");
  EXPECT_EQ(data_of(report_html(one, "out/x"))["columns"]["fate"]["values"], fate("not flown"));
}

TEST(ReportPage, OfNoThrowsAndOfQuietFlightsIsAPage) {
  EXPECT_THAT(report_html(campaign(0), "out/x"), HasSubstr("</html>"));
  LoadedCampaign quiet = campaign(0);
  quiet.results.resize(2);
  for (ThrowResult& result : quiet.results) result.flown = flown(false);
  EXPECT_EQ(data_of(report_html(quiet, "out/x"))["heat"][0]["values"].size(), 0u);
}

TEST(ReportPage, OfTenThousandThrowsIsBelow20Megabytes) {
  EXPECT_LT(report_html(campaign(10000), "out/x").size(), 20e6);
}

}  // namespace
}  // namespace dodgesim

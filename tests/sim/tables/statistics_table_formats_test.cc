#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <sstream>

#include "sim/base/numbers.h"
#include "sim/files/json.h"
#include "sim/tables/statistics_table.h"
#include "tests/sim/tables/fake_throws.h"

namespace dodgesim {
namespace {

using ::testing::HasSubstr;

// Two balls and a flight in which nobody threw.
StatisticsTable table() {
  std::vector<ThrowResult> results = {ball(0, 0.1, 2, 4), ball(1, 0.2, 2, 4), ThrowResult{}};
  results[0].object = "a_b & \"c\" | \\ 50%, \xff";
  for (ThrowResult& result : results) result.flown = flown(false);
  results[0].none = results[1].none = flown(true);
  results[1].flown = flown(true);
  results[1].cause = "seen late";
  const Axis object("object", results), size("size_m", results);
  return group_by(parts_of(results, "falanga2020"), {object, size});
}

std::vector<std::string> lines(const std::string& text) {
  std::istringstream stream(text);
  std::vector<std::string> out;
  for (std::string line; std::getline(stream, line);) out.push_back(line);
  return out;
}

std::vector<std::string> cells(const std::string& row) {
  std::istringstream stream(row);
  std::vector<std::string> out;
  for (std::string cell; std::getline(stream, cell, ',');) out.push_back(cell);
  return out;
}

TEST(GroupBy, HasARowForEachCombinationThatOccursAndOneOfAll) {
  const StatisticsTable grouped = table();
  ASSERT_EQ(grouped.rows.size(), 3u);
  EXPECT_THAT(grouped.rows[1].values, ::testing::ElementsAre("ball", "0.2"));
  EXPECT_THAT(grouped.rows[2].values, ::testing::ElementsAre("all", "all"));
  EXPECT_EQ(grouped.rows[2].statistics.flown().tally.throws, 2);
  EXPECT_EQ(grouped.rows[2].statistics.false_alarms.of, 3);
}

TEST(GroupBy, KeepsValuesOfASweepApart) {
  std::vector<ThrowResult> results = {ball(0, 0.1, 2, 4), ball(1, 0.1, 2, 4)};
  results[0].sweep_values = {{"delays.compute_us", "0"}};
  results[1].sweep_values = {{"delays.compute_us", "3500"}};
  results[1].sweep = 1;
  const StatisticsTable grouped =
      group_by(parts_of(results, "falanga2020"), {Axis("size_m", results)});
  EXPECT_THAT(grouped.keys, ::testing::ElementsAre("delays.compute_us", "size_m"));
  ASSERT_EQ(grouped.rows.size(), 4u);
  EXPECT_THAT(grouped.rows[1].values, ::testing::ElementsAre("0", "all"));
  EXPECT_THAT(grouped.rows[2].values, ::testing::ElementsAre("3500", "0.1"));
}

TEST(TableFormats, CsvHasEqualColumnsAndEmptyCellsForTheUnknown) {
  const std::vector<std::string> rows = lines(to_csv(table()));
  ASSERT_EQ(rows.size(), 1 + 3 * 2u);
  EXPECT_THAT(rows[0],
              ::testing::StartsWith("object,size_m,pilot,throws,would_have_hit,dodged,rate,"
                                    "rate_lo,rate_hi,rate_interval,would_have_hit_rate,"
                                    "would_have_hit_rate_lo,would_have_hit_rate_hi,errors,"));
  const auto commas = std::count(rows[0].begin(), rows[0].end(), ',');
  for (std::size_t i = 3; i < rows.size(); ++i) {
    EXPECT_EQ(std::count(rows[i].begin(), rows[i].end(), ','), commas) << rows[i];
  }
  EXPECT_THAT(rows[3], ::testing::StartsWith("ball,0.2,falanga2020,1,1,0,0,"));
  EXPECT_THAT(rows[3], ::testing::EndsWith(",0,,,,,"));  // a sample of nothing
}

TEST(TableFormats, WhatIsNotKnownOfThePilotNoneAndOfNoTrialIsEmpty) {
  const std::vector<std::string> rows = lines(to_csv(table()));
  const std::vector<std::string> head = cells(rows[0]), flown = cells(rows[3]),
                                 none = cells(rows[4]);
  const auto at = [&](const std::vector<std::string>& row, const std::string& column) {
    return row.at(static_cast<std::size_t>(std::ranges::find(head, column) - head.begin()));
  };
  EXPECT_EQ(at(flown, "in_view"), "0");
  for (const char* end : {"detection_rate", "detection_rate_lo", "detection_rate_hi"}) {
    EXPECT_EQ(at(flown, end), "") << end;
  }
  ASSERT_EQ(at(none, "pilot"), "none");
  for (const char* count : {"in_view", "detected", "false_alarms", "false_alarm_rate_lo"}) {
    EXPECT_EQ(at(none, count), "") << count;
  }
}

TEST(TableFormats, JsonIsValidAndHasNullForTheUnknown) {
  const auto json = parse_json(to_json(table()));
  ASSERT_EQ(json.size(), 3u);
  EXPECT_EQ(json[1]["pilots"][0]["dodged"]["rate"], 0);
  EXPECT_EQ(json[1]["pilots"][0]["dodged"]["of"], 1);
  EXPECT_TRUE(json[1]["detected"]["rate"].is_null());
  EXPECT_TRUE(json[1]["detected"]["lo"].is_null());
  EXPECT_TRUE(json[1]["time_to_contact_s"]["q50"].is_null());
  EXPECT_TRUE(json[1]["pilots"][0]["clearance_m"]["q50"]["hi"].is_null());  // unbounded
  EXPECT_EQ(json[2]["causes"]["seen late"], 1);
}

TEST(TableFormats, APilotOfTheSweepHasOneRowWhateverFlewBesideIt) {
  std::vector<ThrowResult> results;
  for (const char* pilot : {"falanga2020", "oracle", "none"}) {
    ThrowResult& result = results.emplace_back(ball(0, 0.1, 2, 4));
    result.sweep = static_cast<int>(results.size()) - 1;
    result.sweep_values = {{"pilot", pilot}};
    result.flown = result.oracle = result.none = flown(true);
  }
  const StatisticsTable swept = group_by(parts_of(results, "falanga2020"), {});
  std::vector<std::string> pilots;
  for (const std::string& row : lines(to_csv(swept))) {
    pilots.push_back(cells(row)[0] + " " + cells(row)[1]);
  }
  EXPECT_THAT(pilots,
              ::testing::ElementsAre("sweep_pilot pilot", "falanga2020 falanga2020",
                                     "falanga2020 oracle", "falanga2020 none", "oracle oracle",
                                     "oracle none", "none none", "none oracle"));
  EXPECT_EQ(parse_json(to_json(swept))[1]["pilots"].size(), 2u);
}

// Of two throws that none flew, one would have hit; of a third its flight failed.
TEST(TableFormats, TheRowOfThePilotNoneSaysHowManyWouldHaveHit) {
  std::vector<ThrowResult> results = {ball(0, 0.1, 2, 4), ball(1, 0.1, 2, 4), ball(2, 0.1, 2, 4)};
  for (ThrowResult& result : results) result.flown = flown(false);
  results[0].none = flown(true);
  results[1].none = flown(false);
  results[2].none = failed("diverged");
  const StatisticsTable grouped = group_by(parts_of(results, "falanga2020"), {});
  const Interval share = wilson(1, 2), undodged = wilson(0, 1);
  const auto json = parse_json(to_json(grouped))[0]["pilots"][1];
  EXPECT_EQ(json["pilot"], "none");
  EXPECT_EQ(json["would_have_hit_rate"]["count"], 1);
  EXPECT_EQ(json["would_have_hit_rate"]["of"], 2);
  EXPECT_EQ(json["would_have_hit_rate"]["hi"], share.hi);
  EXPECT_EQ(json["dodged"]["of"], 1);
  EXPECT_EQ(json["dodged"]["hi"], undodged.hi);
  const std::vector<std::string> rows = lines(to_csv(grouped));
  ASSERT_EQ(rows.size(), 3u);
  const auto cell = [&](const std::string& name) {
    const std::vector<std::string> names = cells(rows[0]);
    const auto at = std::find(names.begin(), names.end(), name);
    return at == names.end() ? "no column " + name
                             : cells(rows[2])[static_cast<std::size_t>(at - names.begin())];
  };
  EXPECT_EQ(cell("pilot"), "none");
  EXPECT_EQ(cell("would_have_hit"), "1");
  EXPECT_EQ(cell("dodged"), "0");
  EXPECT_EQ(cell("rate_hi"), to_text(undodged.hi));
  EXPECT_EQ(cell("would_have_hit_rate"), "0.5");
  EXPECT_EQ(cell("would_have_hit_rate_lo"), to_text(share.lo));
}

TEST(TableFormats, LatexIsEscaped) {
  const std::string latex = to_latex(table());
  EXPECT_THAT(latex, HasSubstr("\\begin{tabular}{lllllll}\n  \\toprule\n"));
  EXPECT_THAT(latex, HasSubstr("  a\\_b \\& \"c\" \\textbar{} \\textbackslash{} 50\\%, "));
  EXPECT_THAT(latex, HasSubstr("  object & size\\_m & falanga2020: dodged & "));
  EXPECT_EQ(lines(latex).size(), 2 * (2 + 1 + 1 + 3 + 2) + 1u);
}

TEST(TableFormats, LatexKeepsKeysAndValuesOfAGridAsTheyAre) {
  std::vector<ThrowResult> results = {ball(0, 0.1, 2, 4)};
  results[0].cell_values = {{"throw.aim_offset_m", "[0, 1]"}, {"a#b$c{d}~^", "<x> *"}};
  const std::string latex =
      to_latex(group_by(parts_of(results, "falanga2020"), grid_axes(results)));
  EXPECT_THAT(latex, HasSubstr("  throw.aim\\_offset\\_m & a\\#b\\$c\\{d\\}\\~{}\\^{} & "));
  // A row that began with "[" would be the length by which \\ of the row before skips.
  EXPECT_THAT(latex, HasSubstr("\n  {[}0, 1] & \\textless{}x\\textgreater{} {*} & "));
}

TEST(TableFormats, MarkdownKeepsItsColumns) {
  const std::vector<std::string> rows = lines(to_markdown(table()));
  EXPECT_EQ(rows[0],
            "| object | size_m | falanga2020: dodged | none: would have hit | hit or crashed | "
            "detected, of those in view | false alarms |");
  EXPECT_THAT(rows[2], HasSubstr("\\| \\ 50%"));
  EXPECT_THAT(rows[3], HasSubstr("| ball | 0.2 | 0 / 1 (0.000, 0.000 to 0.793) | 1 / 1 "));
}

}  // namespace
}  // namespace dodgesim

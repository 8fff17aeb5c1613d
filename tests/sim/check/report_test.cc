// Lines, comparison of event streams, plots and the report.
#include "sim/check/report.h"

#include <gtest/gtest.h>

#include <cmath>

#include "sim/check/compare_events.h"

namespace dodgesim {
namespace {

TEST(CheckLine, IsOkWithinItsLimitsAndFailsOtherwise) {
  Check check;
  check.within("a", 1.1, 1, 0.11, "us", 2);
  check.within("b", 1.1, 1, 0.09, "us", 2);
  check.within("c", NAN, 1, 1e9, "us", 2);
  check.between("d", 3, 3, 4, "", 0);
  check.between("e", 4.1, 3, 4, "", 0);
  check.between("f", NAN, 3, 4, "", 0);
  std::vector<Outcome> outcomes;
  for (const CheckLine& line : check.lines) outcomes.push_back(line.outcome);
  using enum Outcome;
  EXPECT_EQ(outcomes, (std::vector<Outcome>{kOk, kFail, kFail, kOk, kFail, kFail}));
  EXPECT_TRUE(check.failed());
}

TEST(CheckLine, HasNameMeasuredExpectedAndOutcome) {
  Check check;
  check.within("a.b", 1.25, 1, 0.5, "us", 2);
  check.off("c", "it is off");
  const std::string text = line_text(check.lines.front());
  EXPECT_EQ(text.find("a.b"), 0u);
  EXPECT_NE(text.find("1.25 us"), std::string::npos);
  EXPECT_NE(text.find("1.00 +- 0.50 us"), std::string::npos);
  EXPECT_TRUE(text.ends_with(" ok"));
  EXPECT_TRUE(line_text(check.lines.back()).ends_with("it is off                         off"));
  EXPECT_FALSE(check.failed());
}

std::vector<Event> stream(std::initializer_list<Event> events) { return events; }

TEST(CompareEvents, PairsEventsOfAPixelInOrder) {
  const auto reference = stream({{10, 1, 1, 1}, {12, 2, 1, -1}, {20, 1, 1, 1}, {30, 1, 1, -1}});
  const auto events = stream({{13, 1, 1, 1}, {14, 2, 1, -1}, {21, 1, 1, 1}, {37, 1, 1, -1}});
  const EventDifference same = compare(events, reference);
  EXPECT_EQ(same.count_ratio, 1);
  EXPECT_EQ(same.matched, 1);
  EXPECT_EQ(same.median_us, 2);  // of 1, 2, 3, 7, the lower middle
  EXPECT_EQ(compare(reference, reference).percentile_90_us, 0);
}

TEST(CompareEvents, PairsFromBothEndsWhereAnEventIsMissing) {
  const auto reference =
      stream({{10, 1, 1, 1}, {20, 1, 1, -1}, {30, 1, 1, 1}, {40, 1, 1, -1}, {50, 3, 3, 1}});
  const auto events = stream({{10, 1, 1, 1}, {30, 1, 1, 1}, {40, 1, 1, -1}});
  const EventDifference difference = compare(events, reference);
  EXPECT_DOUBLE_EQ(difference.count_ratio, 0.6);
  EXPECT_DOUBLE_EQ(difference.matched, 0.6);
  EXPECT_EQ(difference.percentile_90_us, 0);
}

TEST(CompareEvents, HasNoPartnersInDifferentPixelsOrPolarities) {
  const auto reference = stream({{10, 1, 1, 1}, {10, 2, 1, 1}});
  EXPECT_EQ(compare(stream({{10, 1, 1, -1}, {10, 1, 2, 1}}), reference).matched, 0);
  EXPECT_TRUE(std::isnan(compare({}, reference).median_us));
}

TEST(Plot, HistogramHoldsTheShareOfEachBin) {
  const Series bars = histogram("", 0, {0.1, 0.1, 0.4, 0.9, 1.0, -0.1}, 0, 1, 2);
  EXPECT_EQ(bars.x, (std::vector<double>{0.25, 0.75}));
  EXPECT_DOUBLE_EQ(bars.y[0], 0.5);
  EXPECT_DOUBLE_EQ(bars.y[1], 1.0 / 6);
}

// Pixels that are neither grey nor white.
int coloured(const cv::Mat3b& image) {
  int count = 0;
  for (const cv::Vec3b& p : image) count += std::abs(p[0] - p[2]) > 40 ? 1 : 0;
  return count;
}

TEST(Plot, DrawsBarsAsHighAsTheirValues) {
  const Series bars{"", Series::Kind::kBars, 0, {0.5, 1.5}, {1, 2}};
  const cv::Mat3b image = draw({"", {"", 0, 2, false}, {"", 0, 2, false}, {bars}});
  const int middle = image.cols / 2 + 32;  // the frame is not in the middle
  const int left = coloured(image.colRange(0, middle));
  const int right = coloured(image.colRange(middle, image.cols));
  EXPECT_NEAR(left, 0.5 * right, 0.02 * right);
}

TEST(Plot, DrawsNothingThatIsNoNumberOrNotPositiveOnALogarithmicAxis) {
  const Series points{"", Series::Kind::kPoints, 1, {1, 2, 3}, {NAN, 0, -1}};
  EXPECT_EQ(coloured(draw({"", {"", 0, 4, false}, {"", 0.1, 10, true}, {points}})), 0);
  EXPECT_EQ(coloured(draw({"", {"", 0, 0, false}, {"", 0, 0, false}, {}})), 0);
}

TEST(Report, HoldsEveryLineAndPlotInOnePage) {
  Check check{"A <title>", "How & why"};
  check.within("one.line", 2, 1, 0.5, "us", 1);
  check.plots.push_back({"A plot", {"x", 0, 1, false}, {"y", 0, 1, false}, {}});
  const std::string html = html_report("camera.yaml", {check});
  for (const char* text : {"A &lt;title&gt;", "How &amp; why", "one.line", "2.0 us", "FAIL",
                           "camera.yaml", "data:image/png;base64,iVBOR"}) {
    EXPECT_NE(html.find(text), std::string::npos) << text;
  }
  EXPECT_EQ(html.find("http"), std::string::npos);  // nothing is loaded from elsewhere
}

}  // namespace
}  // namespace dodgesim

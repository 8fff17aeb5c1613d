#include "sim/campaign/tables.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/sim/campaign/fake_throws.h"

namespace dodgesim {
namespace {

using testing::HasSubstr;

ThrowResult throw_with(int index, const FlightResult& pilot, const FlightResult& none,
                       const FlightResult& oracle) {
  ThrowResult result = ball(index, 0.1, 2, 4);
  result.flown = pilot;
  result.none = none;
  result.oracle = oracle;
  return result;
}

Tables tables(const std::vector<ThrowResult>& results) {
  return make_tables(results, "test", "falanga2020");
}

TEST(Tally, OnlyAnUnharmedFlightThroughADangerousThrowIsADodge) {
  Tally sum;
  sum.add(flown(false), flown(true));        // dodged
  sum.add(flown(true), flown(true));         // hit
  sum.add(flown(false, true), flown(true));  // dodged into the wall
  sum.add(flown(false), flown(false));       // would have missed
  EXPECT_EQ(sum.throws, 4);
  EXPECT_EQ(sum.would_have_hit, 3);
  EXPECT_EQ(sum.dodged, 1);
  EXPECT_EQ(sum.errors, 0);
}

TEST(Tally, AnErrorNeverCountsAsASuccess) {
  Tally sum;
  sum.add(failed("diverged"), flown(true));   // counts as not dodged
  sum.add(flown(false), failed("diverged"));  // would it have hit? unknown: not judged
  sum.add(FlightResult{}, flown(true));       // not flown: not judged
  EXPECT_EQ(sum.throws, 1);
  EXPECT_EQ(sum.would_have_hit, 1);
  EXPECT_EQ(sum.dodged, 0);
  EXPECT_EQ(sum.errors, 2);
}

TEST(Bins, AFewRoundValuesStandForThemselves) {
  const std::vector<Bin> bins = make_bins({0.3, 0.1, 0.1, 0.2}, 0.1);
  ASSERT_EQ(bins.size(), 3u);
  EXPECT_EQ(bins[0].text(), "0.1");
  EXPECT_TRUE(bins[0].contains(0.1));
  EXPECT_FALSE(bins[0].contains(0.10001));
}

TEST(Bins, DrawnValuesFallIntoHalfOpenBins) {
  const std::vector<Bin> bins = make_bins({2.21345678, 4.0, 3.99999}, 1);
  ASSERT_EQ(bins.size(), 3u);
  EXPECT_EQ(bins[0].text(), "2 to 3");
  EXPECT_EQ(bins[2].text(), "4 to 5");
  EXPECT_TRUE(bins[2].contains(4.0));
  EXPECT_FALSE(bins[1].contains(4.0));
}

TEST(Bins, EveryValueIsInExactlyOneBin) {
  std::vector<double> values;
  for (int i = 0; i < 1000; ++i) values.push_back(0.01 + 0.00099 * i);
  for (int i = 1; i < 10; ++i) values.push_back(0.1 * i);
  const std::vector<Bin> bins = make_bins(values, 0.1);
  for (const double value : values) {
    int count = 0;
    for (const Bin& bin : bins) count += bin.contains(value) ? 1 : 0;
    EXPECT_EQ(count, 1) << value;
  }
}

TEST(Rate, CarriesItsCountAndInterval) {
  EXPECT_EQ(rate_text(92, 100), "92 / 100 (0.920, 0.850 to 0.959)");
  EXPECT_EQ(rate_text(0, 0), "0 / 0");
}

TEST(Tables, MarkdownAndCsvAreAsExpected) {
  std::vector<ThrowResult> results;
  results.push_back(throw_with(0, flown(false), flown(true), flown(false)));
  results.push_back(throw_with(1, flown(true), flown(true), flown(false)));
  results[1].size_m = 0.2;
  results.push_back(throw_with(2, flown(false), flown(false), flown(false)));
  results[2].evaded = true;
  const Tables made = tables(results);
  EXPECT_EQ(made.markdown, R"(# test

3 throws, pilot falanga2020. Cells: dodged / would have hit (rate, 95 % Wilson interval); for the pilot none: would have hit / throws.

Dodged: 1 / 2 (0.500, 0.095 to 0.905)

## By size and distance

| size | pilot | 2 m | all distances |
|---|---|---|---|
| 0.1 m | falanga2020 | 1 / 1 (1.000, 0.207 to 1.000) | 1 / 1 (1.000, 0.207 to 1.000) |
| 0.1 m | oracle | 1 / 1 (1.000, 0.207 to 1.000) | 1 / 1 (1.000, 0.207 to 1.000) |
| 0.1 m | none: would have hit | 1 / 2 (0.500, 0.095 to 0.905) | 1 / 2 (0.500, 0.095 to 0.905) |
| 0.2 m | falanga2020 | 0 / 1 (0.000, 0.000 to 0.793) | 0 / 1 (0.000, 0.000 to 0.793) |
| 0.2 m | oracle | 1 / 1 (1.000, 0.207 to 1.000) | 1 / 1 (1.000, 0.207 to 1.000) |
| 0.2 m | none: would have hit | 1 / 1 (1.000, 0.207 to 1.000) | 1 / 1 (1.000, 0.207 to 1.000) |
| all | falanga2020 | 1 / 2 (0.500, 0.095 to 0.905) | 1 / 2 (0.500, 0.095 to 0.905) |
| all | oracle | 2 / 2 (1.000, 0.342 to 1.000) | 2 / 2 (1.000, 0.342 to 1.000) |
| all | none: would have hit | 2 / 3 (0.667, 0.208 to 0.939) | 2 / 3 (0.667, 0.208 to 0.939) |

## By speed

| speed | falanga2020 | oracle | none: would have hit |
|---|---|---|---|
| 4 m/s | 1 / 2 (0.500, 0.095 to 0.905) | 2 / 2 (1.000, 0.342 to 1.000) | 2 / 3 (0.667, 0.208 to 0.939) |

Of 1 throw that would have missed, falanga2020 evaded 1 and was hit by 0.

)");
  EXPECT_THAT(made.csv, testing::StartsWith("sweep,size_m,distance_m,speed_mps,pilot,throws,"
                                            "would_have_hit,dodged,rate,rate_lo,rate_hi,errors\n"
                                            "0,0.1,2,all,falanga2020,2,1,1,1,"));
  EXPECT_THAT(made.csv, HasSubstr("\n0,all,all,all,falanga2020,3,2,1,0.5,"));
  EXPECT_THAT(made.csv, HasSubstr("\n0,all,all,4,none,3,2,0,0,"));
}

TEST(Tables, WithoutOracleThereIsNoRowOfIt) {
  const Tables made = tables({throw_with(0, flown(false), flown(true), FlightResult{})});
  EXPECT_THAT(made.markdown, testing::Not(HasSubstr("oracle")));
}

TEST(Tables, ErrorsAreShownWithThrowPilotAndReason) {
  const Tables made =
      tables({throw_with(0, failed("The state diverged."), flown(true), flown(true)),
              throw_with(1, flown(false), flown(true), failed("No context."))});
  EXPECT_THAT(made.markdown, HasSubstr("| 1 / 2 (0.500, 0.095 to 0.905), 1 errors |"));
  EXPECT_THAT(made.markdown, HasSubstr("2 flights failed and count as no success:\n\n"
                                       "- throw 0, pilot falanga2020: The state diverged.\n"
                                       "- throw 1, pilot oracle: No context.\n"));
}

TEST(Tables, EvasionsOfQuietFlightsAreFalseAlarms) {
  ThrowResult quiet;
  quiet.flown = flown(false);
  std::vector<ThrowResult> results(4, quiet);
  results[2].evaded = true;
  const Tables made = tables(results);
  EXPECT_THAT(made.markdown, HasSubstr("False alarms: falanga2020 evaded in 1 / 4 (0.250, "));
  EXPECT_THAT(made.markdown, testing::Not(HasSubstr("By size")));
}

}  // namespace
}  // namespace dodgesim

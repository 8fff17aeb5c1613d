#include "sim/gate/outcomes.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "sim/base/error.h"
#include "tests/sim/gate/outcomes_fixture.h"

namespace dodgesim {
namespace {

using ::testing::HasSubstr;
using testing::quiet_flight_that;
using testing::tables_of;
using testing::throw_that;
using ::testing::ThrowsMessage;

ObjectRow object_row(int throw_index, int object) {
  ObjectRow row;
  row.throw_index = throw_index;
  row.object = object;
  row.kind = "ball";
  row.speed_mps = 5 + object;
  row.bearing_deg = -11.25;
  return row;
}

ThrowResult throw_of_two(int index) {
  ThrowResult result = throw_that(index, 'd');
  result.objects = 2;
  result.object_rows = {object_row(index, 0), object_row(index, 1)};
  return result;
}

bool same(const ThrowResult& a, const ThrowResult& b) {
  return same_throw(outcomes(tables_of({a})).at(0), outcomes(tables_of({b})).at(0));
}

TEST(Outcomes, SayWhatBecameOfAThrow) {
  const auto all = outcomes(tables_of("dhcem"));
  ASSERT_EQ(all.size(), 5U);
  EXPECT_EQ(all[0].what, "dodged");
  EXPECT_EQ(all[1].what, "hit");
  EXPECT_EQ(all[2].what, "crashed");
  EXPECT_EQ(all[3].what, "error: killed, \"by\" signal 9");
  for (const ThrowOutcome& t : all) {
    EXPECT_EQ(t.success, t.number == 0 || t.number == 4) << t.number;
    EXPECT_EQ(t.counts, t.number != 4) << "a throw that would have missed counts for nothing";
  }
  EXPECT_EQ(all[1].label, "0.2 m ball, 5.01 m/s from 3 m");
}

TEST(Outcomes, SayWhichSettingsOfGridAndSweepAThrowHad) {
  ThrowResult result = throw_that(3, 'd');
  result.cell = 1;
  result.cell_values = {{"throw.size_m", "0.30"}};
  result.sweep_values = {{"pilot", "oracle"}};
  CsvLine line;
  result.visit(line);
  const auto all = outcomes({CsvTable(line.header() + line.row(), "throws.csv")});
  ASSERT_EQ(all.size(), 1U);
  EXPECT_EQ(all[0].cell, 1);
  EXPECT_EQ(all[0].settings,
            (std::vector<AxisValue>{{"throw.size_m", "0.3"}, {"pilot", "oracle"}}));
}

TEST(Outcomes, OfQuietFlightsFailByEvading) {
  const auto all = outcomes(tables_of({quiet_flight_that(0, false), quiet_flight_that(1, true)}));
  EXPECT_TRUE(all[0].counts && all[0].success);
  EXPECT_TRUE(all[1].counts && !all[1].success);
}

TEST(Outcomes, ALandingBeforeTheObjectCameIsNoSuccess) {
  ThrowResult before = throw_that(0, 'd'), after = throw_that(1, 'd'), hit = throw_that(2, 'h');
  for (ThrowResult* result : {&before, &after, &hit}) {
    result->none.hit_us = 1500000;
    result->landing_us = 1400000;
  }
  after.landing_us = 1600000;
  ThrowResult quiet = quiet_flight_that(3, false);
  quiet.landing_us = 1400000;
  const auto all = outcomes(tables_of({before, after, hit, quiet}));
  EXPECT_EQ(all[0].what, "landed");
  EXPECT_EQ(all[1].what, "dodged");
  EXPECT_EQ(all[2].what, "hit");
  EXPECT_EQ(all[3].what, "landed");
  for (const ThrowOutcome& t : all) {
    EXPECT_TRUE(t.counts);
    EXPECT_EQ(t.success, t.number == 1) << t.number;
  }
}

TEST(Outcomes, WhereNobodyKnowsWhetherItWouldHaveHitThereIsNoDodge) {
  ThrowResult result = throw_that(0, 'd');
  result.none = {};
  result.none.status = "error";
  result.none.error = "diverged";
  const auto all = outcomes(tables_of({result}));
  EXPECT_EQ(all[0].what, "not judged: diverged");
  EXPECT_TRUE(all[0].counts);
  EXPECT_FALSE(all[0].success);
}

TEST(Outcomes, RefuseTablesThatAreNotOfACampaign) {
  const auto refusal = [](const CampaignTables& tables) { return [tables] { outcomes(tables); }; };
  CampaignTables tables = tables_of({throw_that(1, 'd'), throw_that(0, 'd')});
  EXPECT_THAT(refusal(tables),
              ThrowsMessage<IoError>(HasSubstr("throws.csv: throw 0 stands behind throw 1.")));
  EXPECT_THROW(outcomes(tables_of({throw_that(0, 'd'), throw_that(0, 'd')})), IoError);
  ThrowResult damaged = throw_that(0, 'd');
  damaged.flown.status = "okk";
  EXPECT_THAT(refusal(tables_of({damaged})),
              ThrowsMessage<IoError>(HasSubstr("throws.csv:2: flown_status is \"okk\", not ok, "
                                               "error, lost or not flown.")));
  tables = tables_of({throw_of_two(0)});
  tables.objects.reset();
  EXPECT_THAT(
      refusal(tables),
      ThrowsMessage<IoError>(HasSubstr("throw 0 has 2 objects, but objects.csv beside it has 0")));
}

TEST(SameThrow, IsWhateverBecomesOfIt) {
  EXPECT_TRUE(same(throw_that(0, 'd'), throw_that(0, 'm')));
}

TEST(SameThrow, DependsOnEverythingThatWasDrawn) {
  const std::function<void(ThrowResult&)> changes[] = {
      [](ThrowResult& t) { t.object = "box"; },
      [](ThrowResult& t) { t.size_m += 1e-6; },
      [](ThrowResult& t) { t.speed_mps += 1e-6; },
      [](ThrowResult& t) { t.distance_m += 1e-6; },
      [](ThrowResult& t) { t.bearing_deg += 1e-6; },
      [](ThrowResult& t) { t.aim_offset_m[1] += 1e-6; },
      [](ThrowResult& t) { t.spin_radps[2] += 1e-6; },
      [](ThrowResult& t) { t.launch_height_m += 1e-6; },
      [](ThrowResult& t) { t.launch_us += 1; },
      [](ThrowResult& t) { t = throw_of_two(0); },
      [](ThrowResult& t) { t = quiet_flight_that(0, false); }};
  for (const auto& change : changes) {
    ThrowResult other = throw_that(0, 'd');
    change(other);
    EXPECT_FALSE(same(throw_that(0, 'd'), other)) << &change - changes;
  }
}

TEST(Outcomes, CountThrowsWithinTheirSweepValue) {
  std::vector<ThrowResult> results;
  for (const int number : {1, 4, 7, 10}) {  // shard 1 of 3 of three sweep values with four throws
    results.push_back(throw_that(number, 'd'));
    results.back().sweep = number / 4;
  }
  CampaignTables tables = tables_of(results);
  tables.planned = 12;
  tables.sweep_values = 3;
  const auto all = outcomes(tables);
  ASSERT_EQ(all.size(), 4U);
  EXPECT_EQ(all[0].stream, 1);
  EXPECT_EQ(all[1].stream, 0);
  EXPECT_EQ(all[2].stream, 3);
  EXPECT_EQ(all[3].stream, 2);
}

TEST(DifferingDraws, NameWhatDiffers) {
  const auto differing = [](const ThrowResult& a, const ThrowResult& b) {
    return differing_draws(outcomes(tables_of({a})).at(0), outcomes(tables_of({b})).at(0));
  };
  ThrowResult other = throw_that(0, 'd');
  other.object = "box";
  other.launch_height_m += 1;
  other.size_m += 1;
  EXPECT_THAT(differing(throw_that(0, 'd'), other),
              ::testing::ElementsAre("object", "size_m", "launch_height_m"));
  EXPECT_THAT(differing(throw_that(0, 'd'), throw_of_two(0)),
              ::testing::ElementsAre("number of objects"));
}

TEST(SameThrow, DependsOnEveryObject) {
  EXPECT_TRUE(same(throw_of_two(0), throw_of_two(0)));
  ThrowResult other = throw_of_two(0);
  other.object_rows[1].bearing_deg += 1e-6;
  EXPECT_FALSE(same(throw_of_two(0), other));
  other = throw_of_two(0);
  other.object_rows[1].kind = "box";
  EXPECT_FALSE(same(throw_of_two(0), other));
}

TEST(SameThrow, ReadsTheObjectsOfEachThrow) {
  ThrowResult other = throw_of_two(2);
  other.object_rows[0].size_m += 1;
  const auto a = outcomes(tables_of({throw_of_two(0), throw_that(1, 'd'), throw_of_two(2)}));
  const auto b = outcomes(tables_of({throw_of_two(0), throw_that(1, 'd'), other}));
  EXPECT_TRUE(same_throw(a[0], b[0]));
  EXPECT_TRUE(same_throw(a[1], b[1]));
  EXPECT_FALSE(same_throw(a[2], b[2]));
}

TEST(SameThrow, HasTheSameSeedAsFarAsItIsKnown) {
  const auto with_seed = [](std::optional<std::uint64_t> seed) {
    CampaignTables tables = tables_of({throw_of_two(0)});
    tables.seed = seed;
    return outcomes(tables).at(0);
  };
  EXPECT_TRUE(same_throw(with_seed(3), with_seed(3)));
  EXPECT_FALSE(same_throw(with_seed(3), with_seed(4)));
  EXPECT_TRUE(same_throw(with_seed(3), with_seed(std::nullopt)));
}

// As another libm rounds.
TEST(SameThrow, DoesNotDependOnTheLastDigits) {
  ThrowResult a = throw_of_two(0), b = throw_of_two(0);
  b.speed_mps = std::nextafter(a.speed_mps, 10);
  a.aim_offset_m[0] = 1e-17;  // what is left of a difference
  b.aim_offset_m[0] = -3e-17;
  b.object_rows[1].bearing_deg = std::nextafter(a.object_rows[1].bearing_deg, 0);
  EXPECT_TRUE(same(a, b));
}

}  // namespace
}  // namespace dodgesim

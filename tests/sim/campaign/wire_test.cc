#include "sim/campaign/wire.h"

#include <gtest/gtest.h>

#include "sim/base/error.h"
#include "sim/files/csv.h"
#include "tests/sim/tables/fake_throws.h"

namespace dodgesim {
namespace {

ThrowResult full_result() {
  ThrowResult result = ball(7, 0.1, 2.5, 4);
  result.flown = flown(true);
  result.none = failed("It broke, \"badly\".");
  result.first_detection_us = 1234567;
  result.first_detection_distance_m = 1.4142135623730951;
  result.events = {123456789012, 5};
  result.events_lost = {3, 4};
  result.events_hash = 0xfedcba9876543210;
  result.wall_s = 1.25;
  DetectionRow row;
  row.throw_index = 7;
  row.p_W = {1, 2, 3};
  row.object = 0;
  row.true_p_W = {1.5, 2.5, 3.5};
  result.detection_rows = {row, DetectionRow{}};
  result.truth_rows = {{7, 500000, true, {100, 40, 20, 10}}, {7, 504000, false, {9, 0, 0, 0}}};
  return result;
}

TEST(Wire, AResultArrivesAsItWasSent) {
  const ThrowResult sent = full_result();
  const ThrowResult received = result_from_bytes(to_bytes(sent));
  EXPECT_EQ(csv_row(received), csv_row(sent));
  EXPECT_EQ(received.wall_s, sent.wall_s);
  ASSERT_EQ(received.detection_rows.size(), 2u);
  EXPECT_EQ(csv_row(received.detection_rows[0]), csv_row(sent.detection_rows[0]));
  EXPECT_FALSE(received.detection_rows[1].true_p_W.has_value());
  ASSERT_EQ(received.truth_rows.size(), 2u);
  EXPECT_EQ(csv_row(received.truth_rows[0]), "7,500000,1,100,40,20,10,0.5,0.25\n");
  EXPECT_EQ(csv_row(received.truth_rows[1]), "7,504000,0,9,0,0,0,,\n");
}

TEST(Wire, AnIncompleteResultIsNoticedAtEveryLength) {
  const std::string bytes = to_bytes(full_result());
  for (std::size_t n = 0; n < bytes.size(); ++n) {
    EXPECT_THROW(result_from_bytes(bytes.substr(0, n)), IoError) << n;
  }
  EXPECT_THROW(result_from_bytes(bytes + "x"), IoError);
}

}  // namespace
}  // namespace dodgesim

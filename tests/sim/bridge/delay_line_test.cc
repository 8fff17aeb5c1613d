#include "sim/bridge/delay_line.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <vector>

namespace dodgesim {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

std::vector<int> received(DelayLine<int>& line, TimeUs now_us) {
  std::vector<int> out;
  line.deliver(now_us, [&](int item) { out.push_back(item); });
  return out;
}

TEST(DelayLine, DeliversExactlyWhenTheDelayHasPassed) {
  DelayLine<int> line(3500);
  line.push(1000, 7);
  EXPECT_THAT(received(line, 4499), IsEmpty());
  EXPECT_THAT(received(line, 4500), ElementsAre(7));
  EXPECT_THAT(received(line, 9000), IsEmpty());
}

TEST(DelayLine, KeepsTheOrderOfSending) {
  DelayLine<int> line(100);
  for (int i = 0; i < 3; ++i) line.push(10 * i, i);
  EXPECT_THAT(received(line, 110), ElementsAre(0, 1));
  EXPECT_THAT(received(line, 1000), ElementsAre(2));
}

TEST(DelayLine, LetsNothingOvertake) {
  DelayLine<int> line(100);
  line.push(500, 1);
  line.push(200, 2);  // stamped earlier, sent later
  EXPECT_THAT(received(line, 599), IsEmpty());
  EXPECT_THAT(received(line, 600), ElementsAre(1, 2));
}

}  // namespace
}  // namespace dodgesim

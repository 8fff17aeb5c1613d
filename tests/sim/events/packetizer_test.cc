#include "sim/events/packetizer.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <stdexcept>
#include <utility>

#include "sim/base/random.h"

namespace dodgesim {
namespace {

Event at(TimeUs t_us) { return {t_us, 1, 2, 1}; }

TEST(Packetizer, APacketHoldsTheEventsUpToAndIncludingItsEnd) {
  Packetizer packets(1000);
  packets.push(std::vector<Event>{at(1), at(999), at(1000), at(1001), at(2000)}, 2000);
  const auto first = packets.take();
  ASSERT_TRUE(first);
  EXPECT_EQ(first->end_us, 1000);
  EXPECT_EQ(first->events.size(), 3u);
  const auto second = packets.take();
  ASSERT_TRUE(second);
  EXPECT_EQ(second->end_us, 2000);
  EXPECT_EQ(second->events.size(), 2u);
  EXPECT_FALSE(packets.take());
  packets.push(std::vector<Event>{at(3000)}, 3000);
  EXPECT_EQ(packets.take()->end_us, 3000);
}

TEST(Packetizer, APacketCannotBeTakenBeforeAllItsEventsAreKnown) {
  Packetizer packets(1000);
  packets.push(std::vector<Event>{at(300)}, 999);
  EXPECT_FALSE(packets.take());
  packets.push(std::vector<Event>{at(1000)}, 1250);
  const auto packet = packets.take();
  ASSERT_TRUE(packet);
  EXPECT_EQ(packet->events.size(), 2u);
}

TEST(Packetizer, CausesStayWithTheirEvents) {
  Packetizer packets(1000);
  packets.push(std::vector<Event>{at(1), at(999), at(1001)}, 1500, std::vector<Cause>{3, 4, 5});
  auto packet = packets.take();
  ASSERT_TRUE(packet);
  EXPECT_EQ(std::vector<Cause>(packet->causes.begin(), packet->causes.end()),
            (std::vector<Cause>{3, 4}));
  packets.push(std::vector<Event>{at(2000)}, 2000, std::vector<Cause>{6});
  packet = packets.take();
  ASSERT_TRUE(packet);
  EXPECT_EQ(packet->events.size(), 2u);
  EXPECT_EQ(std::vector<Cause>(packet->causes.begin(), packet->causes.end()),
            (std::vector<Cause>{5, 6}));
  Packetizer without(1000);
  without.push(std::vector<Event>{at(1)}, 1000);
  EXPECT_TRUE(without.take()->causes.empty());
}

TEST(Packetizer, EmptyPeriodsMakeNoPacket) {
  Packetizer packets(1000);
  packets.push({}, 5000);
  EXPECT_FALSE(packets.take());
  packets.push(std::vector<Event>{at(7500)}, 9000);
  EXPECT_EQ(packets.take()->end_us, 8000);
  EXPECT_FALSE(packets.take());
}

TEST(Packetizer, HowTheStreamIsSampledDoesNotChangeThePackets) {
  RandomStream random(1, 0, "packets");
  std::vector<Event> events;
  for (int i = 0; i < 2000; ++i) events.push_back(at(static_cast<TimeUs>(random.uniform(1, 1e5))));
  std::sort(events.begin(), events.end(), [](auto& a, auto& b) { return a.t_us < b.t_us; });
  const auto collect = [&](TimeUs step_us) {
    Packetizer packets(1000);
    std::vector<std::pair<TimeUs, std::vector<Event>>> out;
    std::size_t next = 0;
    for (TimeUs t = step_us; t < 100000 + step_us; t += step_us) {
      const std::size_t first = next;
      while (next < events.size() && events[next].t_us <= t) ++next;
      packets.push(std::span(events).subspan(first, next - first), t);
      while (const auto packet = packets.take()) {
        out.emplace_back(packet->end_us,
                         std::vector<Event>(packet->events.begin(), packet->events.end()));
      }
    }
    return out;
  };
  const auto expected = collect(1000);
  EXPECT_EQ(expected.size(), 100u);
  for (const TimeUs step_us : {250, 730, 5000}) EXPECT_EQ(collect(step_us), expected);
}

TEST(Packetizer, RefusesAPeriodThatIsNotPositive) {
  EXPECT_THROW(Packetizer(0), std::invalid_argument);
}

}  // namespace
}  // namespace dodgesim

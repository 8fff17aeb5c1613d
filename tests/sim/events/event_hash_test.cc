#include "sim/events/event_hash.h"

#include <gtest/gtest.h>
#include <xxhash.h>

#include <cstring>
#include <vector>

namespace dodgesim {
namespace {

const std::vector<Event> kEvents = {{12, 3, 4, 1}, {13, 319, 239, -1}, {5000000000, 0, 65535, 1}};

TEST(EventHash, IsTheHashOfTheEventsHoweverTheyAreSplit) {
  std::vector<unsigned char> bytes;
  const auto append = [&bytes](const auto& value) {
    const auto* begin = reinterpret_cast<const unsigned char*>(&value);
    bytes.insert(bytes.end(), begin, begin + sizeof value);
  };
  for (const Event& event : kEvents) {
    append(event.t_us);
    append(event.x);
    append(event.y);
    append(event.polarity);
  }
  EventHash whole;
  whole.add(kEvents);
  EXPECT_EQ(whole.value(), XXH64(bytes.data(), bytes.size(), 0));
  EventHash parts;
  for (const Event& event : kEvents) parts.add(std::span(&event, 1));
  EXPECT_EQ(parts.value(), whole.value());
}

TEST(EventHash, SeesEveryFieldAndTheOrder) {
  EventHash hash;
  hash.add(kEvents);
  const auto differs = [&](std::vector<Event> events) {
    EventHash other;
    other.add(events);
    return other.value() != hash.value();
  };
  for (int field = 0; field < 4; ++field) {
    auto events = kEvents;
    if (field == 0) ++events[1].t_us;
    if (field == 1) ++events[1].x;
    if (field == 2) ++events[1].y;
    if (field == 3) events[1].polarity = 1;
    EXPECT_TRUE(differs(events));
  }
  EXPECT_TRUE(differs({kEvents[1], kEvents[0], kEvents[2]}));
}

}  // namespace
}  // namespace dodgesim

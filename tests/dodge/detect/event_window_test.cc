#include "dodge/detect/event_window.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace dodge {
namespace {

std::vector<Event> events_every(TimeUs step_us, TimeUs begin_us, TimeUs end_us) {
  std::vector<Event> events;
  for (TimeUs t = begin_us; t < end_us; t += step_us) events.push_back({.t_us = t, .x = 3, .y = 4});
  return events;
}

std::vector<TimeUs> times(const EventWindow& window, TimeUs until_us) {
  std::vector<TimeUs> times;
  for (const std::span<const Event> piece : window.until(until_us)) {
    for (const Event& event : piece) times.push_back(event.t_us);
  }
  return times;
}

TEST(EventWindow, HoldsTheHalfOpenInterval) {
  EventWindow window;
  window.add(events_every(100, 0, 1000));
  EXPECT_TRUE(window.empty()) << "they wait";
  window.take(1000);
  window.forget_until(300);
  EXPECT_EQ(times(window, 600), (std::vector<TimeUs>{400, 500, 600}));
  EXPECT_EQ(window.newest_us(), 900);
}

TEST(EventWindow, IsEmptyBeforeTheFirstAndAfterTheLastEvent) {
  EventWindow window;
  EXPECT_TRUE(window.empty());
  EXPECT_TRUE(times(window, 1000).empty());
  window.add(events_every(100, 0, 1000));
  window.take(1000);
  window.forget_until(5000);
  EXPECT_TRUE(window.empty());
}

TEST(EventWindow, KeepsTheOrderAcrossTheEndOfItsMemory) {
  EventWindow window;
  const TimeUs length_us = 10000;
  for (TimeUs begin = 0; begin < 2000000; begin += 1000) {
    window.add(events_every(3, begin, begin + 1000));
    window.take(begin + 1000);
    window.forget_until(begin + 1000 - length_us);
    const std::vector<TimeUs> found = times(window, begin + 1000);
    ASSERT_TRUE(std::is_sorted(found.begin(), found.end()));
    if (begin > length_us) {
      ASSERT_NEAR(static_cast<double>(found.size()), 3340, 10);
    }
  }
}

TEST(EventWindow, DropsWhatIsOlderThanOneBeforeIt) {
  EventWindow window;
  window.add(std::vector<Event>{{.t_us = 100}, {.t_us = 300}, {.t_us = 200}, {.t_us = 300}});
  window.take(1000);
  window.add(std::vector<Event>{{.t_us = 299}, {.t_us = 400}});
  window.take(1000);
  EXPECT_EQ(times(window, 1000), (std::vector<TimeUs>{100, 300, 300, 400}));
  EXPECT_EQ(window.dropped(), 2);
}

TEST(EventWindow, WhatIsTooLateHoldsUpNothing) {
  EventWindow window;
  window.add(std::vector<Event>{{.t_us = 100}, {.t_us = 10000000}, {.t_us = 200}});
  window.take(1000);
  EXPECT_EQ(times(window, 20000000), (std::vector<TimeUs>{100, 200}));
  EXPECT_EQ(window.dropped(), 1);
  window.forget_until(200);
  EXPECT_TRUE(window.empty());
}

TEST(EventWindow, KnowsItsNewestEventAlsoWhenThatIsForgotten) {
  EventWindow window;
  EXPECT_FALSE(window.last_taken_us().has_value());
  window.add(events_every(100, 0, 1000));
  window.take(1000);
  window.forget_until(5000);
  EXPECT_EQ(window.last_taken_us(), 900);
}

// A clock that was set back: once the newer events are forgotten, the older ones count.
TEST(EventWindow, GoesOnWithOlderEventsWhenItIsEmpty) {
  EventWindow window;
  window.add(events_every(100, 5000, 6000));
  window.take(6000);
  window.forget_until(6000);
  window.add(events_every(100, 0, 1000));
  window.take(6000);
  EXPECT_EQ(window.newest_us(), 900);
}

TEST(EventWindow, BeginsAnewWhenTheClockIsSetBack) {
  EventWindow window;
  window.add(events_every(100, 50000, 60000));
  window.take(60000);
  window.add(events_every(100, 0, 1000));
  window.take(2000);
  EXPECT_EQ(times(window, 100000).size(), 10U);
  EXPECT_EQ(window.last_taken_us(), 900);
  EXPECT_EQ(window.dropped(), 0);
}

}  // namespace
}  // namespace dodge

#include "sim/playback/event_queue.h"

#include <gtest/gtest.h>

#include <utility>

namespace dodgesim {
namespace {

// Hands out events in portions of three.
class Portions : public EventReader {
 public:
  explicit Portions(std::vector<Event> events) : events_(std::move(events)) {}
  std::span<const Event> next() override {
    const std::size_t count = std::min<std::size_t>(3, events_.size() - read_);
    read_ += count;
    return std::span(events_).subspan(read_ - count, count);
  }
  double part_read() const override { return 0.5; }

 private:
  std::vector<Event> events_;
  std::size_t read_ = 0;
};

using Stamps = std::vector<TimeUs>;

// The stamps that are left, and the number of strays.
std::pair<Stamps, std::int64_t> through_queue(const Stamps& stamps) {
  std::vector<Event> events;
  for (const TimeUs t_us : stamps) events.push_back({t_us, 1, 1, 1});
  EventQueue queue(std::make_unique<Portions>(events));
  Stamps left;
  for (; queue.front() != nullptr; queue.pop()) left.push_back(queue.front()->t_us);
  return {left, queue.strays()};
}

Stamps every(TimeUs period_us, TimeUs first_us, int count) {
  Stamps stamps;
  for (int i = 0; i < count; ++i) stamps.push_back(first_us + i * period_us);
  return stamps;
}

Stamps operator+(Stamps a, const Stamps& b) {
  a.insert(a.end(), b.begin(), b.end());
  return a;
}

using Result = std::pair<Stamps, std::int64_t>;

TEST(EventQueue, PassesOverStrays) {
  const Stamps before = every(100, 1000, 50), after = every(100, 6000, 50);
  for (const TimeUs ahead_us : {TimeUs{27000}, TimeUs{1} << 60}) {
    EXPECT_EQ(through_queue(before + Stamps{ahead_us} + after), Result(before + after, 1));
    EXPECT_EQ(through_queue(Stamps{ahead_us} + after), Result(after, 1));
    EXPECT_EQ(through_queue(before + Stamps{ahead_us, 6000}), Result(before + Stamps{6000}, 1));
    EXPECT_EQ(through_queue(before + Stamps(16, ahead_us) + after), Result(before + after, 16));
  }
}

TEST(EventQueue, PassesOverWhatIsFarAheadAtTheEnd) {
  const Stamps before = every(100, 1000, 50);
  for (const int count : {1, 3, 32}) {
    EXPECT_EQ(through_queue(before + Stamps(static_cast<std::size_t>(count), 1'000'000'000'000)),
              Result(before, count));
  }
  // More of them are a clock that was put on.
  const Stamps jump = before + every(1, 1'000'000'000'000, 33);
  EXPECT_EQ(through_queue(jump), Result(jump, 0));
}

TEST(EventQueue, KeepsWhatIsNone) {
  EXPECT_EQ(through_queue({}), Result({}, 0));
  EXPECT_EQ(through_queue({5}), Result({5}, 0));
  const Stamps long_ago = every(100, 1'000'000, 100), now = every(100, 90'000'000, 100);
  // Silence; a clock that is put back; one event that comes far too late after silence; a stray
  // that nothing follows, which may as well be an event.
  for (const Stamps& stamps :
       {long_ago + now, now + long_ago, long_ago + now + Stamps{1'000'000} + now,
        long_ago + Stamps{90'000'000}, every(50'000, 0, 100)}) {
    EXPECT_EQ(through_queue(stamps), Result(stamps, 0));
  }
}

}  // namespace
}  // namespace dodgesim

#include "sim/events/event_log.h"

#include <xxhash.h>

#include <array>
#include <charconv>
#include <new>

#include "sim/base/error.h"

namespace dodgesim {

namespace {

constexpr std::size_t kEventBytes = 13;

// The event as bytes, little-endian, without padding.
std::array<unsigned char, kEventBytes> packed(const Event& event) {
  std::array<unsigned char, kEventBytes> bytes{};
  const auto put = [&bytes](std::size_t at, std::uint64_t value, std::size_t count) {
    for (std::size_t i = 0; i < count; ++i) {
      bytes[at + i] = static_cast<unsigned char>(value >> (8 * i));
    }
  };
  put(0, static_cast<std::uint64_t>(event.t_us), 8);
  put(8, event.x, 2);
  put(10, event.y, 2);
  put(12, static_cast<std::uint8_t>(event.polarity), 1);
  return bytes;
}

void append_number(std::string& text, std::int64_t value, char end) {
  std::array<char, 24> digits{};
  const auto result = std::to_chars(digits.data(), digits.data() + digits.size(), value);
  text.append(digits.data(), static_cast<std::size_t>(result.ptr - digits.data()));
  text.push_back(end);
}

}  // namespace

void EventHash::Free::operator()(XXH64_state_s* state) const { XXH64_freeState(state); }

EventHash::EventHash() : state_(XXH64_createState()) {
  if (!state_) throw std::bad_alloc();
  reset();
}

void EventHash::reset() { XXH64_reset(state_.get(), 0); }

void EventHash::add(std::span<const Event> events) {
  for (const Event& event : events) {
    const auto bytes = packed(event);
    XXH64_update(state_.get(), bytes.data(), bytes.size());
  }
}

std::uint64_t EventHash::value() const { return XXH64_digest(state_.get()); }

void append_line(std::string& text, const Event& event) {
  append_number(text, event.t_us, ' ');
  append_number(text, event.x, ' ');
  append_number(text, event.y, ' ');
  append_number(text, event.polarity > 0 ? 1 : 0, '\n');
}

EventLog::EventLog(const std::filesystem::path& path) : path_(path), file_(path) {
  if (!file_) throw IoError("The event log " + path_.string() + " cannot be created.");
}

void EventLog::add(std::span<const Event> events) {
  buffer_.clear();
  for (const Event& event : events) append_line(buffer_, event);
  file_.write(buffer_.data(), static_cast<std::streamsize>(buffer_.size()));
}

void EventLog::close() {
  file_.close();
  if (!file_) throw IoError("The event log " + path_.string() + " could not be written.");
}

}  // namespace dodgesim

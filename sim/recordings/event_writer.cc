#include "sim/recordings/event_writer.h"

#include <array>
#include <bit>
#include <charconv>
#include <cstring>

#include "sim/base/error.h"
#include "sim/files/npy_header.h"
#include "sim/files/output_file.h"
#include "sim/recordings/hdf5_event_writer.h"
#include "sim/recordings/prophesee_writer.h"

namespace dodgesim {

static_assert(std::endian::native == std::endian::little);

namespace {

void append_number(std::string& text, std::int64_t value) {
  std::array<char, 24> digits{};
  const auto result = std::to_chars(digits.data(), digits.data() + digits.size(), value);
  text.append(digits.data(), static_cast<std::size_t>(result.ptr - digits.data()));
}

// A line an event: t_us x y p and, if it is kept, the cause; p is 1 for ON and 0 for OFF, as common
// readers want it.
class TextWriter : public EventWriter {
 public:
  TextWriter(const std::filesystem::path& path, TimeUs t_offset_us)
      : file_(path), t_offset_us_(t_offset_us) {}

  void add(std::span<const Event> events, std::span<const Cause> causes) override {
    for (std::size_t i = 0; i < events.size(); ++i) {
      line_.clear();
      append_number(line_, events[i].t_us + t_offset_us_);
      for (const int value : {+events[i].x, +events[i].y, events[i].polarity > 0 ? 1 : 0}) {
        line_ += ' ';
        append_number(line_, value);
      }
      if (!causes.empty()) {
        line_ += ' ';
        append_number(line_, causes[i]);
      }
      line_ += '\n';
      file_.write(line_);
    }
  }

  void finish() override { file_.finish(); }
  void commit() override { file_.commit(); }

 private:
  OutputFile file_;
  TimeUs t_offset_us_;
  std::string line_;
};

class NpyWriter : public EventWriter {
 public:
  NpyWriter(const std::filesystem::path& path, const Recording& recording)
      : file_(path), t_offset_us_(recording.t_offset_us), has_causes_(recording.has_causes) {
    file_.write(front());
  }

  void add(std::span<const Event> events, std::span<const Cause> causes) override {
    for (std::size_t i = 0; i < events.size(); ++i) {
      const Event& event = events[i];
      std::array<char, 14> record{};
      const TimeUs t_us = t_offset_us_ + event.t_us;
      std::memcpy(record.data(), &t_us, 8);
      std::memcpy(record.data() + 8, &event.x, 2);
      std::memcpy(record.data() + 10, &event.y, 2);
      std::memcpy(record.data() + 12, &event.polarity, 1);
      if (has_causes_) std::memcpy(record.data() + 13, &causes[i], 1);
      file_.write({record.data(), record.size() - (has_causes_ ? 0 : 1)});
    }
    count_ += events.size();
  }

  void finish() override {
    file_.rewrite_front(front());
    file_.finish();
  }
  void commit() override {
    finish();
    file_.commit();
  }

 private:
  // Of the same length for any count, so that it can be replaced once the count is known.
  std::string front() const {
    constexpr std::size_t kBytes = 192;  // enough for 20 digits
    const std::string fields = "('t', '<i8'), ('x', '<u2'), ('y', '<u2'), ('p', '|i1')";
    return npy_front("[" + fields + (has_causes_ ? ", ('cause', '|u1')]" : "]"), {count_}, kBytes);
  }

  OutputFile file_;
  TimeUs t_offset_us_;
  bool has_causes_;
  std::uint64_t count_ = 0;
};

}  // namespace

std::unique_ptr<EventWriter> make_event_writer(const std::filesystem::path& path,
                                               const Recording& recording) {
  const std::string end = path.extension().string();
  if (end == ".txt") return std::make_unique<TextWriter>(path, recording.t_offset_us);
  if (end == ".npy") return std::make_unique<NpyWriter>(path, recording);
  if (end == ".h5" || end == ".hdf5") return make_hdf5_event_writer(path, recording);
  if (end == ".raw") return make_prophesee_event_writer(path, recording);
  throw ScenarioError(path.string() +
                      " must end in .h5 (or .hdf5), .npy, .txt or .raw, which decides on " +
                      "the format of the events.");
}

}  // namespace dodgesim

#include "sim/recordings/event_reader.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <optional>
#include <string_view>
#include <vector>

#include "sim/base/numbers.h"
#include "sim/files/npy_reader.h"
#include "sim/recordings/hdf5_event_reader.h"
#include "sim/recordings/raw_event.h"

namespace dodgesim {

namespace {

constexpr std::size_t kPortion = 1 << 14;  // events

// The cells of a line; blanks around them do not count.
void split(std::string_view line, char separator, std::vector<std::string_view>& cells) {
  constexpr std::string_view kBlanks = " \t\r";
  cells.clear();
  for (;;) {
    const std::size_t first = line.find_first_not_of(kBlanks);
    if (first == line.npos) break;
    line.remove_prefix(first);
    const std::size_t end = line.find_first_of(separator == ' ' ? kBlanks : ",");
    std::string_view cell = line.substr(0, end);
    cell = cell.substr(0, cell.find_last_not_of(kBlanks) + 1);
    cells.push_back(cell);
    if (end == line.npos) break;
    line.remove_prefix(end + 1);
  }
}

// Lines of text, .txt and .csv.
class TextReader : public EventReader {
 public:
  TextReader(const std::string& path, const ImageSize& image, char separator)
      : path_(path), image_(image), separator_(separator), file_(path) {
    if (!std::filesystem::is_regular_file(path) || !file_) {
      throw IoError(path + " cannot be read: it is no file, or may not be opened.");
    }
    if (separator == ',') read_names();
  }

  std::span<const Event> next() override {
    events_.clear();
    while (events_.size() < kPortion && read_line()) {
      events_.push_back(checked_event(parsed(), image_, [this] { return place(); }));
    }
    return events_;
  }

 private:
  std::string place() const { return path_ + ":" + std::to_string(line_number_); }

  bool read_line() {
    while (std::getline(file_, line_)) {
      ++line_number_;
      split(line_, separator_, cells_);
      if (!cells_.empty() && cells_.front().front() != '#') return true;
    }
    if (file_.bad()) throw IoError(path_ + " cannot be read to its end.");
    return false;
  }

  void read_names() {
    const std::array<std::string_view, 4> names = {"t_us", "x", "y", "p"};
    if (!read_line()) throw ScenarioError(path_ + " is empty: not even its columns have names.");
    for (std::size_t i = 0; i < names.size(); ++i) {
      const auto found = std::find(cells_.begin(), cells_.end(), names[i]);
      if (found == cells_.end()) {
        throw ScenarioError(place() + ": there is no column " + std::string(names[i]) +
                            "; the first line must name t_us, x, y and p.");
      }
      columns_[i] = static_cast<std::size_t>(found - cells_.begin());
    }
  }

  RawEvent parsed() {
    return {time_us(cell(0, "t")), integer(cell(1, "x"), "x"), integer(cell(2, "y"), "y"),
            integer(cell(3, "p"), "p")};
  }

  std::string_view cell(std::size_t i, const char* name) const {
    if (columns_[i] < cells_.size()) return cells_[columns_[i]];
    throw ScenarioError(place() + ": " + name + " is missing; a line has t, x, y and p.");
  }

  std::int64_t integer(std::string_view text, const char* name) const {
    std::int64_t value = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (error == std::errc{} && end == text.data() + text.size()) return value;
    throw ScenarioError(place() + ": " + name + " is \"" + std::string(text.substr(0, 40)) +
                        "\", but must be a whole number.");
  }

  std::int64_t time_us(std::string_view text) {
    if (!in_seconds_) in_seconds_ = separator_ == ' ' && text.find('.') != text.npos;
    if (!*in_seconds_) return integer(text, "t");
    const std::optional<double> t_s = as_number(text);
    if (t_s && std::abs(*t_s) < 1e12) return std::llround(*t_s * 1e6);
    throw ScenarioError(place() + ": t is \"" + std::string(text.substr(0, 40)) +
                        "\", but must be a number of seconds, as in the lines before.");
  }

  std::string path_;
  ImageSize image_;
  char separator_;
  std::ifstream file_;
  std::array<std::size_t, 4> columns_ = {0, 1, 2, 3};  // of t, x, y, p
  std::optional<bool> in_seconds_;                     // not known before the first event
  std::string line_;
  std::int64_t line_number_ = 0;
  std::vector<std::string_view> cells_;
  std::vector<Event> events_;
};

class NpyEventReader : public EventReader {
 public:
  NpyEventReader(const std::string& path, const ImageSize& image) : image_(image), file_(path) {
    const NpyHeader& header = file_.header();
    const std::string fields = "[('t', '<i8'), ('x', '<u2'), ('y', '<u2'), ('p', '|i1')";
    record_bytes_ = header.dtype == fields + "]" ? 13 : 14;
    if (record_bytes_ == 14 && header.dtype != fields + ", ('cause', '|u1')]") {
      throw ScenarioError(path + " has items of " + header.dtype + ", but must have records of " +
                          fields + "].");
    }
    if (header.shape.size() != 1) {
      throw ScenarioError(path + " has the shape " + shape_text(header.shape) +
                          ", but must have one dimension.");
    }
    file_.require_size(record_bytes_);
  }

  std::span<const Event> next() override {
    const std::uint64_t left = file_.header().shape.front() - read_;
    const auto count = static_cast<std::size_t>(std::min<std::uint64_t>(kPortion, left));
    bytes_.resize(count * record_bytes_);
    file_.read(bytes_.data(), bytes_.size());
    events_.clear();
    for (std::size_t i = 0; i < count; ++i, ++read_) {
      const char* record = bytes_.data() + i * record_bytes_;
      Event event;
      std::memcpy(&event.t_us, record, 8);
      std::memcpy(&event.x, record + 8, 2);
      std::memcpy(&event.y, record + 10, 2);
      std::memcpy(&event.polarity, record + 12, 1);
      events_.push_back(checked_event({event.t_us, event.x, event.y, event.polarity}, image_, [&] {
        return file_.path() + ", event " + std::to_string(read_);
      }));
    }
    return events_;
  }

 private:
  ImageSize image_;
  NpyReader file_;
  std::size_t record_bytes_ = 0;
  std::uint64_t read_ = 0;  // events
  std::vector<char> bytes_;
  std::vector<Event> events_;
};

}  // namespace

std::unique_ptr<EventReader> open_events(const std::string& path, const ImageSize& image) {
  const std::string end = std::filesystem::path(path).extension().string();
  if (end == ".txt") return std::make_unique<TextReader>(path, image, ' ');
  if (end == ".csv") return std::make_unique<TextReader>(path, image, ',');
  if (end == ".npy") return std::make_unique<NpyEventReader>(path, image);
  if (end == ".h5" || end == ".hdf5") return open_hdf5_events(path, image);
  throw ScenarioError(path +
                      " must end in .h5 (or .hdf5), .npy, .txt or .csv, which decides on the "
                      "format of the events.");
}

}  // namespace dodgesim

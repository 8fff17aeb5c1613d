#include "sim/recordings/prophesee_reader.h"

#include <array>
#include <bit>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <utility>
#include <vector>

#include "sim/base/error.h"
#include "sim/base/input_file.h"
#include "sim/base/numbers.h"
#include "sim/base/time.h"
#include "sim/recordings/evt_words.h"
#include "sim/recordings/raw_event.h"

namespace dodgesim {

static_assert(std::endian::native == std::endian::little);

namespace {

struct Header {
  std::string format;  // "EVT3", say
  ImageSize image;     // 0 where it does not say
  TimeUs t_offset_us = 0;
};

int pixels(const std::string& text) { return parse_integer<int>(text).value_or(0); }

// "EVT3;height=720;width=1280"
void take_format(const std::string& value, Header& header) {
  std::istringstream parts(value);
  std::getline(parts, header.format, ';');
  for (std::string part; std::getline(parts, part, ';');) {
    if (part.starts_with("width=")) header.image.width = pixels(part.substr(6));
    if (part.starts_with("height=")) header.image.height = pixels(part.substr(7));
  }
}

void take_line(const std::string& keyword, const std::string& value, Header& header) {
  if (keyword == "format") take_format(value, header);
  // Older recordings say it with these two.
  if (keyword == "evt" && header.format.empty()) {
    header.format = "EVT" + (value.ends_with(".0") ? value.substr(0, value.size() - 2) : value);
  }
  if (keyword == "geometry" && value.find('x') != std::string::npos) {
    const std::size_t x = value.find('x');
    header.image = {pixels(value.substr(0, x)), pixels(value.substr(x + 1))};
  }
  if (keyword == "t_offset_us") header.t_offset_us = parse_integer<TimeUs>(value).value_or(0);
}

// Leaves the file at its first word: behind "% end" or where a line begins otherwise.
Header read_header(std::ifstream& file) {
  Header header;
  std::array<char, 4096> line{};
  for (;;) {
    const std::streampos begin = file.tellg();
    if (!file.getline(line.data(), line.size()) || line[0] != '%' || line[1] != ' ') {
      file.clear();
      file.seekg(begin);
      return header;
    }
    std::istringstream words(line.data() + 2);
    std::string keyword, value;
    words >> keyword >> std::ws;
    if (keyword == "end") return header;
    std::getline(words, value);
    take_line(keyword, value, header);
  }
}

template <class Format>
class PropheseeReader : public EventReader {
 public:
  PropheseeReader(std::string path, const ImageSize& image, std::ifstream file, TimeUs t_offset_us)
      : path_(std::move(path)),
        bytes_(std::filesystem::file_size(path_)),
        image_(image),
        t_offset_us_(t_offset_us),
        file_(std::move(file)),
        bytes_read_(static_cast<std::uintmax_t>(file_.tellg())) {}

  std::span<const Event> next() override {
    events_.clear();
    while (events_.empty() && read_words()) {
      for (const Word word : words_) {
        format_.take(word, [this](const RawEvent& raw) { add(raw); });
      }
    }
    return events_;
  }

  double part_read() const override { return share(bytes_read_, bytes_); }

 private:
  using Word = typename Format::Word;

  // The next ones; false at the end.
  bool read_words() {
    constexpr std::size_t kPortion = 1 << 14;
    words_.resize(kPortion);
    file_.read(reinterpret_cast<char*>(words_.data()),
               static_cast<std::streamsize>(kPortion * sizeof(Word)));
    if (file_.bad()) throw IoError(path_ + " could not be read to its end.");
    const auto count = static_cast<std::size_t>(file_.gcount());
    bytes_read_ += count;
    words_.resize(count / sizeof(Word));
    return !words_.empty();
  }

  void add(RawEvent raw) {
    raw.t_us += t_offset_us_;
    events_.push_back(
        checked_event(raw, image_, [this] { return path_ + ", event " + std::to_string(count_); }));
    ++count_;
  }

  std::string path_;
  std::uintmax_t bytes_;
  ImageSize image_;
  TimeUs t_offset_us_;
  std::ifstream file_;
  std::uintmax_t bytes_read_;
  Format format_;
  std::vector<Word> words_;
  std::vector<Event> events_;
  std::uint64_t count_ = 0;  // events
};

void expect_size(const std::string& path, const char* side, int value, int expected) {
  if (value == 0 || value == expected) return;
  throw ScenarioError(path + ": its header says " + side + " " + std::to_string(value) +
                      ", but the calibration says " + std::to_string(expected) + ".");
}

}  // namespace

std::unique_ptr<EventReader> open_prophesee_events(const std::string& path,
                                                   const ImageSize& image) {
  std::ifstream file = open_file(path);
  const Header header = read_header(file);
  expect_size(path, "width", header.image.width, image.width);
  expect_size(path, "height", header.image.height, image.height);
  if (header.t_offset_us < -kLastUs || header.t_offset_us > kLastUs) {
    throw ScenarioError(path + ": its header says t_offset_us " +
                        std::to_string(header.t_offset_us) + ", which is absurd.");
  }
  if (header.format == "EVT2") {
    return std::make_unique<PropheseeReader<Evt2>>(path, image, std::move(file),
                                                   header.t_offset_us);
  }
  if (header.format == "EVT3") {
    return std::make_unique<PropheseeReader<Evt3>>(path, image, std::move(file),
                                                   header.t_offset_us);
  }
  throw ScenarioError(path + " must have a header that names the format EVT2 or EVT3, but " +
                      (header.format.empty() ? "names none" : "names " + header.format) + ".");
}

}  // namespace dodgesim

#include "sim/recordings/npy_event_reader.h"

#include <algorithm>
#include <bit>
#include <cstdint>
#include <cstring>
#include <regex>
#include <string>
#include <vector>

#include "sim/files/npy_reader.h"
#include "sim/recordings/raw_event.h"

namespace dodgesim {

namespace {

static_assert(std::endian::native == std::endian::little);

constexpr std::size_t kBytesAtOnce = 1 << 18;

// What stands in a record.
struct Field {
  std::string name;
  std::size_t offset = 0;
  std::size_t bytes = 0;
  char kind = 0;  // as NumPy has it: 'i', 'u', 'b' (a truth), 'V' (padding), ...

  bool is_integer() const {
    if (kind == 'b') return bytes == 1;
    return (kind == 'i' || kind == 'u') && bytes <= 8 && std::has_single_bit(bytes);
  }

  // Of an integer. The largest int64 stands for all that are larger.
  std::int64_t of(const char* record) const {
    std::uint64_t value = 0;
    std::memcpy(&value, record + offset, bytes);
    if (kind != 'i') {
      return static_cast<std::int64_t>(std::min<std::uint64_t>(value, INT64_MAX));
    }
    const std::size_t unused = 64 - 8 * bytes;
    return static_cast<std::int64_t>(value << unused) >> unused;
  }
};

// The fields of "[('t', '<i8'), ('x', '<u2'), ...]"; none if it is not such a list, or one of
// nested or big-endian fields.
std::vector<Field> fields_of(const std::string& dtype) {
  static const std::string one = R"(\('([^']*)', '[<|]([a-zA-Z])(\d{1,3})(\[\w+\])?'\))";
  static const std::regex field(one), list(R"(\[(\s*)" + one + R"(,?)+\s*\])");
  constexpr std::size_t kLongest = 1024;  // std::regex recurses for each character
  if (dtype.size() > kLongest || !std::regex_match(dtype, list)) return {};
  std::vector<Field> fields;
  std::size_t offset = 0;
  for (std::sregex_iterator at(dtype.begin(), dtype.end(), field), end; at != end; ++at) {
    const char kind = (*at)[2].str().front();
    const std::size_t bytes = std::stoul((*at)[3]) * (kind == 'U' ? 4 : 1);
    fields.push_back({(*at)[1], offset, bytes, kind});
    offset += bytes;
  }
  return fields;
}

class NpyEventReader : public EventReader {
 public:
  NpyEventReader(const std::string& path, const ImageSize& image) : image_(image), file_(path) {
    const std::vector<Field> fields = fields_of(file_.header().dtype);
    for (const auto& [name, field] :
         {std::pair{"t", &t_}, std::pair{"x", &x_}, std::pair{"y", &y_}, std::pair{"p", &p_}}) {
      const auto found = std::ranges::find(fields, name, &Field::name);
      if (found == fields.end() || !found->is_integer()) {
        throw ScenarioError(path + " has items of " + file_.header().dtype +
                            ", but must have records with the fields t [us], x, y and p, each a "
                            "little-endian integer.");
      }
      *field = *found;
    }
    record_bytes_ = fields.back().offset + fields.back().bytes;
    if (file_.header().shape.size() != 1) {
      throw ScenarioError(path + " has the shape " + shape_text(file_.header().shape) +
                          ", but must have one dimension.");
    }
    file_.require_size(record_bytes_);
  }

  std::span<const Event> next() override {
    const std::uint64_t left = file_.header().shape.front() - read_;
    const std::size_t at_once = std::max<std::size_t>(1, kBytesAtOnce / record_bytes_);
    const auto count = static_cast<std::size_t>(std::min<std::uint64_t>(at_once, left));
    bytes_.resize(count * record_bytes_);
    file_.read(bytes_.data(), bytes_.size());
    events_.clear();
    for (std::size_t i = 0; i < count; ++i, ++read_) {
      const char* record = bytes_.data() + i * record_bytes_;
      const RawEvent raw = {t_.of(record), x_.of(record), y_.of(record), p_.of(record)};
      events_.push_back(checked_event(
          raw, image_, [this] { return file_.path() + ", event " + std::to_string(read_); }));
    }
    return events_;
  }

  double part_read() const override { return share(read_, file_.header().shape.front()); }

 private:
  ImageSize image_;
  NpyReader file_;
  Field t_, x_, y_, p_;
  std::size_t record_bytes_ = 0;
  std::uint64_t read_ = 0;  // events
  std::vector<char> bytes_;
  std::vector<Event> events_;
};

}  // namespace

std::unique_ptr<EventReader> open_npy_events(const std::string& path, const ImageSize& image) {
  return std::make_unique<NpyEventReader>(path, image);
}

}  // namespace dodgesim

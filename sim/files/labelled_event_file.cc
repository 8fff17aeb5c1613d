#include "sim/files/labelled_event_file.h"

#include <bit>
#include <cstring>

#include "sim/base/error.h"
#include "sim/events/event_log.h"
#include "sim/files/npy_header.h"

namespace dodgesim {

static_assert(std::endian::native == std::endian::little);

namespace {

bool is_text(const std::filesystem::path& path) {
  if (path.extension() == ".txt") return true;
  if (path.extension() == ".npy") return false;
  throw ScenarioError(path.string() +
                      " must end in .npy or .txt, which decides on the format of the events.");
}

template <class T>
void append_bytes(std::string& bytes, const T& value) {
  char raw[sizeof(T)];
  std::memcpy(raw, &value, sizeof(T));
  bytes.append(raw, sizeof(T));
}

void append_record(std::string& bytes, const Event& event, Cause cause) {
  append_bytes(bytes, event.t_us);
  append_bytes(bytes, event.x);
  append_bytes(bytes, event.y);
  append_bytes(bytes, event.polarity);
  append_bytes(bytes, cause);
}

void append_text(std::string& text, const Event& event, Cause cause) {
  append_line(text, event);
  text.pop_back();  // the line's end
  text += " " + std::to_string(cause) + "\n";
}

}  // namespace

LabelledEventFile::LabelledEventFile(const std::filesystem::path& path)
    : text_(is_text(path)), file_(path) {
  if (!text_) file_.write(front());
}

void LabelledEventFile::add(std::span<const Event> events, std::span<const Cause> causes) {
  buffer_.clear();
  for (std::size_t i = 0; i < events.size(); ++i) {
    if (text_) {
      append_text(buffer_, events[i], causes[i]);
    } else {
      append_record(buffer_, events[i], causes[i]);
    }
  }
  file_.write(buffer_);
  count_ += events.size();
}

void LabelledEventFile::finish() {
  if (!text_) file_.rewrite_front(front());
  file_.commit();
}

// Of the same length for any count, so that it can be replaced once the count is known.
std::string LabelledEventFile::front() const {
  constexpr std::size_t kBytes = 192;  // enough for 20 digits
  return npy_front("[('t', '<i8'), ('x', '<u2'), ('y', '<u2'), ('p', '|i1'), ('cause', '|u1')]",
                   {count_}, kBytes);
}

}  // namespace dodgesim

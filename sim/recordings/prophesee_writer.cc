#include "sim/recordings/prophesee_writer.h"

#include <array>
#include <bit>
#include <cstring>
#include <optional>
#include <string>

#include "sim/base/error.h"
#include "sim/files/output_file.h"
#include "sim/recordings/evt_words.h"

namespace dodgesim {

static_assert(std::endian::native == std::endian::little);

namespace {

constexpr TimeUs kClockEndUs = TimeUs{1} << 34;
constexpr int kMostPixels = 1 << 11;

// Prophesee's programs choose by the integrator's name what reads the file, and want a date.
std::string header_of(const Recording& recording) {
  const std::string width = std::to_string(recording.width);
  const std::string height = std::to_string(recording.height);
  return "% camera_integrator_name Prophesee\n"
         "% date 1970-01-01 00:00:00\n"
         "% evt 2.0\n"
         "% format EVT2;height=" +
         height + ";width=" + width + "\n" + "% geometry " + width + "x" + height + "\n" +
         "% plugin_integrator_name Prophesee\n"
         "% t_offset_us " +
         std::to_string(recording.t_offset_us) + "\n" + "% end\n";
}

class PropheseeWriter : public EventWriter {
 public:
  PropheseeWriter(const std::filesystem::path& path, const Recording& recording) : file_(path) {
    file_.write(header_of(recording));
  }

  void add(std::span<const Event> events, std::span<const Cause> /*causes*/) override {
    for (const Event& event : events) {
      const Evt2::Word time_high = Evt2::time_high(event.t_us);
      if (time_high_ != time_high) write(time_high);
      time_high_ = time_high;
      write(Evt2::event(event.t_us, event.x, event.y, event.polarity > 0));
    }
  }

  void finish() override { file_.finish(); }
  void commit() override { file_.commit(); }

 private:
  void write(Evt2::Word word) {
    std::array<char, sizeof word> bytes{};
    std::memcpy(bytes.data(), &word, sizeof word);
    file_.write({bytes.data(), bytes.size()});
  }

  OutputFile file_;
  std::optional<Evt2::Word> time_high_;
};

}  // namespace

std::unique_ptr<EventWriter> make_prophesee_event_writer(const std::filesystem::path& path,
                                                         const Recording& recording) {
  if (recording.duration_us >= kClockEndUs) {
    throw ScenarioError(
        path.string() + " cannot hold the recording of " + std::to_string(recording.duration_us) +
        " us: time stamps of this format end at 2^34 - 1 us (4.7 hours); .npy and " +
        ".txt have no such limit.");
  }
  if (recording.width > kMostPixels || recording.height > kMostPixels) {
    throw ScenarioError(path.string() + " cannot hold pictures of " +
                        std::to_string(recording.width) + " x " + std::to_string(recording.height) +
                        " px: this format has up to 2048 rows and columns; the others have no " +
                        "such limit.");
  }
  return std::make_unique<PropheseeWriter>(path, recording);
}

}  // namespace dodgesim

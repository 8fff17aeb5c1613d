#include "sim/recordings/frame_reader.h"

#include <bit>
#include <limits>

#include "sim/base/error.h"
#include "sim/base/formatted.h"
#include "sim/events/event_camera.h"
#include "sim/recordings/raw_event.h"

namespace dodgesim {

static_assert(std::endian::native == std::endian::little);

namespace {

constexpr std::uint64_t kMaxSide = EventCamera::kMaxSide;
constexpr TimeUs kMaxIntervalUs = EventCamera::kMaxIntervalUs;
constexpr float kWhite = 255;  // the uint8 value of luminance 1

// "'>f4'" with what it means, where that helps.
std::string dtype_text(const NpyHeader& header) {
  if (header.dtype.starts_with('[')) return "records " + header.dtype;
  std::string text = "dtype '" + header.dtype + "'";
  if (header.dtype.starts_with('>')) text += " (big-endian)";
  return text;
}

[[noreturn]] void refuse(const NpyReader& file, const std::string& complaint) {
  throw ScenarioError(file.path() + " " + complaint + ".");
}

}  // namespace

FrameReader::FrameReader(const std::string& frames_path, const std::string& times_path)
    : frames_(frames_path), times_(times_path) {
  check_frames();
  check_times();
}

void FrameReader::check_frames() {
  const NpyHeader& header = frames_.header();
  is_float_ = header.dtype == "<f4";
  if (!is_float_ && header.dtype != "|u1") {
    refuse(frames_, "holds " + dtype_text(header) +
                        ", but frames must be float32 ('<f4', linear luminance) or uint8 ('|u1')");
  }
  const std::vector<std::uint64_t>& shape = header.shape;
  if (shape.size() != 3) {
    refuse(frames_, "has the shape " + shape_text(shape) +
                        ", but frames must be (N, H, W): number, height and width");
  }
  if (header.fortran_order) {
    refuse(frames_,
           "is in Fortran order; frames must be in C order (numpy.ascontiguousarray makes it so)");
  }
  frames_.require_size(is_float_ ? sizeof(float) : 1);
  const std::string holds = "has the shape " + shape_text(shape) + ": ";
  if (shape[0] < 2) {
    refuse(frames_, holds + "events need at least two frames, the first of which is the reference");
  }
  if (shape[1] == 0 || shape[2] == 0) refuse(frames_, holds + "its frames have no pixels");
  if (shape[1] > kMaxSide || shape[2] > kMaxSide) {
    refuse(frames_,
           holds + "frames may have up to " + std::to_string(kMaxSide) + " rows and columns");
  }
  frame_count_ = static_cast<std::int64_t>(shape[0]);
  height_ = static_cast<int>(shape[1]);
  width_ = static_cast<int>(shape[2]);
}

void FrameReader::check_times() {
  const NpyHeader& header = times_.header();
  if (header.dtype != "<i8") {
    refuse(times_,
           "holds " + dtype_text(header) + ", but time stamps must be int64 ('<i8') microseconds");
  }
  const auto frames = static_cast<std::uint64_t>(frame_count_);
  if (header.shape != std::vector{frames}) {
    refuse(times_, "has the shape " + shape_text(header.shape) + ", but " + frames_.path() +
                       " has " + std::to_string(frames) + " frames: " + shape_text({frames}) +
                       " is needed");
  }
  times_.require_size(sizeof(TimeUs));
  times_.read(&first_us_, sizeof first_us_);
  TimeUs before = first_us_;
  for (std::int64_t i = 1; i < frame_count_; ++i) {
    TimeUs now = 0;
    times_.read(&now, sizeof now);
    const auto which = [i, now] {
      return "time stamp " + std::to_string(i) + " (" + std::to_string(now) + " us)";
    };
    if (now <= before) {
      refuse(times_, "does not increase: " + which() + " does not follow " +
                         std::to_string(before) + " us");
    }
    // Unsigned, because the difference of two int64 may be no int64.
    if (static_cast<std::uint64_t>(now) - static_cast<std::uint64_t>(before) > kMaxIntervalUs) {
      refuse(times_, "has a gap: " + which() + " follows " + std::to_string(before) +
                         " us by more than " + std::to_string(kMaxIntervalUs) + " us");
    }
    before = now;
  }
  // Readers of events take no more either.
  if (first_us_ < -kLastUs || before > kLastUs) {
    refuse(times_, "goes from " + std::to_string(first_us_) + " to " + std::to_string(before) +
                       " us, but must stay within 2^60 us of 0: are these nanoseconds?");
  }
  duration_us_ = before - first_us_;
  times_.rewind();
}

bool FrameReader::next(TimeUs& t_us, std::vector<float>& luminance) {
  if (next_frame_ == frame_count_) return false;
  times_.read(&t_us, sizeof t_us);
  t_us -= first_us_;
  const std::size_t pixels = static_cast<std::size_t>(width_) * static_cast<std::size_t>(height_);
  luminance.resize(pixels);
  if (is_float_) {
    frames_.read(luminance.data(), pixels * sizeof(float));
    check_luminance(luminance);
  } else {
    bytes_.resize(pixels);
    frames_.read(bytes_.data(), pixels);
    for (std::size_t i = 0; i < pixels; ++i) {
      luminance[i] = static_cast<float>(bytes_[i]) / kWhite;
    }
  }
  ++next_frame_;
  return true;
}

void FrameReader::check_luminance(const std::vector<float>& luminance) const {
  // A check of all pixels at once is fast; the bad one is looked for only if there is one.
  const auto bad = [](float value) {
    return !((value >= 0) & (value <= std::numeric_limits<float>::max()));
  };
  unsigned any = 0;
  for (const float value : luminance) any |= static_cast<unsigned>(bad(value));
  if (any == 0) return;
  std::size_t i = 0;
  while (!bad(luminance[i])) ++i;
  const auto width = static_cast<std::size_t>(width_);
  refuse(frames_, "has the luminance " + formatted("%g", static_cast<double>(luminance[i])) +
                      " in frame " + std::to_string(next_frame_) + ", row " +
                      std::to_string(i / width) + ", column " + std::to_string(i % width) +
                      ", but luminance must be finite and not negative");
}

}  // namespace dodgesim

#include "sim/recordings/frame_writer.h"

#include <cstdint>
#include <string_view>

#include "sim/files/npy_header.h"

namespace dodgesim {

namespace {

constexpr std::size_t kFrontBytes = 128;  // whatever the count is: it is known at the end only

template <class T>
std::string_view bytes_of(const T* values, std::size_t count) {
  return {reinterpret_cast<const char*>(values), count * sizeof(T)};
}

}  // namespace

FrameWriter::FrameWriter(const std::filesystem::path& frames, const std::filesystem::path& times,
                         int width, int height)
    : width_(static_cast<std::uint64_t>(width)),
      height_(static_cast<std::uint64_t>(height)),
      frames_(frames),
      times_(times) {
  frames_.write(frames_front());
  times_.write(times_front());
}

void FrameWriter::add(TimeUs t_us, const std::vector<float>& luminance) {
  frames_.write(bytes_of(luminance.data(), luminance.size()));
  times_.write(bytes_of(&t_us, 1));
  ++count_;
}

void FrameWriter::commit() {
  frames_.rewrite_front(frames_front());
  times_.rewrite_front(times_front());
  frames_.finish();
  times_.finish();
  frames_.commit();
  times_.commit();
}

std::string FrameWriter::frames_front() const {
  return npy_front("'<f4'", {static_cast<std::uint64_t>(count_), height_, width_}, kFrontBytes);
}

std::string FrameWriter::times_front() const {
  return npy_front("'<i8'", {static_cast<std::uint64_t>(count_)}, kFrontBytes);
}

}  // namespace dodgesim

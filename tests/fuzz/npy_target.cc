#include <algorithm>
#include <vector>

#include "sim/recordings/frame_reader.h"
#include "tests/fuzz/inputs.h"

namespace dodgesim::fuzz {

// The first two bytes say how many of the others are the file of frames; the rest is that of the
// time stamps.
bool npy(Bytes bytes) {
  if (bytes.size() < 2) return false;
  const std::string_view all = text_of(bytes.subspan(2));
  const std::size_t size = std::min<std::size_t>(bytes[0] * 256u + bytes[1], all.size());
  const MemoryFile frames(all.substr(0, size)), times(all.substr(size));
  return accepts([&] {
    FrameReader video(frames.path(), times.path());
    std::vector<float> luminance;
    TimeUs t_us = 0, before_us = -1;
    std::int64_t count = 0;
    while (video.next(t_us, luminance)) {
      require(t_us > before_us && t_us <= video.duration_us(), "time stamps increase");
      before_us = t_us;
      ++count;
    }
    require(count == video.frame_count(), "every frame is read");
  });
}

}  // namespace dodgesim::fuzz

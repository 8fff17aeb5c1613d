// Pictures and their instants, as two NumPy files.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "sim/base/time.h"
#include "sim/files/npy_reader.h"

namespace dodgesim {

// FRAMES: (N, H, W), C order, float32 linear luminance or uint8, of which 255 is the luminance 1.
// TIMES: (N) int64, microseconds from any origin within 2^60 of them, increasing. Reads picture by
// picture, so that a video may be larger than the memory.
class FrameReader {
 public:
  // Opens both files and checks all that can be said without the pictures themselves: types,
  // shapes, sizes, instants. Throws ScenarioError, one sentence that names the file, for what is
  // not as above, less than two pictures, pictures that are too large and instants that are too far
  // apart for EventCamera; IoError when reading fails.
  FrameReader(const std::string& frames_path, const std::string& times_path);

  int width() const { return width_; }
  int height() const { return height_; }
  std::int64_t frame_count() const { return frame_count_; }
  TimeUs first_us() const { return first_us_; }        // the instant of the first picture
  TimeUs duration_us() const { return duration_us_; }  // from the first picture to the last

  // Reads the next picture; false at the end. t_us counts from the first picture. `luminance` gets
  // height x width values, row-major from the top left. Throws ScenarioError for a luminance that
  // is negative or not finite.
  bool next(TimeUs& t_us, std::vector<float>& luminance);

 private:
  void check_frames();
  void check_times();
  void check_luminance(const std::vector<float>& luminance) const;

  NpyReader frames_, times_;
  int width_ = 0;
  int height_ = 0;
  bool is_float_ = false;
  std::int64_t frame_count_ = 0;
  std::int64_t next_frame_ = 0;
  TimeUs first_us_ = 0;
  TimeUs duration_us_ = 0;
  std::vector<std::uint8_t> bytes_;  // a picture of type uint8
};

}  // namespace dodgesim

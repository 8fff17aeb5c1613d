// Pictures and their instants as two NumPy files, which FrameReader reads (frame_reader.h).
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "sim/base/time.h"
#include "sim/files/output_file.h"

namespace dodgesim {

class FrameWriter {
 public:
  // Throws IoError, as all functions do. Without commit() nothing is left behind.
  FrameWriter(const std::filesystem::path& frames, const std::filesystem::path& times, int width,
              int height);

  // `luminance`: height x width values, row-major from the top left.
  void add(TimeUs t_us, const std::vector<float>& luminance);
  void commit();
  std::int64_t count() const { return count_; }

 private:
  std::string frames_front() const;
  std::string times_front() const;

  std::uint64_t width_, height_;
  OutputFile frames_, times_;
  std::int64_t count_ = 0;
};

}  // namespace dodgesim

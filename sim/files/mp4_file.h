// Videos for people.
#pragma once

#include <sys/types.h>

#include <cstdint>
#include <cstdio>
#include <string>

#include "sim/files/staged_file.h"

namespace dodgesim {

// MPEG-4 with H.264, which browsers open, written by the program ffmpeg: a library that can do so
// would load 200 others at every start of dodgesim.
class Mp4File {
 public:
  // Throws IoError if the file cannot be opened for writing, another program is writing it, or
  // there is no ffmpeg. It gets its name, and takes the place of another, in close().
  Mp4File(const std::string& path, int width, int height, double pictures_per_s);
  ~Mp4File();
  Mp4File(const Mp4File&) = delete;
  Mp4File& operator=(const Mp4File&) = delete;

  // One more picture: rows of BGR from the top, without gaps. Throws IoError.
  void write(const std::uint8_t* pixels);

  // Throws IoError if the file does not hold every picture.
  void close();

 private:
  bool end();  // whether ffmpeg was content
  void begin(int width, int height, double pictures_per_s);
  [[noreturn]] void fail();
  void stop();

  StagedFile place_;
  std::size_t picture_size_;   // [bytes]
  std::FILE* said_ = nullptr;  // by ffmpeg
  int pipe_ = -1;              // to ffmpeg
  pid_t ffmpeg_ = -1;
};

}  // namespace dodgesim

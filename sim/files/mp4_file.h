// Videos for people.
#pragma once

#include <sys/types.h>

#include <cstdint>
#include <cstdio>
#include <string>

namespace dodgesim {

// MPEG-4 with H.264, which browsers open, written by the program ffmpeg: a library that can do so
// would load 200 others at every start of dodgesim.
class Mp4File {
 public:
  // `name` is what messages call it. Throws IoError if the file cannot be opened for writing or
  // there is no ffmpeg.
  Mp4File(const std::string& path, std::string name, int width, int height, double pictures_per_s);
  ~Mp4File();  // removes the file unless it was closed
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
  void discard();

  std::string path_, name_;
  std::size_t picture_size_;   // [bytes]
  std::FILE* said_ = nullptr;  // by ffmpeg
  int pipe_ = -1;              // to ffmpeg
  pid_t ffmpeg_ = -1;
  bool whole_ = false;
};

}  // namespace dodgesim

#include "sim/files/video_file.h"

#include <fcntl.h>
#include <spawn.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <vector>

#include "sim/base/error.h"

namespace dodgesim {

namespace {

// Even sides, as H.264 wants them.
constexpr const char* kPadded = "pad=ceil(iw/2)*2:ceil(ih/2)*2";

std::vector<std::string> ffmpeg_command(const std::string& path, int width, int height,
                                        double pictures_per_s) {
  return {"ffmpeg",
          "-loglevel",
          "quiet",
          "-xerror",
          "-f",
          "rawvideo",
          "-pixel_format",
          "bgr24",
          "-video_size",
          std::to_string(width) + "x" + std::to_string(height),
          "-framerate",
          std::to_string(pictures_per_s),
          "-i",
          "pipe:0",
          "-vf",
          kPadded,
          "-codec:v",
          "libx264",
          "-pix_fmt",
          "yuv420p",
          "-y",
          "file:" + path};
}

// Starts the command with `input` as its standard input; the number of an error.
int start(const std::vector<std::string>& command, int input, pid_t& process) {
  std::vector<char*> arguments;
  for (const std::string& word : command) arguments.push_back(const_cast<char*>(word.c_str()));
  arguments.push_back(nullptr);
  posix_spawn_file_actions_t files;
  ::posix_spawn_file_actions_init(&files);
  ::posix_spawn_file_actions_adddup2(&files, input, STDIN_FILENO);
  ::posix_spawn_file_actions_addopen(&files, STDOUT_FILENO, "/dev/null", O_WRONLY, 0);
  ::posix_spawn_file_actions_addopen(&files, STDERR_FILENO, "/dev/null", O_WRONLY, 0);
  const int error =
      ::posix_spawnp(&process, arguments.front(), &files, nullptr, arguments.data(), environ);
  ::posix_spawn_file_actions_destroy(&files);
  return error;
}

}  // namespace

VideoFile::VideoFile(const std::string& path, int width, int height, double pictures_per_s)
    : path_(path), picture_size_(3 * static_cast<std::size_t>(width) * height) {
  if (!std::ofstream(path)) {
    throw IoError("The video " + path +
                  " could not be opened for writing: " + std::strerror(errno) + ".");
  }
  // A socket, not a pipe: writing to one that nobody reads any more is an error, not a signal.
  std::array<int, 2> ends{};
  int error = ::socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, ends.data()) == 0 ? 0 : errno;
  if (error == 0) {
    pipe_ = ends[0];
    error = start(ffmpeg_command(path, width, height, pictures_per_s), ends[1], ffmpeg_);
    ::close(ends[1]);
  }
  if (error == 0) return;
  if (pipe_ >= 0) ::close(pipe_);
  throw IoError(
      "The video " + path +
      " could not be begun, for which the program ffmpeg is needed: " + std::strerror(error) + ".");
}

void VideoFile::write(const std::uint8_t* pixels) {
  for (std::size_t sent = 0; sent < picture_size_;) {
    const ssize_t n = ::send(pipe_, pixels + sent, picture_size_ - sent, MSG_NOSIGNAL);
    if (n < 0 && errno == EINTR) continue;
    if (n <= 0) throw IoError("The video " + path_ + " could not be written: is the disk full?");
    sent += static_cast<std::size_t>(n);
  }
}

bool VideoFile::end() {
  ::close(pipe_);
  pipe_ = -1;
  int status = -1;
  while (::waitpid(ffmpeg_, &status, 0) < 0 && errno == EINTR) continue;
  return WIFEXITED(status) && WEXITSTATUS(status) == 0;
}

void VideoFile::close() {
  whole_ = end();
  if (!whole_) throw IoError("The video " + path_ + " could not be finished: is the disk full?");
}

VideoFile::~VideoFile() {
  if (pipe_ >= 0) end();
  std::error_code ignored;
  if (!whole_) std::filesystem::remove(path_, ignored);
}

}  // namespace dodgesim

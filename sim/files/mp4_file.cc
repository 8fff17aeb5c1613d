#include "sim/files/mp4_file.h"

#include <fcntl.h>
#include <signal.h>
#include <spawn.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstring>
#include <utility>
#include <vector>

#include "sim/base/descriptor.h"
#include "sim/base/error.h"

namespace dodgesim {

namespace {

// Even sides, as H.264 wants them.
constexpr const char* kPadded = "pad=ceil(iw/2)*2:ceil(ih/2)*2";

std::vector<std::string> ffmpeg_command(const std::string& path, int width, int height,
                                        double pictures_per_s) {
  const std::string size = std::to_string(width) + "x" + std::to_string(height);
  return {"ffmpeg",
          "-loglevel",
          "error",
          "-xerror",
          "-f",
          "rawvideo",
          "-pixel_format",
          "bgr24",
          "-video_size",
          size,
          "-framerate",
          std::to_string(pictures_per_s),
          "-i",
          "pipe:0",
          "-vf",
          kPadded,
          "-r",  // or ffmpeg guesses another from the input's, and leaves pictures out
          std::to_string(pictures_per_s),
          "-codec:v",
          "libx264",
          "-pix_fmt",
          "yuv420p",
          "-f",
          "mp4",
          "-y",
          "file:" + path};
}

// Starts the command in a process group of its own, which the terminal's Ctrl-C does not reach.
// Returns an errno, or 0.
int start(const std::vector<std::string>& command, int input, int errors, pid_t& process) {
  std::vector<char*> arguments;
  arguments.reserve(command.size() + 1);
  for (const std::string& word : command) arguments.push_back(const_cast<char*>(word.c_str()));
  arguments.push_back(nullptr);
  posix_spawn_file_actions_t files;
  ::posix_spawn_file_actions_init(&files);
  ::posix_spawn_file_actions_adddup2(&files, input, STDIN_FILENO);
  ::posix_spawn_file_actions_addopen(&files, STDOUT_FILENO, "/dev/null", O_WRONLY, 0);
  ::posix_spawn_file_actions_adddup2(&files, errors, STDERR_FILENO);
  posix_spawnattr_t attributes;
  ::posix_spawnattr_init(&attributes);
  ::posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETPGROUP);
  const int error =
      ::posix_spawnp(&process, arguments.front(), &files, &attributes, arguments.data(), environ);
  ::posix_spawnattr_destroy(&attributes);
  ::posix_spawn_file_actions_destroy(&files);
  return error;
}

// The last line of the file; empty if there is none.
std::string last_line(std::FILE* file) {
  std::string line, last;
  std::rewind(file);
  for (int c = std::fgetc(file); c != EOF; c = std::fgetc(file)) {
    if (c != '\n') {
      line += static_cast<char>(c);
    } else if (!line.empty()) {
      last = std::exchange(line, "");
    }
  }
  return line.empty() ? last : line;
}

}  // namespace

Mp4File::Mp4File(const std::string& path, int width, int height, double pictures_per_s)
    : place_(path),
      picture_size_(3 * static_cast<std::size_t>(width) * static_cast<std::size_t>(height)) {
  try {
    begin(width, height, pictures_per_s);
  } catch (...) {
    stop();
    throw;
  }
}

void Mp4File::begin(int width, int height, double pictures_per_s) {
  said_ = std::tmpfile();
  // A socket, not a pipe: writing to one that nobody reads any more is an error, not a signal.
  std::array<int, 2> ends{};
  int error = said_ == nullptr ? errno : 0;
  if (error == 0 && ::socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, ends.data()) != 0) {
    error = errno;
  }
  if (error == 0) {
    pipe_ = ends[0];
    error = start(ffmpeg_command(place_.partial().string(), width, height, pictures_per_s), ends[1],
                  ::fileno(said_), ffmpeg_);
    ::close(ends[1]);
  }
  if (error == 0) return;
  ffmpeg_ = -1;
  throw IoError("The video " + place_.path().string() +
                " could not be begun, for which the program ffmpeg is " +
                "needed: " + std::strerror(error) + ".");
}

void Mp4File::write(const std::uint8_t* pixels) {
  if (!send_all(pipe_, {reinterpret_cast<const char*>(pixels), picture_size_})) fail();
}

void Mp4File::close() {
  if (!end()) fail();
  place_.commit();
}

bool Mp4File::end() {
  if (pipe_ >= 0) ::close(std::exchange(pipe_, -1));
  if (ffmpeg_ < 0) return false;
  int status = -1;
  while (::waitpid(ffmpeg_, &status, 0) < 0 && errno == EINTR) continue;
  ffmpeg_ = -1;
  return WIFEXITED(status) && WEXITSTATUS(status) == 0;
}

void Mp4File::fail() {
  end();
  const std::string reason = last_line(said_);
  throw IoError("The video " + place_.path().string() + " could not be written by ffmpeg: " +
                (reason.empty() ? "it was stopped" : reason) + ".");
}

void Mp4File::stop() {
  if (ffmpeg_ > 0) ::kill(ffmpeg_, SIGKILL);
  end();
  if (said_ != nullptr) std::fclose(std::exchange(said_, nullptr));
}

Mp4File::~Mp4File() { stop(); }

}  // namespace dodgesim

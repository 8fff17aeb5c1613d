#include "sim/base/child_process.h"

#include <fcntl.h>
#include <poll.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstring>

#include "sim/base/descriptor.h"
#include "sim/base/error.h"
#include "sim/base/wall_clock.h"

namespace dodgesim {

namespace {

[[noreturn]] void serve(int fd, const std::function<std::string()>& task, pid_t parent) noexcept {
  die_with(parent);
  const rlimit no_core = {0, 0};
  ::setrlimit(RLIMIT_CORE, &no_core);
  // Allocators and sanitizers print messages, and so may the user's code that the task runs.
  const int nowhere = ::open("/dev/null", O_WRONLY);
  for (const int printed : {STDOUT_FILENO, STDERR_FILENO}) {
    if (::dup2(nowhere, printed) < 0) ::close(printed);
  }
  ::_exit(write_all(fd, task()) ? 0 : 1);
}

// All that the child says until it ends; false if it takes too long.
bool listen_to(int fd, int wall_ms, std::string& said) {
  const auto end = WallClock::now() + std::chrono::milliseconds(wall_ms);
  std::array<char, 4096> buffer;
  while (true) {
    const auto left = std::chrono::duration_cast<std::chrono::milliseconds>(end - WallClock::now());
    pollfd polled = {fd, POLLIN, 0};
    const int ready = left.count() > 0 ? ::poll(&polled, 1, static_cast<int>(left.count())) : 0;
    if (ready < 0 && errno == EINTR) continue;
    if (ready <= 0) return false;
    const ssize_t n = ::read(fd, buffer.data(), buffer.size());
    if (n < 0 && errno == EINTR) continue;
    if (n <= 0) return true;
    said.append(buffer.data(), static_cast<std::size_t>(n));
  }
}

}  // namespace

void die_with(pid_t parent) {
  ::prctl(PR_SET_PDEATHSIG, SIGKILL);
  if (::getppid() != parent) ::_exit(1);
}

ChildAnswer ask_child(const std::function<std::string()>& task, int wall_ms) {
  int fds[2];
  if (::pipe2(fds, O_CLOEXEC) != 0) {
    throw SimulationError(std::string("A pipe could not be made: ") + std::strerror(errno) + ".");
  }
  const pid_t parent = ::getpid();
  const pid_t child = ::fork();
  if (child == 0) {
    ::close(fds[0]);
    serve(fds[1], task, parent);
  }
  const int error = errno;
  ::close(fds[1]);
  if (child < 0) {
    ::close(fds[0]);
    throw SimulationError(std::string("A process could not be made: ") + std::strerror(error) +
                          ".");
  }
  ChildAnswer answer;
  answer.in_time = listen_to(fds[0], wall_ms, answer.said);
  ::close(fds[0]);
  if (!answer.in_time) ::kill(child, SIGKILL);
  int status = 0;
  while (::waitpid(child, &status, 0) < 0 && errno == EINTR) {
  }
  return answer;
}

}  // namespace dodgesim

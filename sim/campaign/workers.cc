#include "sim/campaign/workers.h"

#include <poll.h>
#include <sys/socket.h>
#include <sys/types.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstring>
#include <map>
#include <string>
#include <vector>

#include "sim/base/error.h"
#include "sim/campaign/wire.h"

namespace dodgesim {

namespace {

enum class Kind : std::uint32_t { kResult, kScenarioError };

struct Header {
  Kind kind = Kind::kResult;
  std::uint32_t size = 0;
};

// Whole reads and writes on a stream socket; false when the other side is gone.
bool read_all(int fd, void* data, std::size_t size) {
  auto* bytes = static_cast<char*>(data);
  while (size > 0) {
    const ssize_t n = ::read(fd, bytes, size);
    if (n < 0 && errno == EINTR) continue;
    if (n <= 0) return false;
    bytes += n;
    size -= static_cast<std::size_t>(n);
  }
  return true;
}

bool write_all(int fd, const void* data, std::size_t size) {
  const auto* bytes = static_cast<const char*>(data);
  while (size > 0) {
    const ssize_t n = ::send(fd, bytes, size, MSG_NOSIGNAL);
    if (n < 0 && errno == EINTR) continue;
    if (n <= 0) return false;
    bytes += n;
    size -= static_cast<std::size_t>(n);
  }
  return true;
}

void mark_failed(ThrowResult& result, const std::string& reason) {
  result.flown.status = "error";
  result.flown.error = reason;
}

// The life of a worker: throw numbers in, results out, until the campaign closes the socket.
[[noreturn]] void serve(int fd, const WorkerTasks& tasks) {
  int index = 0;
  while (read_all(fd, &index, sizeof(index))) {
    Header header;
    std::string body;
    try {
      body = to_bytes(tasks.fly(index));
    } catch (const ScenarioError& error) {
      header.kind = Kind::kScenarioError;
      body = error.what();
    } catch (const std::exception& error) {
      ThrowResult result = tasks.blank(index);
      mark_failed(result, error.what());
      body = to_bytes(result);
    }
    header.size = static_cast<std::uint32_t>(body.size());
    if (!write_all(fd, &header, sizeof(header)) || !write_all(fd, body.data(), body.size())) break;
  }
  // Not exit(): the campaign's open files and their buffers are not ours to flush.
  ::_exit(0);
}

std::string describe_death(int status) {
  if (WIFSIGNALED(status)) {
    const int number = WTERMSIG(status);
    return "The worker process was killed by signal " + std::to_string(number) + " (" +
           ::strsignal(number) + ").";
  }
  return "The worker process ended with exit code " + std::to_string(WEXITSTATUS(status)) + ".";
}

class Pool {
 public:
  explicit Pool(const WorkerTasks& tasks) : tasks_(tasks) {}
  Pool(const Pool&) = delete;
  Pool& operator=(const Pool&) = delete;

  ~Pool() {
    for (Worker& worker : workers_) {
      ::kill(worker.pid, SIGKILL);
      reap(worker);
    }
  }

  void run() {
    const int jobs = std::clamp(tasks_.jobs, 1, std::max(1, tasks_.throws));
    for (int i = 0; i < jobs && next_ < tasks_.throws; ++i) start_worker();
    while (!workers_.empty()) wait_for_results();
  }

 private:
  struct Worker {
    pid_t pid = 0;
    int fd = -1;
    int index = 0;  // the throw it flies
  };

  void start_worker() {
    int fds[2];
    if (::socketpair(AF_UNIX, SOCK_STREAM, 0, fds) != 0) {
      throw IoError(std::string("A worker's socket could not be made: ") + std::strerror(errno));
    }
    std::fflush(nullptr);  // else the worker would inherit, and might repeat, buffered output
    const pid_t pid = ::fork();
    if (pid < 0) {
      ::close(fds[0]);
      ::close(fds[1]);
      throw IoError(std::string("A worker process could not be started: ") + std::strerror(errno));
    }
    if (pid == 0) {
      // A worker that held its siblings' sockets would keep them from seeing the campaign's end.
      for (const Worker& sibling : workers_) ::close(sibling.fd);
      ::close(fds[0]);
      serve(fds[1], tasks_);
    }
    ::close(fds[1]);
    workers_.push_back({pid, fds[0], 0});
    assign(workers_.back());
  }

  void assign(Worker& worker) {
    worker.index = next_++;
    // A worker that died between two throws is noticed when its socket reports the end.
    write_all(worker.fd, &worker.index, sizeof(worker.index));
  }

  static int reap(Worker& worker) {
    ::close(worker.fd);
    int status = 0;
    while (::waitpid(worker.pid, &status, 0) < 0 && errno == EINTR) {
    }
    return status;
  }

  void wait_for_results() {
    std::vector<pollfd> polled;
    for (const Worker& worker : workers_) polled.push_back({worker.fd, POLLIN, 0});
    if (::poll(polled.data(), polled.size(), -1) < 0) {
      if (errno == EINTR) return;
      throw IoError(std::string("Waiting for the workers failed: ") + std::strerror(errno));
    }
    // From the last to the first, because finished workers leave the list.
    for (std::size_t i = polled.size(); i-- > 0;) {
      if (polled[i].revents != 0) take_result(i);
    }
  }

  void take_result(std::size_t i) {
    Worker& worker = workers_[i];
    Header header;
    std::string body;
    bool alive = read_all(worker.fd, &header, sizeof(header));
    if (alive) {
      body.resize(header.size);
      alive = read_all(worker.fd, body.data(), body.size());
    }
    if (!alive) return replace(i);
    if (header.kind == Kind::kScenarioError) throw ScenarioError(body);
    finish(worker.index, result_from_bytes(body));
    if (next_ < tasks_.throws) {
      assign(worker);
    } else {
      reap(worker);
      workers_.erase(workers_.begin() + static_cast<std::ptrdiff_t>(i));
    }
  }

  void replace(std::size_t i) {
    Worker dead = workers_[i];
    workers_.erase(workers_.begin() + static_cast<std::ptrdiff_t>(i));
    ThrowResult result = tasks_.blank(dead.index);
    mark_failed(result, describe_death(reap(dead)));
    finish(dead.index, std::move(result));
    if (next_ < tasks_.throws) start_worker();
  }

  void finish(int index, ThrowResult result) {
    waiting_.emplace(index, std::move(result));
    ++finished_;
    while (!waiting_.empty() && waiting_.begin()->first == received_) {
      tasks_.receive(std::move(waiting_.begin()->second));
      waiting_.erase(waiting_.begin());
      ++received_;
    }
    if (tasks_.progress) tasks_.progress(finished_);
  }

  const WorkerTasks& tasks_;
  std::vector<Worker> workers_;
  std::map<int, ThrowResult> waiting_;  // finished before an earlier throw
  int next_ = 0;                        // throw to assign
  int received_ = 0;
  int finished_ = 0;
};

}  // namespace

void fly_in_workers(const WorkerTasks& tasks) { Pool(tasks).run(); }

}  // namespace dodgesim

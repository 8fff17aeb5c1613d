#include "sim/campaign/workers.h"

#include <poll.h>
#include <sys/socket.h>
#include <sys/types.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstdio>
#include <cstring>
#include <fstream>
#include <new>
#include <string>
#include <string_view>
#include <thread>
#include <type_traits>
#include <utility>
#include <vector>

#include "sim/base/child_process.h"
#include "sim/base/descriptor.h"
#include "sim/base/error.h"
#include "sim/base/formatted.h"
#include "sim/base/memory_limit.h"
#include "sim/base/wall_clock.h"
#include "sim/campaign/journal.h"
#include "sim/campaign/wire.h"

namespace dodgesim {

namespace {

enum class Kind : std::uint32_t { kResult, kScenarioError };

struct MessageHeader {
  Kind kind = Kind::kResult;
  std::uint32_t size = 0;
  double resident_mb = 0;  // of the worker
};

// How often somebody may ask for a stop.
constexpr int kPollMs = 200;

// Who kills a worker may be about to kill the campaign, too, as batch systems do process by process
// when a job must end. So long does it take to believe that a throw was lost.
constexpr std::chrono::milliseconds kGrace(500);

// A longer time in which the campaign has not looked at its workers is not held against them: it
// wrote tables, or was stopped (Ctrl-Z, SIGSTOP) and they with it.
constexpr std::chrono::seconds kLongestLook(1);

template <class Value>
std::string_view bytes_of(const Value& value) {
  static_assert(std::is_trivially_copyable_v<Value>);
  return {reinterpret_cast<const char*>(&value), sizeof value};
}

void mark_lost(ThrowResult& result, const std::string& reason) {
  result.flown.status = "lost";
  result.flown.error = reason;
}

double resident_mb() {
  std::ifstream statm("/proc/self/statm");
  double total = 0, resident = 0;
  statm >> total >> resident;
  return resident * static_cast<double>(::sysconf(_SC_PAGESIZE)) / (1 << 20);
}

ThrowResult failed_throw(const WorkerTasks& tasks, const Task& task, const std::string& reason) {
  ThrowResult result = tasks.blank(task);
  mark_lost(result, reason);
  return result;
}

std::string memory_reason() {
  const std::optional<std::int64_t> limit_mb = memory_limit_mb();
  return "There was not enough memory" +
         (limit_mb ? ": the limit is " + std::to_string(*limit_mb) + " MB." : ".");
}

// One throw, as header and body of the answer.
std::string fly_one(const WorkerTasks& tasks, const Task& task, MessageHeader& header) {
  try {
    std::string result = to_bytes(tasks.fly(task));
    if (result.size() <= kLargestRecord) return result;
    return to_bytes(failed_throw(tasks, task, "The throw's results exceed a gigabyte."));
  } catch (const ScenarioError& error) {
    header.kind = Kind::kScenarioError;
    return error.what();
  } catch (const std::bad_alloc&) {
    return to_bytes(failed_throw(tasks, task, memory_reason()));
  } catch (const std::exception& error) {
    return to_bytes(failed_throw(tasks, task, error.what()));
  }
}

void prepare_worker(const WorkerLimits& limits, pid_t campaign) {
  // Ctrl-C goes to the whole terminal, a batch system's signal to the whole job: the campaign
  // decides what becomes of its workers.
  for (const int number : {SIGINT, SIGTERM, SIGHUP}) ::signal(number, SIG_IGN);
  ::dup2(STDERR_FILENO, STDOUT_FILENO);      // the tables are alone on standard output
  std::setvbuf(stdout, nullptr, _IONBF, 0);  // what a pilot says before it dies is not lost
  die_with(campaign);
  if (limits.memory_mb > 0) limit_memory(limits.memory_mb);
}

// The life of a worker: tasks in, results out, until the campaign ends it.
// What is thrown here must not reach the campaign's own code, whose process this is not.
[[noreturn]] void serve(int fd, const WorkerTasks& tasks) noexcept {
  const pid_t worker = ::getpid();
  Task task;
  while (read_all(fd, &task, sizeof(task))) {
    MessageHeader header;
    const std::string body = fly_one(tasks, task, header);
    if (::getpid() != worker) break;  // a pilot has made a second process of this one
    header.size = static_cast<std::uint32_t>(body.size());
    header.resident_mb = resident_mb();
    if (!send_all(fd, bytes_of(header)) || !send_all(fd, body)) break;
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
    for (Worker& worker : workers_) end(worker);
  }

  WorkerMemory run() {
    const std::size_t jobs = static_cast<std::size_t>(std::max(1, tasks_.jobs));
    while (workers_.size() < jobs && go_on()) {
    }
    while (!workers_.empty()) {
      if (tasks_.stop && tasks_.stop()) break;
      wait_for_results();
      if (tasks_.meanwhile) tasks_.meanwhile();
      give_up_late_ones();
    }
    if (counted_ == 0) return {};
    return {first_mb_ / counted_, last_mb_ / counted_};
  }

 private:
  struct Worker {
    pid_t pid = 0;
    int fd = -1;
    Task task;  // that it flies
    WallClock::time_point begin;
    double first_mb = 0, last_mb = 0;
  };

  // Flies the next throw in a new worker. False if there is nothing to fly.
  bool go_on() {
    const std::optional<Task> task = tasks_.next();
    if (task) start_worker(*task);
    return task.has_value();
  }

  void start_worker(const Task& task) {
    int fds[2];
    if (::socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, fds) != 0) {
      throw IoError(std::string("A worker's socket could not be made: ") + std::strerror(errno) +
                    ".");
    }
    std::fflush(nullptr);  // else the worker would inherit, and might repeat, buffered output
    const pid_t campaign = ::getpid();
    const pid_t pid = ::fork();
    const int error = errno;
    if (pid < 0) {
      ::close(fds[0]);
      ::close(fds[1]);
      throw IoError(std::string("A worker process could not be started: ") + std::strerror(error) +
                    ".");
    }
    if (pid == 0) {
      // A worker that held its siblings' sockets would keep them from seeing the campaign's end.
      for (const Worker& sibling : workers_) ::close(sibling.fd);
      ::close(fds[0]);
      prepare_worker(tasks_.limits, campaign);
      serve(fds[1], tasks_);
    }
    ::close(fds[1]);
    Worker worker;
    worker.pid = pid;
    worker.fd = fds[0];
    workers_.push_back(worker);
    assign(workers_.back(), task);
  }

  // False if the worker is no more.
  static bool assign(Worker& worker, const Task& task) {
    worker.task = task;
    worker.begin = WallClock::now();
    return send_all(worker.fd, bytes_of(task));
  }

  // Kills it unless it has ended; the status with which it did.
  int end(Worker& worker) {
    if (worker.first_mb > 0) {
      first_mb_ += worker.first_mb;
      last_mb_ += worker.last_mb;
      ++counted_;
    }
    ::kill(worker.pid, SIGKILL);
    ::close(worker.fd);
    int status = 0;
    while (::waitpid(worker.pid, &status, 0) < 0 && errno == EINTR) {
    }
    return status;
  }

  void wait_for_results() {
    std::vector<pollfd> polled;
    polled.reserve(workers_.size());
    for (const Worker& worker : workers_) polled.push_back({worker.fd, POLLIN, 0});
    if (::poll(polled.data(), polled.size(), kPollMs) < 0) {
      if (errno == EINTR) return;
      throw IoError(std::string("Waiting for the workers failed: ") + std::strerror(errno) + ".");
    }
    // From the last to the first, because finished workers leave the list.
    for (std::size_t i = polled.size(); i-- > 0;) {
      if (polled[i].revents != 0) take_result(i);
    }
  }

  // Its throw may have ended in time and wait to be received.
  static bool has_result(const Worker& worker) {
    pollfd polled = {worker.fd, POLLIN, 0};
    return ::poll(&polled, 1, 0) > 0;
  }

  void give_up_late_ones() {
    if (tasks_.limits.wall_s <= 0) return;
    const WallClock::time_point now = WallClock::now();
    const WallClock::duration unseen = now - std::exchange(looked_, now);
    if (unseen > kLongestLook) {
      for (Worker& worker : workers_) worker.begin += unseen;
    }
    const std::chrono::duration<double> limit(tasks_.limits.wall_s);
    for (std::size_t i = workers_.size(); i-- > 0;) {
      if (now - workers_[i].begin < limit || has_result(workers_[i])) continue;
      end(workers_[i]);
      lose(i, formatted("The throw took longer than the limit of %g s.", tasks_.limits.wall_s));
    }
  }

  void take_result(std::size_t i) {
    Worker& worker = workers_[i];
    MessageHeader header;
    std::string body;
    bool alive = read_all(worker.fd, &header, sizeof(header));
    alive = alive && header.size <= kLargestRecord;
    if (alive) {
      body.resize(header.size);
      alive = read_all(worker.fd, body.data(), body.size());
    }
    if (!alive) {
      const int status = end(worker);  // one that has only lost its socket would never end
      if (WIFSIGNALED(status) && WTERMSIG(status) == SIGKILL) std::this_thread::sleep_for(kGrace);
      return lose(i, describe_death(status));
    }
    if (header.kind == Kind::kScenarioError) throw ScenarioError(body);
    if (worker.first_mb == 0) worker.first_mb = header.resident_mb;
    worker.last_mb = header.resident_mb;
    tasks_.receive(worker.task, result_from_bytes(body));
    const std::optional<Task> next = tasks_.next();
    if (next && assign(worker, *next)) return;
    end(worker);
    workers_.erase(workers_.begin() + static_cast<std::ptrdiff_t>(i));
    if (next) start_worker(*next);  // a worker that died between two throws costs neither
  }

  // The throw of a worker that is no more.
  void lose(std::size_t i, const std::string& reason) {
    const Task task = workers_[i].task;
    workers_.erase(workers_.begin() + static_cast<std::ptrdiff_t>(i));
    tasks_.receive(task, failed_throw(tasks_, task, reason));
    go_on();
  }

  const WorkerTasks& tasks_;
  std::vector<Worker> workers_;
  WallClock::time_point looked_ = WallClock::now();  // at whether a throw takes too long
  double first_mb_ = 0, last_mb_ = 0;
  int counted_ = 0;  // workers that have flown a throw
};

}  // namespace

WorkerMemory fly_in_workers(const WorkerTasks& tasks) { return Pool(tasks).run(); }

}  // namespace dodgesim
